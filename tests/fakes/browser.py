"""A real browser without a window, driven by its DevTools protocol."""

from __future__ import annotations

import base64
import itertools
import json
import re
import shutil
import subprocess
import tempfile
import time
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.fakes.waiting import HANG_S

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), ""
)
START_S, ANSWER_S, POLL_S = HANG_S, HANG_S, 0.05


class Browser:
    """A context manager; pages are opened by `page`."""

    def __init__(self, *more: str) -> None:
        """Start it, with more options than it always has."""
        self._folder = tempfile.TemporaryDirectory(prefix="humanoid-browser-")
        command = [
            BROWSER, "--headless=new", "--no-sandbox", "--remote-debugging-port=0",
            "--remote-allow-origins=*", f"--user-data-dir={self._folder.name}", "--no-first-run",
            "--disable-background-networking", "--disable-extensions", "--mute-audio",
            "--use-angle=swiftshader", "--enable-unsafe-swiftshader", *more, "about:blank",
        ]  # fmt: skip
        self._process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self._address = self._found()
        self._pages: list[Page] = []

    def _found(self) -> str:
        told = Path(self._folder.name) / "DevToolsActivePort"
        until_s = time.monotonic() + START_S
        while time.monotonic() < until_s:
            lines = told.read_text().split() if told.is_file() else []
            if len(lines) == 2:
                return f"127.0.0.1:{lines[0]}{lines[1]}"
            time.sleep(POLL_S)
        self.close()
        raise TimeoutError("the browser did not start")

    def page(self, url: str, *, width: int = 1280, height: int = 800, mobile: bool = False) -> Page:
        """Open a page in a window of its own."""
        browser = Devtools(f"ws://{self._address}")
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        browser.close()
        base = self._address.split("/", maxsplit=1)[0]
        page = Page(f"ws://{base}/devtools/page/{target}")
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=mobile)  # fmt: skip
        page.call("Runtime.enable")
        page.call("Page.enable")
        page.call("Page.navigate", url=url)
        self._pages.append(page)
        return page

    def forget(self, page: Page) -> None:
        """A page has been closed by itself."""
        self._pages.remove(page)
        page.close()

    def close_pages(self) -> None:
        """Close every page that is open: one that nobody looks at is drawn on, by a whole core."""
        for page in self._pages:
            with suppress(ConnectionClosed):  # which may be quicker than the answer
                page.call("Page.close")
            page.close()
        self._pages.clear()

    def close(self) -> None:
        """End the browser."""
        for page in getattr(self, "_pages", []):
            page.close()
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        for _ in range(20):  # its helpers may still be writing there
            try:
                self._folder.cleanup()
                return
            except OSError:
                time.sleep(POLL_S)

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Devtools:
    """One end of the protocol."""

    def __init__(self, url: str) -> None:
        self._ends = ExitStack()
        self._socket = self._ends.enter_context(
            connect(url, max_size=None, compression=None, open_timeout=ANSWER_S, ping_interval=None)
        )
        self._numbers = itertools.count(1)
        self.events: list[dict[str, Any]] = []

    def call(self, method: str, **params: Any) -> dict[str, Any]:
        """Ask, and wait for the answer."""
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": params}))
        until_s = time.monotonic() + ANSWER_S
        while time.monotonic() < until_s:
            told = json.loads(self._socket.recv(timeout=ANSWER_S))
            if told.get("id") == number:
                if "error" in told:
                    raise RuntimeError(f"{method}: {told['error']}")
                return told["result"]
            self.events.append(told)
        raise TimeoutError(method)

    def close(self) -> None:
        """Say no more."""
        self._ends.close()


class Page(Devtools):
    """One page."""

    def eval(self, text: str) -> Any:
        """The value of an expression in the page."""
        told = self.call("Runtime.evaluate", expression=text, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in told:
            raise RuntimeError(told["exceptionDetails"]["exception"].get("description", text))
        return told["result"].get("value")

    def wait(self, text: str, *, most_s: float = HANG_S) -> Any:
        """Wait until an expression is true, and give its value."""
        until_s, wrong = time.monotonic() + most_s, ""
        while time.monotonic() < until_s:
            try:
                if value := self.eval(text):
                    return value
            except RuntimeError as error:  # the page is not there yet
                wrong = str(error)
            time.sleep(POLL_S)
        raise TimeoutError(f"{text} did not come true; {wrong} {self.mistakes()}")

    def mistakes(self) -> list[str]:
        """What went wrong in the page's scripts, and what its policy refused."""
        self.eval("1")
        wrong = [one for one in self.events if one["method"] == "Runtime.exceptionThrown"]
        logged = [
            one for one in self.events
            if one["method"] == "Runtime.consoleAPICalled" and one["params"]["type"] == "error"
        ]  # fmt: skip
        return [json.dumps(one["params"])[:2000] for one in (*wrong, *logged)]

    def click(self, selector: str) -> None:
        """Press the middle of an element with the mouse, once it rests.

        Again if it had moved, or if the press reached nothing: a page that was not painted yet
        drops it.
        """
        self.call("Page.bringToFront")
        until_s = time.monotonic() + HANG_S
        while time.monotonic() < until_s:
            before, at = None, self._middle(selector)
            while at != before:
                time.sleep(POLL_S)
                before, at = at, self._middle(selector)
            self.eval(
                "window.hit = false; addEventListener('pointerdown', (event) => { window.hit ="
                f" Boolean(event.target.closest({json.dumps(selector)})); }},"
                " { capture: true, once: true })"
            )
            for kind in ("mousePressed", "mouseReleased"):
                self.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left",
                          buttons=1, clickCount=1)  # fmt: skip
            if self.eval("window.hit") is not False:  # None: it led to another page
                return
        raise TimeoutError(f"{selector} is not under the mouse: it moves, or something covers it")

    def _middle(self, selector: str) -> list[float]:
        return self.eval(
            f"(() => {{ const b = document.querySelector({json.dumps(selector)})"
            ".getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()"
        )

    def hold(self, selector: str, hold_s: float) -> None:
        """Press the middle of an element, and let it go after a while."""
        self.call("Page.bringToFront")
        x, y = self._middle(selector)
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1,
                      clickCount=1)  # fmt: skip
            if kind == "mousePressed":
                time.sleep(hold_s)

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Drag with the left button."""
        for kind, (x, y) in (("mousePressed", start), ("mouseMoved", end), ("mouseReleased", end)):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1)

    def key(self, name: str) -> None:
        """Press a key."""
        self.call("Page.bringToFront")
        code = {"Escape": 27, "Enter": 13}.get(name, 0)
        text = "\r" if name == "Enter" else name if len(name) == 1 else ""
        self.call("Input.dispatchKeyEvent", type="keyDown", key=name, text=text,
                  windowsVirtualKeyCode=code)  # fmt: skip
        self.call("Input.dispatchKeyEvent", type="keyUp", key=name, windowsVirtualKeyCode=code)

    def type(self, text: str) -> None:
        """Type into what has the focus."""
        self.call("Input.insertText", text=text)

    def screenshot(self, path: Path | str) -> None:
        """Keep a picture of it."""
        told = self.call("Page.captureScreenshot", format="png")
        Path(path).write_bytes(base64.b64decode(told["data"]))

    def text(self, selector: str = "body") -> str:
        """What can be read of an element, blanks made one."""
        text = self.eval(f"document.querySelector({json.dumps(selector)}).innerText") or ""
        return re.sub(r"\s+", " ", text)
