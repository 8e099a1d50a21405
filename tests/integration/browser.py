"""A real Chromium, moved by WebDriver, for tests and pictures of the trainer's station."""
import base64
import contextlib
import json
import pathlib
import re
import shutil
import subprocess
import time
import urllib.request


def programs():
    """chromedriver and chromium; None and a word where one is missing."""
    found = shutil.which("chromedriver"), shutil.which("chromium")
    if all(found):
        return found
    print("there is no chromium with chromedriver; expected packages chromium and chromium-driver")
    return None


class Browser:
    def __init__(self, width=1600, height=900):
        driver, binary = programs()
        self.process = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, text=True)
        for line in self.process.stdout:
            if found := re.search(r"successfully on port (\d+)", line):
                self.url = f"http://127.0.0.1:{found[1]}"
                break
        options = {"binary": binary, "args": ["--headless=new", "--no-sandbox", "--disable-gpu",
                                              "--disable-dev-shm-usage", f"--window-size={width},{height}"]}
        wanted = {"alwaysMatch": {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}}
        session = self.ask("POST", "/session", {"capabilities": wanted})["sessionId"]
        self.url += f"/session/{session}"

    def ask(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.url + path, data, {"Content-Type": "application/json"}, method=method)
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.load(answer)["value"]

    def open(self, link):
        self.ask("POST", "/url", {"url": "about:blank"})
        self.ask("POST", "/url", {"url": link})

    def run(self, script, *arguments):
        return self.ask("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait(self, what, script, seconds=20):
        """`seconds` of a machine that does nothing else: three tests at a time on two cores take several of these."""
        patience = 4
        end = time.monotonic() + patience * seconds
        while time.monotonic() < end:
            if found := self.run("return " + script):
                return found
            time.sleep(0.1)
        raise AssertionError(f"never: {what} ({script}); the page says: {self.run('return document.body.innerText')[:600]}")

    def click(self, name):
        self.run("document.getElementById(arguments[0]).click()", name)

    def press(self, words):
        """The button that says this."""
        self.run("[...document.querySelectorAll('button')].find((one) => one.textContent === arguments[0]).click()", words)

    def picture(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.ask("GET", "/screenshot")))

    def complaints(self):
        return [entry["message"] for entry in self.ask("POST", "/se/log", {"type": "browser"})
                if entry["level"] in ("SEVERE", "WARNING")]

    def close(self):
        try:
            self.ask("DELETE", "")
        finally:
            self.process.terminate()
            self.process.wait()


@contextlib.contextmanager
def beside(command):
    """A program that serves a page, and a browser beside it; both are ended whatever happens."""
    run = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    browser = None
    try:
        browser = Browser()
        yield run, browser
    finally:
        if browser:
            browser.close()
        if run.poll() is None:
            run.terminate()
            run.wait(30)


def text(name):
    return f"document.getElementById('{name}').textContent"


CLOCK = f"(([m, s]) => 60 * m + 1 * s)({text('clock')}.split(':'))"
# Whether a canvas shows anything but one colour.
DRAWN = """(() => { const c = document.getElementById('%s'), p = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  for (let i = 4; i < p.length; i += 4) if (p[i] !== p[0] || p[i + 1] !== p[1]) return true; return false; })()"""
