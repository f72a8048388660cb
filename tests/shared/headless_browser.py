"""Run pages in a browser without a window, the installed Chromium, controlled by Playwright."""

import json
import shutil
from pathlib import Path

import axe_playwright_python
from playwright.sync_api import sync_playwright

FLAGS = ["no-sandbox", "disable-gpu", "disable-quic", "disable-sync", "disable-dev-shm-usage", "no-first-run"]
FLAGS += ["disable-background-networking", "disable-component-update"]
TROUBLE = ("error", "warning", "assert")
"""Types of console messages that a page must not cause."""
AXE = Path(axe_playwright_python.__file__).with_name("axe.min.js").read_text(encoding="utf-8")
"""Script of axe-core, which tests the accessibility of a page."""
TWO_FRAMES = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"


def executable() -> str | None:
    names = ("chromium", "chromium-browser", "google-chrome")
    return next((path for name in names if (path := shutil.which(name))), None)


class Browser:
    """One browser with one page. All problems of the page are collected in `problems`, all requests in `requests`."""

    def __init__(self, path: str):
        self.problems, self.requests = [], []
        self._playwright = sync_playwright().start()
        self._browser = self._playwright.chromium.launch(executable_path=path, args=[f"--{flag}" for flag in FLAGS])
        self.page = self._browser.new_page()
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("requestfailed", lambda request: self.problems.append(f"request failed: {request.failure}"))
        self.page.on("pageerror", lambda error: self.problems.append(f"exception: {error}"))
        self.page.on("console", self._note)

    def close(self):
        self._browser.close()
        self._playwright.stop()

    def open(self, url: str, width: int = 1200):
        """Open a page in a window of the given width, and wait until the page is loaded and drawn."""
        self.page.set_viewport_size({"width": width, "height": 900})
        self.problems.clear()
        self.requests.clear()
        self.page.goto(url)
        self.run(TWO_FRAMES)

    def resize(self, width: int):
        """Resize the window, and wait until the page is redrawn."""
        self.page.set_viewport_size({"width": width, "height": 900})
        self.run(TWO_FRAMES)

    def run(self, expression: str):
        """Return the value of a JavaScript expression on the page; a promise is awaited, an error is raised."""
        return self.page.evaluate(expression)

    def barriers(self, **options) -> list[tuple[str, str]]:
        """Return rule and place of each serious or critical finding of axe; `options` select the rules."""
        self.run(AXE)
        options = json.dumps({"resultTypes": ["violations"], **options})
        found = self.run(f"axe.run({options}).then(result => result.violations)")
        grave = [rule for rule in found if rule["impact"] in ("serious", "critical")]
        return [(rule["id"], str(node["target"])) for rule in grave for node in rule["nodes"]]

    def press(self, key: str):
        """Press a key in the focused element."""
        self.page.keyboard.press(key)

    def _note(self, message):
        if message.type in TROUBLE:
            self.problems.append(f"console: {message.text}")
