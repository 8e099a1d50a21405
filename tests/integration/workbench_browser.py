#!/usr/bin/env python3
"""workbench_browser.py OSTIUM: a case is edited in a real Chromium, saved, and read by other commands.

A made-up artery is imported. On the page it is named, divided, entered elsewhere, narrowed and given a view; a sphere is
moved out of the wall, which the checks name, and back by undo; what cannot be is refused with the reason. Saved, `ostium
cases` and `frame --view` know it all. Then a shipped case: it is not written over, and saved as a case of its own.
Skipped (exit code 77) where there is no chromium or chromedriver; with CI=true that is a failure."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from browser import DRAWN, beside, programs, text

SAVED = text("state") + " === 'saved'"
ROWS = "[...document.querySelectorAll('#branches div')].map((one) => one.dataset.name).join()"


def link_of(run):
    return next(line for line in run.stdout if line.startswith("editor: ")).split(": ", 1)[1].strip()


def put(browser, name, value):
    """Into a field, as if it had been typed."""
    browser.run("""const field = document.getElementById(arguments[0]) ?? document.querySelector(arguments[0]);
      field.value = arguments[1]; field.dispatchEvent(new Event('change'));""", name, value)


def choose(browser, branch, mm):
    browser.run(f"document.querySelector('#branches div[data-name=\"{branch}\"]').click()")
    put(browser, "at", mm)


def refused(browser, words):
    browser.wait(f"it is refused: {words}", f"{text('refused')}.includes({json.dumps(words)})")


def edit_imported(browser):
    browser.wait("the wall", "document.getElementById('no-wall').hidden", 60)
    assert browser.run("return " + DRAWN % "courses"), "courses are drawn"
    name = browser.run("return " + ROWS)
    assert "," not in name, f"one artery, one name: {name}"
    assert browser.run("return " + SAVED)

    choose(browser, name, 30)
    put(browser, "name", "LAD")
    browser.click("rename")
    refused(browser, "heart")
    put(browser, "name", "femoral")
    browser.click("rename")
    browser.wait("the new name", f"{ROWS} === 'femoral'")
    choose(browser, "femoral", 30)
    put(browser, "name", "popliteal")
    browser.click("divide")
    browser.wait("two names", f"{ROWS} === 'femoral,popliteal'")
    assert browser.run("return document.getElementById('undo').title") == "divide femoral"

    choose(browser, "femoral", 12)
    browser.click("entry-here")
    browser.wait("the entry", "document.getElementById('undo').title === 'set the entry'")

    # Out of the wall: the checks say so, and undo takes it back.
    choose(browser, "popliteal", 10)
    put(browser, "reach", 6)
    at = {axis: browser.run(f"return document.getElementById('{axis}').valueAsNumber") for axis in "xyz"}
    put(browser, "y", f"{at['y'] + 9}")
    browser.click("move")
    browser.wait("a fault", text("faults") + ".includes('outside of the lumen')")
    assert "popliteal" in browser.run("return " + text("faults")) or "femoral" in browser.run("return " + text("faults"))
    browser.click("undo")
    browser.wait("no fault", "!" + text("faults") + ".includes('outside')")

    put(browser, "lao", -35)
    put(browser, "cran", 15)
    put(browser, "view-name", "my view")
    browser.click("keep-view")
    browser.wait("the view", text("views") + ".includes('my view: RAO 35 CRA 15')")
    browser.click("keep-view")
    refused(browser, "no other view has")

    put(browser, "[data-key='title']", "Edited")
    browser.wait("the title", text("title") + ".startsWith('Edited')")
    put(browser, "[data-key='heart_rate_1_min']", "300")
    refused(browser, "heart_rate_1_min")
    browser.click("save")
    browser.wait("saved", SAVED)


def close(browser, run):
    browser.click("close")
    run.wait(60)
    assert run.returncode == 0, run.returncode


def imported(ostium, folder):
    mesh = folder / "tube.stl"
    tube = pathlib.Path(__file__).parent.parent / "tools" / "comparison" / "made_up_tube.py"
    subprocess.run([sys.executable, "-B", tube, mesh, "2.5", "60"], check=True)
    case = folder / "artery"
    subprocess.run([ostium, "import", mesh, "--units", "mm", "-o", case], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with beside([ostium, "workbench", case]) as (run, browser):
        browser.open(link_of(run))
        edit_imported(browser)
        close(browser, run)
        # The workbench has gone, and a machine without a graphics card draws slowly.
        said = [one for one in browser.complaints() if "WebSocket" not in one and "WebGL" not in one]
        assert not said, said
    details = subprocess.run([ostium, "cases", case], check=True, capture_output=True, text=True).stdout
    for words in ("Edited", "femoral", "popliteal", "my view: RAO 35 CRA 15"):
        assert words in details, (words, details)
    subprocess.run([ostium, "frame", case, "--view", "my view", "--pixels", "64", "-o", folder / "frame.png"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def shipped(ostium, folder):
    os.environ["OSTIUM_CASES"] = str(folder / "cases")
    with beside([ostium, "workbench", "rca-mid-focal"]) as (run, browser):
        browser.open(link_of(run))
        browser.wait("the wall", "document.getElementById('no-wall').hidden", 60)
        assert browser.run("return document.querySelector('.imported').hidden"), "courses of a built case are not edited"
        choose(browser, "RCA", 90)
        browser.click("lesion-here")
        browser.wait("two lesions", "document.querySelectorAll('#lesions-panel fieldset').length === 2")
        put(browser, "[data-is='1-stenosis_percent']", "140")
        refused(browser, "1 to 95")
        put(browser, "[data-is='1-stenosis_percent']", "55")
        browser.wait("55 %", text("lesions-panel") + ".includes('RCA, 55 %')")
        browser.click("save")
        refused(browser, "ships with Ostium")
        browser.click("save-as")
        put(browser, "save-name", "../two")
        browser.run("[...document.querySelectorAll('#ask-name button')][0].click()")
        refused(browser, "is no name of a case")
        browser.click("save-as")
        put(browser, "save-name", "two-narrow")
        browser.run("[...document.querySelectorAll('#ask-name button')][0].click()")
        browser.wait("saved", SAVED)
        browser.click("xray-here")
        browser.wait("an X-ray picture", "!document.getElementById('xray').hidden", 60)
        # Ended with changes: they are kept.
        put(browser, "[data-key='title']", "Not saved")
        browser.wait("a change", text("state") + " !== 'saved'")
        run.terminate()
        run.wait(60)
    details = subprocess.run([ostium, "cases", "two-narrow"], check=True, capture_output=True, text=True).stdout
    assert details.count("lesion ") == 2 and "55 %" in details, details
    kept = subprocess.run([ostium, "cases", "two-narrow-unsaved"], check=True, capture_output=True, text=True).stdout
    assert "Not saved" in kept, kept


def main():
    if not programs():
        sys.exit(1 if os.environ.get("CI") == "true" else 77)
    with tempfile.TemporaryDirectory() as folder:
        for part in (imported, shipped):
            own = pathlib.Path(folder) / part.__name__
            own.mkdir()
            part(sys.argv[1], own)
    print("the workbench: an imported case and one that ships, edited, saved, read")


if __name__ == "__main__":
    main()
