#!/usr/bin/env python3
"""station_browser.py OSTIUM [PICTURE.png]: the trainer's station in a real Chromium, moved by WebDriver.

Skipped (exit code 77) where there is no chromium or chromedriver; with CI=true that is a failure."""
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

from browser import CLOCK, DRAWN, beside, programs, text


def tube(path):
    """A closed straight tube along x, 0.3 m long and 10 mm wide, as binary STL in mm."""
    n, rings = 16, 40
    ring = [[(300 * r / rings - 10, 5 * math.cos(2 * math.pi * k / n), 5 * math.sin(2 * math.pi * k / n))
             for k in range(n)] for r in range(rings + 1)]
    triangles = []
    for r in range(rings):
        for k in range(n):
            a, b, c, d = ring[r][k], ring[r][(k + 1) % n], ring[r + 1][k], ring[r + 1][(k + 1) % n]
            triangles += [(a, b, c), (b, d, c)]
    for end, middle in ((ring[0], (-10, 0, 0)), (ring[-1], (290, 0, 0))):
        for k in range(n):
            corners = (middle, end[(k + 1) % n], end[k])
            triangles.append(corners if end is ring[0] else corners[::-1])
    with open(path, "wb") as out:
        out.write(bytes(80) + struct.pack("<I", len(triangles)))
        for t in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0))


SCRIPT = {
    "schema": "ostium-script/1", "name": "watched", "title": "A wire in a tube",
    "tools": [{"name": "wire", "instrument": "cook-j"}],
    "steps": [{"do": "fluoroscopy", "on": True},
              {"do": "advance", "tool": "wire", "speed_mm_s": 20, "until": [{"inserted_mm": 200}], "timeout_s": 60}]}


def try_page(browser, trainer, viewer, folder, picture):
    browser.open(trainer)
    browser.wait("who", text("who") + " === 'Trainer'")
    browser.wait("the address has no token", "!location.href.includes('token')")
    browser.wait("it waits for the trainer", text("state") + ".startsWith('Paused')")
    browser.click("pause")
    browser.wait("time goes on", f"{CLOCK} >= 2", 40)
    browser.wait("a picture", DRAWN % "picture")
    browser.wait("the truth", DRAWN % "truth")
    browser.wait("an event in words", text("events") + ".includes('wire: tool in')")
    browser.wait("the beam's sign", "!document.getElementById('beam').hidden")
    browser.run("document.getElementById('note').value = 'look'; document.querySelector('#marks button').click()")
    browser.wait("the mark with its note", text("events") + ".includes('mark: look')")

    browser.click("hands")
    browser.wait("taken over", text("state") + ".includes('you have the instruments')")
    focus = "document.activeElement.id === 'stage'"
    browser.wait("the keys are the picture's", focus)
    press = "document.getElementById('stage').dispatchEvent(new KeyboardEvent(arguments[0], {key: arguments[1], bubbles: true}))"
    before = browser.wait("the wire is in", "parseFloat(document.querySelector('#tools tbody td:nth-child(2)').textContent)")
    browser.run(press, "keydown", "s")
    browser.wait("a key draws the wire back",
                 f"parseFloat(document.querySelector('#tools tbody td:nth-child(2)').textContent) < {before} - 0.5")
    browser.run(press, "keyup", "s")
    angles = browser.run("return " + text("numbers"))
    browser.run(press, "keydown", "ArrowLeft")
    browser.wait("an arrow turns the arm", text("numbers") + f" !== '{angles}'")

    # A browser that is killed comes back into the same session; a viewer looks on.
    browser.open(trainer)
    browser.wait("the same session", text("events") + ".includes('mark: look')")
    browser.click("pause")
    browser.wait("paused", text("state") + ".startsWith('Paused')")
    if picture:
        browser.picture(picture)
    browser.run("const bar = document.getElementById('bar'); bar.focus();"
                "for (const key of ['Home', 'ArrowRight', 'Enter'])"
                "  bar.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}))")
    browser.wait("it asks", "document.getElementById('ask').open")
    browser.run("document.querySelector('#ask button').click()")
    browser.wait("back", f"{CLOCK} === 1")
    browser.wait("what came later is gone from the list", "!" + text("events") + ".includes('mark: look')")
    browser.click("pause")
    browser.wait("on from there", f"{CLOCK} >= 2", 30)

    unnamed = browser.run("""return [...document.querySelectorAll('button, input, canvas, [role]')].filter((e) =>
      !(e.textContent.trim() || e.ariaLabel || e.title || (e.labels && e.labels.length) || e.getAttribute('aria-labelledby'))
      && e.id !== 'refused' && e.id !== 'gone' && e.id !== 'state').map((e) => e.outerHTML.slice(0, 80))""")
    assert not unnamed, f"without a name: {unnamed}"
    browser.open(viewer)
    browser.wait("a viewer", text("who") + " === 'Viewer'")
    assert browser.run("return document.getElementById('pause').disabled"), "a viewer cannot pause"
    browser.open(trainer)
    browser.wait("who", text("who") + " === 'Trainer'")
    browser.click("end")
    browser.run("document.querySelector('#ask button').click()")
    browser.wait("the end", text("state") + ".startsWith('Ended')", 30)
    assert (folder / "branch-2.h5").is_file() and (folder / "run.h5").is_file()
    # A WebSocket that is refused while one browser takes the other's seat is said by Chromium, not by the page.
    said = [one for one in browser.complaints() if "WebSocket connection" not in one]
    assert not said, f"the browser complains: {said}"
    browser.click("end")
    browser.run("document.querySelector('#ask button').click()")


def main(ostium, picture=None):
    if not programs():
        return 1 if os.environ.get("CI") == "true" else 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        tube(folder / "tube.stl")
        (folder / "watched.json").write_text(json.dumps(SCRIPT))
        out = folder / "out"
        with beside([ostium, "serve", folder / "tube.stl", "--units", "mm", "--entry", "0,0,0", "--towards", "50,0,0",
                     "--script", folder / "watched.json", "--out", out, "--no-report"]) as (run, browser):
            trainer = run.stdout.readline().split(": ", 1)[1].strip()
            viewer = run.stdout.readline().split(": ", 1)[1].strip()
            try_page(browser, trainer, viewer, out, picture)
            assert run.wait(30) in (0, 1)
        for recording in ("run.h5", "branch-2.h5"):
            subprocess.run([ostium, "replay", out / recording, "--verify"], check=True)
    print("the page works in a real browser")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
