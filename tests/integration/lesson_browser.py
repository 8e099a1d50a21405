#!/usr/bin/env python3
"""lesson_browser.py OSTIUM: lessons in a real Chromium, done by nothing but what the page says.

Mouse and keys are real ones, so that the focus is tested too: the first lesson is begun by Enter, and after Go on Space is
the pedal and not that button. Instructions tick themselves, a hint is asked for, the program is killed and started
again: the same lesson stands where it was. First the wire stays in, and the page says what is missing; then the lesson
goes on from an earlier second and is passed, the next one is opened and left from the page, and the course is closed.
Skipped (exit code 77) where there is no chromium or chromedriver; with CI=true that is a failure."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from browser import CLOCK, beside, programs, text

IN_CM = "document.querySelector('#tools tbody td:nth-child(2)').textContent"
LISTED = "!document.getElementById('course').hidden"
IN_LESSON = "document.getElementById('course').hidden && !document.getElementById('lesson').hidden"
# Signs of the instructions, "✔" where one has been done.
TICKS = "[...document.querySelectorAll('#lesson ol li .sign')].map((one) => one.textContent).join('')"
ENTER = "\ue007"


def click(browser, selector):
    """With the mouse, as a person does; Browser.click calls the handler alone."""
    element = browser.ask("POST", "/element", {"using": "css selector", "value": selector})
    browser.ask("POST", f"/element/{next(iter(element.values()))}/click", {})


def keys(browser, *moves):
    """(True, key) holds it down, (False, key) lets it go."""
    actions = [{"type": "keyDown" if down else "keyUp", "value": key} for down, key in moves]
    browser.ask("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})


def yes(browser):
    browser.wait("it asks", "document.getElementById('ask').open")
    browser.run("document.querySelector('#ask button').click()")


def end_run(browser):
    click(browser, "#end")
    yes(browser)
    browser.wait("the end", text("state") + ".startsWith('Ended')", 30)
    return browser.wait("a verdict", "document.querySelector('#scores-panel h2')?.textContent", 30)


def ticks(browser):
    return browser.run("return " + TICKS)


def link_of(run):
    return next(line for line in run.stdout if line.startswith("trainer: ")).split(": ", 1)[1].strip()


def begin(browser):
    """From the list, by the keyboard, until the wire lies as far in as the lesson says."""
    browser.wait("the list", f"{LISTED} && document.querySelector('#course li:nth-child(10)')")
    locked = browser.run("return document.querySelectorAll('#course details.locked').length")
    assert locked == 9, f"{locked} lessons are locked at first"
    assert browser.run("return document.activeElement.textContent") == "Begin", "the next lesson's button has the focus"
    keys(browser, (True, ENTER), (False, ENTER))
    browser.wait("the lesson", IN_LESSON, 40)
    assert browser.run("return " + text("who")) == "Learner"
    assert ticks(browser) == "▸○○○○○·"
    assert "answer" not in browser.run("return " + text("numbers")), "before the first step nothing has been measured"
    wanted_cm = float(re.search(r"(\d+) cm in", browser.run("return " + text("lesson")))[1])
    click(browser, "#sound")
    click(browser, "#pause")
    browser.wait("time goes on", f"{CLOCK} >= 1", 40)
    browser.wait("a tone at each R wave", "document.getElementById('sound').dataset.tones >= 2", 30)
    click(browser, "#sound")
    keys(browser, (True, " "))
    browser.wait("the pedal is down", "!document.getElementById('beam').hidden")
    assert browser.run("return " + text("state")).startswith("Running"), "Space paused the run"
    keys(browser, (True, "q"), (False, "q"))
    browser.wait("a hint", text("hint-words") + ".includes('The expert pushes the wire in')")
    keys(browser, (True, "w"))
    browser.wait("as far in as the lesson says", f"parseFloat({IN_CM}) >= {wanted_cm}", 120)
    keys(browser, (False, "w"))
    browser.wait("what has been done is ticked", f"{TICKS} === '✔✔✔▸✔○·'")
    there = browser.run(f"return {CLOCK}")
    browser.wait("a while in there", f"{CLOCK} >= {there + 3}", 40)
    keys(browser, (False, " "))
    return wanted_cm


def bar_stands_still(browser):
    """Under the mouse; until then it shows all of the run, however long that has got."""
    browser.wait("longer than the bar at first", f"{CLOCK} >= 22", 60)
    left, top, width = browser.run("const box = document.getElementById('bar').getBoundingClientRect();"
                                   "return [box.left, box.top, box.width]")
    move = {"type": "pointerMove", "x": int(left + width / 2), "y": int(top) + 10, "duration": 0}
    chosen = "document.getElementById('bar').getAttribute('aria-valuenow')"
    seen = []
    for x in (0, 1, 0):  # each time it asks which second lies there
        browser.ask("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [{**move, "x": move["x"] + x}]}]})
        begun = browser.run(f"return {CLOCK}")
        browser.wait("time goes on", f"{CLOCK} >= {begun + 3}", 60)
        seen.append(browser.run("return " + chosen))
    assert len(set(seen)) == 1, f"the bar moved under the mouse: {seen}"


def pass_lesson(browser, wanted_cm):
    """After the program was killed."""
    browser.wait("the same lesson", IN_LESSON, 40)
    browser.wait("where it was", f"{CLOCK} >= 4 && parseFloat({IN_CM}) >= {wanted_cm}", 40)
    assert ticks(browser) == "✔✔✔▸✔○·", ticks(browser)
    assert "hint asked" in browser.run("return " + text("events")), "what had happened is told again"
    browser.wait("the picture says why keys are dead", text("held") + ".startsWith('paused: press Go on')")
    click(browser, "#pause")
    assert end_run(browser) == "Not yet"
    said = browser.run("return " + text("scores-panel"))
    assert "The wire is out again: not done. Expected: nothing of it is in the body" in said, said
    assert re.search(r"Draw it all the way out with S\. \(did not happen\)", said), said
    assert browser.run("return " + text("end")) == "All lessons"

    second = browser.run(f"return {CLOCK}") - 1
    browser.run("const bar = document.getElementById('bar'); bar.focus();"
                "for (const key of ['End', 'ArrowLeft', 'Enter'])"
                "  bar.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}))")
    yes(browser)
    browser.wait("back", f"!{text('state')}.startsWith('Ended') && {CLOCK} >= {second - 1}", 40)
    browser.wait("the picture says why keys are dead", text("held") + ".startsWith('paused: press Go on')")
    assert not browser.run("return document.getElementById('events-panel').hidden"), "the instructions are away"
    click(browser, "#pause")
    keys(browser, (True, " "), (True, "d"))
    browser.wait("turned", f"{TICKS}.startsWith('✔✔✔✔✔')", 40)
    bar_stands_still(browser)
    keys(browser, (False, "d"), (True, "s"))
    browser.wait("out", f"{IN_CM} === 'out'", 120)
    keys(browser, (False, "s"), (False, " "))
    browser.wait("all is ticked, and the last words come next", f"{TICKS} === '✔✔✔✔✔✔▸'")
    assert end_run(browser) == "Passed"
    return browser.wait("the next", "document.getElementById('next-lesson')?.textContent")


def open_next(browser):
    """The next lesson, from the verdict; back to the list; and the course is closed."""
    click(browser, "#next-lesson")
    browser.wait("the next lesson", f"{IN_LESSON} && {text('title')} === '2 of 10: Over the arch'", 40)
    browser.wait("it waits", text("held") + ".startsWith('paused: press Go on')")
    click(browser, "#to-lessons")
    yes(browser)
    browser.wait("the list", LISTED, 30)
    first, second = browser.run("return [1, 2].map((n) => document.querySelector(`#course li:nth-child(${n}) details`).className)")
    assert (first, second) == ("passed", "next"), (first, second)
    click(browser, "#close-course")
    browser.wait("it says that it is closed", text("gone") + ".startsWith('The course is closed')")


def main(ostium):
    if not programs():
        return 1 if os.environ.get("CI") == "true" else 77
    with tempfile.TemporaryDirectory() as folder:
        command = [ostium, "learn", "--out", folder]
        attempt = pathlib.Path(folder) / "first-steps/feed-and-turn-1"
        with beside(command) as (run, browser):
            browser.open(link_of(run))
            wanted_cm = begin(browser)
            run.kill()
            run.wait()
            browser.wait("it says what to do", text("gone") + ".includes('start ostium learn again')")
            again = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
            try:
                browser.open(link_of(again))
                assert pass_lesson(browser, wanted_cm) == "Next: Over the arch"
                open_next(browser)
                assert again.wait(30) == 0, "a course that is closed ends with 0"
            finally:
                again.kill()
            others = [one for one in browser.complaints() if "ERR_CONNECTION" not in one]  # while there was no program
            assert not others, others
        kept = json.loads((attempt.parent / "progress.json").read_text(encoding="utf-8"))
        assert [(one["done"], one["hints_asked"]) for one in kept["feed-and-turn"]] == [(True, 1)], kept
        assert sorted(file.name for file in attempt.glob("*.h5")) == ["branch-2.h5", "branch-3.h5", "run.h5"]
        metrics = json.loads((attempt / "metrics.json").read_text(encoding="utf-8"))["metrics"]
        assert next(one["value"] for one in metrics if one["name"] == "hints_asked") == 1
        subprocess.run([ostium, "replay", attempt / "branch-3.h5", "--verify"], check=True, stdout=subprocess.DEVNULL)
    print("a beginner does the first lesson by its page, and opens the next")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
