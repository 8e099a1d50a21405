#!/usr/bin/env python3
"""two_seats.py OSTIUM FOLDER: a trainee's window and the trainer's page of one run, as one picture.

The trainer perforates the artery where the trainee's balloon lies; FOLDER/two-seats.png shows the film of the jet, and
the recording is then compared step by step."""
import os
import pathlib
import re
import subprocess
import sys

from browser import CLOCK, Browser, programs, text

PAGE = """<body style="margin: 0; background: #05070a; color: #c8d0d8; font: 22px 'DejaVu Sans'; display: flex; gap: 16px; overflow: hidden">
  <figure style="margin: 0"><img src="window.png" height="700"><figcaption>&nbsp;The trainee's window</figcaption></figure>
  <figure style="margin: 0"><img src="page.png" height="700"><figcaption>&nbsp;The trainer's page</figcaption></figure>"""


def main(ostium, name):
    if not programs():
        return 77
    folder = pathlib.Path(name).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    run = subprocess.Popen([ostium, "run", "rca-mid-focal", "--script", "perforation-provoked", "--set", "begin=RCA",
                            "--display", "window", "--last-frame", folder / "window.png", "--serve", "0", "--out",
                            folder / "run"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                           env=dict(os.environ, SDL_VIDEODRIVER="dummy"))
    page = Browser()
    try:
        page.open(next(found[0] for line in run.stdout if (found := re.search(r"http://\S+", line))))
        page.wait("the trainee waits", text("step") + ".includes('blood round the heart')", 600)
        page.click("tab-console")
        # 25 mm beyond the lesion, where the trainee's balloon is.
        page.run("const place = document.getElementById('provoke-place'); place.value = Number(place.value) + 25;"
                 "place.dispatchEvent(new Event('input')); document.getElementById('provoke-size').value = 1.2")
        page.press("Provoke")
        page.wait("a hole", text("events") + ".includes('provoked: perforation')", 30)
        page.click("tab-events")
        page.wait("the film", text("events") + ".includes('injection begins')", 300)
        begun = page.run("return " + CLOCK)
        page.wait("contrast in the artery", f"{CLOCK} >= {begun} + 4", 100)
        page.click("pause")
        page.wait("time stands", text("state") + ".startsWith('Paused')")
        page.picture(folder / "page.png")
        page.click("end")
        page.run("document.querySelector('#ask button').click()")
        run.wait(60)
        (folder / "both.html").write_text(PAGE)
        page.close()
        page = Browser(2720, 890)
        page.open((folder / "both.html").as_uri())
        page.wait("both", "[...document.images].every((one) => one.complete && one.naturalWidth > 0)")
        page.picture(folder / "two-seats.png")
    finally:
        page.close()
        run.terminate()
        run.wait(30)
    return subprocess.run([ostium, "replay", folder / "run" / "run.h5", "--verify"]).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
