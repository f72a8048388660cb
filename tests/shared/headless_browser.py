"""A real browser without a window: Chromium, spoken to over a pipe in its DevTools protocol."""

import base64
import json
import os
import shutil
import subprocess

FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
    "--hide-scrollbars",
    "--remote-debugging-pipe",
]
COMMANDS, ANSWERS = 3, 4
"""The file descriptors at which Chromium expects the pipe."""


def executable() -> str | None:
    names = ("chromium", "chromium-browser", "google-chrome")
    return next((path for name in names if (path := shutil.which(name))), None)


class Browser:
    """One browser with one tab. What goes wrong on a page is collected in `problems`, every request in `requests`."""

    def __init__(self, path: str, profile):
        self._last, self._events, self._session = 0, [], None
        self.problems, self.requests = [], []
        read_commands, self._out = os.pipe()
        self._in, write_answers = os.pipe()

        def connect():
            # First out of the way, in case a pipe has one of the two numbers already.
            there, back = os.dup(read_commands), os.dup(write_answers)
            os.dup2(there, COMMANDS)
            os.dup2(back, ANSWERS)

        self._process = subprocess.Popen(
            [path, *FLAGS, f"--user-data-dir={profile}"],
            preexec_fn=connect,
            pass_fds=(COMMANDS, ANSWERS),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(read_commands)
        os.close(write_answers)
        self._reader = os.fdopen(self._in, "rb")
        self._pending = b""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")

    def close(self):
        self._session = None
        self.call("Browser.close")
        self._process.wait()
        self._reader.close()
        os.close(self._out)

    def call(self, method: str, **parameters) -> dict:
        """The answer to one command.

        Raises:
            RuntimeError: the browser refuses the command.
        """
        self._last += 1
        message = {"id": self._last, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == self._last:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def open(self, url: str, width: int = 1200, height: int = 900):
        """Load a page in a window of this size, and wait until it has loaded and drawn."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.problems, self.requests, self._events = [], [], []
        self.call("Page.navigate", url=url)
        while "Page.loadEventFired" not in self._events:
            self._next()
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def run(self, expression: str):
        """The value of a JavaScript expression on the page, a promise awaited.

        Raises:
            RuntimeError: it throws.
        """
        given = {"expression": expression, "returnByValue": True, "awaitPromise": True}
        answer = self.call("Runtime.evaluate", **given)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def press(self, key: str, times: int = 1):
        """Press a key on what has the focus."""
        codes = {"ArrowRight": 39, "ArrowLeft": 37, "Tab": 9, "Enter": 13, " ": 32, "Home": 36, "End": 35}
        for kind in ("rawKeyDown", "keyUp") * times:
            if kind == "rawKeyDown" and key in (" ", "Enter"):
                text = {"text": "\r" if key == "Enter" else key}
                self.call("Input.dispatchKeyEvent", type="keyDown", key=key, windowsVirtualKeyCode=codes[key], **text)
            else:
                self.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=codes[key])

    def screenshot(self, path, tallest: int = 6000):
        """The whole page as a PNG, as far as `tallest` pixels down."""
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], tallest), "scale": 1}
        answer = self.call("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(base64.b64decode(answer["data"]))

    def _next(self) -> dict:
        """The next message; events are noted on the way."""
        while b"\0" not in self._pending:
            part = os.read(self._in, 1 << 20)
            if not part:
                raise RuntimeError("the browser has closed the connection")
            self._pending += part
        message, self._pending = self._pending.split(b"\0", 1)
        message = json.loads(message)
        if "method" in message and message.get("sessionId") == self._session:
            self._note(message["method"], message["params"])
        return message

    def _note(self, method: str, what: dict):
        self._events.append(method)
        if method == "Network.requestWillBeSent":
            self.requests.append(what["request"]["url"])
        elif method == "Network.loadingFailed":
            self.problems.append(f"request failed: {what['errorText']}")
        elif method == "Runtime.exceptionThrown":
            self.problems.append(f"exception: {what['exceptionDetails']}")
        elif method == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning", "assert"):
            self.problems.append(f"console: {[argument.get('value') for argument in what['args']]}")
        elif method == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
            self.problems.append(f"log: {what['entry']['text']}")
