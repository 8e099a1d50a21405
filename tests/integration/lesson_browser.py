#!/usr/bin/env python3
"""lesson_browser.py OSTIUM: the first lesson in a real Chromium, done by nothing but what its page says.

Mouse and keys are real ones, so that the focus is tested too: after Go on, Space is the pedal and not that button.
First the wire stays in, and the page says what is missing; then the lesson goes on from an earlier second and is done.
Skipped (exit code 77) where there is no chromium or chromedriver; with CI=true that is a failure."""
import json
import os
import pathlib
import re
import sys
import tempfile

from browser import CLOCK, beside, programs, text

IN_CM = "document.querySelector('#tools tbody td:nth-child(2)').textContent"


def click(browser, name):
    """With the mouse, as a person does; Browser.click calls the handler alone."""
    element = browser.ask("POST", "/element", {"using": "css selector", "value": f"#{name}"})
    browser.ask("POST", f"/element/{next(iter(element.values()))}/click", {})


def keys(browser, *moves):
    """(True, key) holds it down, (False, key) lets it go."""
    actions = [{"type": "keyDown" if down else "keyUp", "value": key} for down, key in moves]
    browser.ask("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})


def end_run(browser):
    click(browser, "end")
    browser.wait("it asks", "document.getElementById('ask').open")
    browser.run("document.querySelector('#ask button').click()")
    browser.wait("the end", text("state") + ".startsWith('Ended')", 30)
    return browser.wait("a verdict", "document.querySelector('#scores-panel h2')?.textContent", 30)


def do_lesson(browser, link):
    browser.open(link)
    browser.wait("who", text("who") + " === 'Learner'")
    instructions = browser.run("return " + text("lesson"))
    wanted_cm = float(re.search(r"(\d+) cm in", instructions)[1])
    click(browser, "pause")
    browser.wait("time goes on", f"{CLOCK} >= 1", 40)
    keys(browser, (True, " "))
    browser.wait("the pedal is down", "!document.getElementById('beam').hidden")
    assert browser.run("return " + text("state")).startswith("Running"), "Space paused the run"
    keys(browser, (True, "w"))
    browser.wait("as far in as the lesson says", f"parseFloat({IN_CM}) >= {wanted_cm}", 120)
    keys(browser, (False, "w"))
    there = browser.run(f"return {CLOCK}")
    browser.wait("a while in there", f"{CLOCK} >= {there + 3}", 40)
    assert end_run(browser) == "Not yet"
    said = browser.run("return " + text("scores-panel"))
    assert "The wire is out again: not done" in said and "press Close" in said, said
    assert browser.run("return " + text("end")) == "Close"

    second = browser.run(f"return {CLOCK}") - 1
    browser.run("const bar = document.getElementById('bar'); bar.focus();"
                "for (const key of ['End', 'ArrowLeft', 'Enter'])"
                "  bar.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}))")
    browser.wait("it asks", "document.getElementById('ask').open")
    browser.run("document.querySelector('#ask button').click()")
    browser.wait("back", f"!{text('state')}.startsWith('Ended') && {CLOCK} >= {second - 1}", 40)
    browser.wait("the picture says why keys are dead", text("held") + ".startsWith('paused: press Go on')")
    assert not browser.run("return document.getElementById('events-panel').hidden"), "the instructions are away"
    click(browser, "pause")
    keys(browser, (False, " "), (True, " "), (True, "s"))
    browser.wait("out", f"{IN_CM} === 'out'", 120)
    keys(browser, (False, "s"), (False, " "))
    said = end_run(browser), browser.run("return " + text("scores-panel"))
    assert said[0] == "Done" and "Next: Over the arch" in said[1], said
    click(browser, "end")
    browser.wait("it asks", "document.getElementById('ask').open")
    browser.run("document.querySelector('#ask button').click()")
    browser.wait("it says that it is closed", text("gone") + ".startsWith('The lesson is closed')")


def main(ostium):
    if not programs():
        return 1 if os.environ.get("CI") == "true" else 77
    with tempfile.TemporaryDirectory() as folder:
        with beside([ostium, "learn", "--out", folder]) as (run, browser):
            link = next(line for line in run.stdout if line.startswith("trainer: ")).split(": ", 1)[1].strip()
            do_lesson(browser, link)
            assert run.wait(30) == 0, "a lesson that is done ends with 0"
        kept = json.loads((pathlib.Path(folder) / "first-steps/progress.json").read_text(encoding="utf-8"))
        assert [one["done"] for one in kept["feed-and-turn"]] == [True], kept
    print("a beginner does the first lesson by its page")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
