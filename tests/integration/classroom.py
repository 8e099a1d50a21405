#!/usr/bin/env python3
"""classroom.py OSTIUM: a course's server, asked as its page asks: what cannot be opened or kept is told, and it stays."""
import base64
import json
import os
import pathlib
import re
import resource
import signal
import socket
import subprocess
import sys
import tempfile
import time

REPO = pathlib.Path(__file__).resolve().parents[2]
OSTIUM = str(pathlib.Path(sys.argv[1]).resolve())


class Client:
    """The page's side of a WebSocket (RFC 6455)."""

    def __init__(self, link):
        port, token = int(re.search(r":(\d+)/", link)[1]), link.strip().split("token=")[1]
        self.socket = socket.create_connection(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /socket HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\n"
                             f"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                             "Sec-WebSocket-Version: 13\r\n\r\n").encode())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            self.take_more(10)
        self.bytes = self.bytes.split(b"\r\n\r\n", 1)[1]
        self.say({"do": "hello", "token": token})

    def say(self, order):
        text, mask = json.dumps(order).encode(), os.urandom(4)
        head = bytes([0x81, 0x80 | len(text)]) if len(text) < 126 else bytes([0x81, 0xFE]) + len(text).to_bytes(2, "big")
        self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(text)))

    def take_more(self, seconds):
        self.socket.settimeout(seconds)
        more = self.socket.recv(65536)
        if not more:
            raise SystemExit("the server has gone")
        self.bytes += more

    def frame(self, seconds):
        def need(count):
            while len(self.bytes) < count:
                self.take_more(seconds)
        need(2)
        last, kind, size, at = self.bytes[0] & 0x80, self.bytes[0] & 0x0F, self.bytes[1] & 0x7F, 2
        if size >= 126:
            at = 4 if size == 126 else 10
            need(at)
            size = int.from_bytes(self.bytes[2:at], "big")
        need(at + size)
        body, self.bytes = self.bytes[at:at + size], self.bytes[at + size:]
        return (kind, body) if last else (kind, body + self.frame(seconds)[1])

    def wait(self, what, is_it, seconds=60):
        """The first message of which that is true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            kind, body = self.frame(seconds)
            if kind == 1 and is_it(message := json.loads(body)):
                return message
        raise SystemExit(f"{what}: did not come")


def course_of(folder, spoil):
    course = json.loads((REPO / "data/courses/first-steps.json").read_text(encoding="utf-8"))
    course["name"], course["lessons"] = "mine", course["lessons"][:2]
    spoil(course["lessons"])
    file = folder / "mine.json"
    file.write_text(json.dumps(course), encoding="utf-8")
    return file


class Program:
    def __init__(self, folder, *arguments, largest_file=None):
        self.log = folder / "log"
        limit = (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file,) * 2)) if largest_file else None
        self.process = subprocess.Popen([OSTIUM, *map(str, arguments)], cwd=folder, stdout=subprocess.PIPE, text=True,
                                        stderr=open(self.log, "w", encoding="utf-8"), preexec_fn=limit)
        link = ""
        while "trainer: " not in link:
            link = self.process.stdout.readline()
            assert link, self.log.read_text(encoding="utf-8")
        self.page = Client(link)

    def __enter__(self):
        return self.page

    def __exit__(self, failed, *_):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(30)
        if failed:
            print(self.log.read_text(encoding="utf-8"))


def of(kind, **values):
    return lambda message: message["type"] == kind and all(message.get(k) == v for k, v in values.items())


def a_lesson_that_cannot_be_opened(folder):
    course = course_of(folder, lambda lessons: lessons[0].update(
        instructions=[{"text": "There.", "until": [{"tip_passes": "mars"}]}]))
    # A lesson that is in the course no more was open last.
    kept = folder / "ostium-learn/mine/progress.json"
    kept.parent.mkdir(parents=True)
    kept.write_text('{"gone": [{"attempt": 1, "done": false, "open": true}], '
                    '"over-the-arch": [{"attempt": 1, "done": false, "open": false}]}', encoding="utf-8")
    with Program(folder, "learn", course) as page:
        page.say({"do": "lesson", "values": [0, 0]})
        board = page.wait("why it cannot be opened", lambda m: m["type"] == "course" and m["problem"])
        assert "mars" in board["problem"] and board["at"] is None, board
        page.say({"do": "lesson", "values": [1, 0]})
        page.wait("another lesson", of("welcome"))


def a_verdict_that_cannot_be_kept(folder):
    kept = folder / "ostium-learn/mine/progress.json"
    with Program(folder, "learn", course_of(folder, lambda lessons: None)) as page:
        page.say({"do": "lesson", "values": [0, 0]})
        page.wait("the lesson", of("welcome"))
        kept.unlink()
        kept.mkdir()
        page.say({"do": "end"})
        page.wait("the end", of("ended"))
        board = page.wait("what is not kept", lambda m: m["type"] == "course" and m["problem"])
        assert "progress.json" in board["problem"], board
        kept.rmdir()
        page.say({"do": "course"})
        page.wait("the list", of("course", at=None, problem=""))
    attempt, = json.loads(kept.read_text(encoding="utf-8"))["feed-and-turn"]
    assert attempt["ended"] and attempt["missed"], attempt


def a_recording_that_fails(folder):
    with Program(folder, "serve", "rca-mid-focal", "--hands", "browser", "--out", "out", "--go", "--no-report",
                 largest_file=100_000) as page:
        page.wait("the word as it fails", lambda m: m["type"] == "refused" and "nothing is recorded" in m["why"])
        page.wait("it goes on", of("now", paused=False))


def a_branch_that_cannot_be_written(folder):
    with Program(folder, "serve", "rca-mid-focal", "--hands", "browser", "--out", "out", "--go", "--no-report") as page:
        page.wait("two seconds", lambda m: m["type"] == "now" and m["s"] > 2)
        page.say({"do": "mark", "text": "kept"})
        (folder / "out/branch-2.h5").mkdir()
        page.say({"do": "rewind", "values": [1]})
        page.wait("why it cannot go back", lambda m: m["type"] == "refused" and "cannot go on from 1 s" in m["why"])
        page.wait("the end, where it was left", of("ended"))
        (folder / "out/branch-2.h5").rmdir()
        page.say({"do": "rewind", "values": [1]})
        page.wait("the branch", of("branch", recording="branch-2.h5"))
    note, = json.loads((folder / "out/notes.json").read_text(encoding="utf-8"))
    assert note["note"] == "kept" and note["recording"] == "run.h5", note


def person_and_instruments_are_chosen(folder):
    with Program(folder, "play") as page:
        board = page.wait("the list", lambda m: m["type"] == "course" and m["chooses_person"])
        assert board["person"] is None
        page.say({"do": "person", "values": [1.5]})
        page.wait("half a person", lambda m: m["type"] == "refused" and "whole number" in m["why"])
        page.say({"do": "person", "values": [4]})
        board = page.wait("person 4", of("course", person=4))
        place = next(i for i, one in enumerate(board["lessons"]) if one["title"].startswith("Focal stenosis of the middle right"))
        assert "(person 4)" in board["lessons"][place]["title"], board["lessons"][place]["title"]
        guide = next(tool for tool in board["lessons"][place]["tools"] if tool["name"] == "guide")
        assert "guide-al1-6f" in guide["others"] and "wire-014-workhorse" not in guide["others"], guide
        page.say({"do": "lesson", "values": [place, 1], "set": ["guide=wire-014-workhorse"]})
        page.wait("a wire is no guide", lambda m: m["type"] == "refused" and "on the lesson's list" in m["why"])
        page.say({"do": "lesson", "values": [place, 1], "set": ["guide=guide-al1-6f"]})
        welcome = page.wait("the lesson", of("welcome"), 120)
        assert any(tool["name"] == "guide" and "Amplatz" in tool["title"] for tool in welcome["tools"]), welcome["tools"]
    (attempts,) = json.loads((folder / "ostium-play/procedures/progress.json").read_text(encoding="utf-8")).values()
    assert attempts[0]["set"] == ["guide=guide-al1-6f"], attempts


def an_exam_tells_nothing_and_ends_by_itself(folder):
    trials = json.loads((REPO / "data/study/template/trials.json").read_text(encoding="utf-8"))
    trials["lessons"] = trials["lessons"][1:3]
    trials["lessons"][0]["limit_min"] = 0.03
    (folder / "trials.json").write_text(json.dumps(trials), encoding="utf-8")
    with Program(folder, "learn", folder / "trials.json", "--lesson", "trial-1") as page:
        welcome = page.wait("the trial", of("welcome"), 120)
        assert welcome["lesson"]["exam"] and not welcome["goes_back"]
        for order, why in (({"do": "hint"}, "no hint"), ({"do": "rewind", "values": [0]}, "cannot go back"),
                           ({"do": "lesson", "values": [0, 2]}, "it is an exam")):
            page.say(order)
            page.wait(why, lambda m, w=why: m["type"] == "refused" and w in m["why"])
        told = set()
        page.say({"do": "pause"})
        page.wait("the end", lambda m: told.add(m["type"]) or m["type"] == "ended")
        assert "scores" not in told, told
        page.wait("the next one opens", lambda m: m["type"] == "course" and m["lessons"][0]["done"] and not m["lessons"][1]["locked"])


for test in (person_and_instruments_are_chosen, an_exam_tells_nothing_and_ends_by_itself,
             a_lesson_that_cannot_be_opened, a_verdict_that_cannot_be_kept, a_recording_that_fails,
             a_branch_that_cannot_be_written):
    with tempfile.TemporaryDirectory() as made:
        test(pathlib.Path(made))
