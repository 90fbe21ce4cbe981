"""`python -m benchmarks.page_stops`: whether every STOP of a page acts, and how soon.

The real page in Chromium, before a puppet for a robot. The page is clicked, typed into, resized,
cut off from its server, loaded anew and left looking back, at random, while other pages come and
go; then STOP is pressed, with the mouse or by Esc. It acted if the robot was told to stop. A page
that has no connection just then sends it once it has one: those are told apart.
"""

from __future__ import annotations

import os
import random
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from executive.frontends.console.desk import Desk
from executive.runs import run_folder
from robot.bringup import private_folder
from tests.fakes.browser import BROWSER, Browser, Page
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.served_page import served

PROMISED_MS = 50.0
GIVE_UP_S = 15.0
"""Wall time after which a STOP counts as lost; one that waits for a connection has 10 s."""
WORDS = ("walk", "the cup", "go to the table", "why", "pause", "\u202e\u0000", "x" * 5000, "no")
CLICKS = (
    "#follow", "#all", "#above", "#names", "#eye", "#layers summary", "#play", "#now", "#line",
    "[data-show=tree]", "[data-show=talk]", "[data-show=well]", "[data-show=jobs]",
    "[data-show=motors]", "[data-show=faults]", "#mic", "[data-do=pause]", "[data-do=resume]",
    "[data-do=cancel]", "#seen-large",
)  # fmt: skip
UNDER = (
    "(() => { const b = document.querySelector('#stop').getBoundingClientRect(), t ="
    " document.elementFromPoint(b.x + b.width / 2, b.y + b.height / 2);"
    " return JSON.stringify([b.x, b.y, innerWidth, innerHeight, t && t.id, page.linked,"
    " page.steers, document.visibilityState]); })()"
)
"""What lies where STOP is, for one that was lost."""
KEYS = ("f", "o", "t", "n", "c", " ", ",", ".", "/", "v", "Enter", "End")


def main(
    tries: Annotated[int, typer.Option(help="how often")] = 1000,
    *,
    seed: Annotated[int, typer.Option(help="of what is done before")] = 0,
) -> None:
    """Try, and print a table; exit status 1 if a STOP was lost."""
    if not BROWSER:
        raise SystemExit("there is no Chromium here (apt install chromium)")
    rng, spans_ms, done = random.Random(seed), dict[str, list[float]](), Counter[str]()
    lost: list[str] = []
    slow: list[tuple[float, str]] = []
    with tempfile.TemporaryDirectory() as made, Browser() as browser:
        folder = Path(made) / "run"
        run_folder.claim(folder)
        with puppet_shell(folder, []) as shell, steered(shell, folder) as url:
            stopped_s: list[float] = []
            before = shell.stop
            shell.stop = lambda why: (stopped_s.append(time.perf_counter()), before(why))[1]  # type: ignore[method-assign]
            page = opened(browser, url)
            for number in range(tries):
                acts = [one(browser, page, rng) for one in rng.choices(ACTS, k=rng.randint(1, 4))]
                done.update(acts)
                stopped_s.clear()
                shell.line("walk")
                page.call("Page.bringToFront")  # who presses STOP has the page before them
                page.eval("new Promise((done) => requestAnimationFrame(() => done(1)))")
                linked = bool(page.eval("page.linked && page.steers && page.live"))
                begun_s, how = time.perf_counter(), rng.choice(("mouse", "Esc"))
                page.eval("stop()") if not linked else press(page, how)
                while not stopped_s and time.perf_counter() - begun_s < GIVE_UP_S:
                    time.sleep(0.0005)
                state = how if linked else "without a connection"
                if stopped_s:
                    span_ms = 1e3 * (stopped_s[0] - begun_s)
                    spans_ms.setdefault(state, []).append(span_ms)
                    slow += [(span_ms, ", ".join(acts))] if span_ms > PROMISED_MS else []
                else:
                    lost.append(f"try {number}: {', '.join(acts)}; {state}; {page.eval(UNDER)}")
                if number % 50 == 49:
                    browser.close_pages()
                    page = opened(browser, url)
    print(f"{tries} tries, {len(lost)} lost; load {os.getloadavg()[0]:.1f}; {dict(done)}")
    for state, spans in spans_ms.items():
        p50, p99, worst = np.percentile(spans, [50, 99, 100])
        ms = f"{p50:.0f} / {p99:.0f} / {worst:.0f} ms (p50/p99/worst)"
        late = sum(span > PROMISED_MS for span in spans)
        print(f"  {state}: {len(spans)} times, {ms}, {late} above {PROMISED_MS:.0f} ms")
    for span_ms, told in sorted(slow, reverse=True)[:5]:
        print(f"  {span_ms:.0f} ms after: {told}")
    print("\n".join(lost))
    raise typer.Exit(int(bool(lost)))


def opened(browser: Browser, url: str) -> Page:
    """A page that steers."""
    page = browser.page(url)
    page.wait("page.drawn > 0 && page.steers")
    return page


def press(page: Page, how: str) -> None:
    """Press STOP as a person does, wherever it is now."""
    if how == "Esc":
        page.call("Input.dispatchKeyEvent", type="keyDown", key="Escape", windowsVirtualKeyCode=27)
        return
    x, y = page.eval(
        "(() => { const b = document.querySelector('#stop').getBoundingClientRect();"
        "return [b.x + b.width / 2, b.y + b.height / 2]; })()"
    )
    page.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, button="left", buttons=1,
              clickCount=1)  # fmt: skip
    page.call("Input.dispatchMouseEvent", type="mouseReleased", x=x, y=y, button="left", buttons=1,
              clickCount=1)  # fmt: skip


def click(_browser: Browser, page: Page, rng: random.Random) -> str:
    """Press something, whether it is there or not."""
    what = rng.choice(CLICKS)
    page.eval(f"document.querySelector({what!r})?.click()")
    return "click"


def keys(_browser: Browser, page: Page, rng: random.Random) -> str:
    """Press keys."""
    for name in rng.choices(KEYS, k=5):
        page.key(name)
    return "keys"


def paste(_browser: Browser, page: Page, rng: random.Random) -> str:
    """Paste into the line, and send it or not."""
    page.eval("document.querySelector('#line').focus()")
    page.type(rng.choice(WORDS))
    if rng.random() < 0.5:
        page.key("Enter")
    return "paste"


def resize(_browser: Browser, page: Page, rng: random.Random) -> str:
    """Become a phone, or anything else."""
    width, height = rng.choice(((390, 844), (844, 390), (1280, 800), (320, 480), (2560, 1440)))
    page.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
              deviceScaleFactor=1, mobile=width < 500)  # fmt: skip
    return "resize"


def cut(_browser: Browser, page: Page, _rng: random.Random) -> str:
    """Cut the connection."""
    page.eval("link.socket.close()")
    return "cut"


def anew(_browser: Browser, page: Page, _rng: random.Random) -> str:
    """Load the page anew."""
    page.call("Page.reload")
    page.wait("typeof stop === 'function' && page.drawn > 0 && page.steers")
    return "load anew"


def back(_browser: Browser, page: Page, rng: random.Random) -> str:
    """Look back."""
    page.eval(f"goTo(motion.end * {rng.random()})")
    return "look back"


def another(browser: Browser, page: Page, _rng: random.Random) -> str:
    """Another page comes, and goes without a word."""
    other = browser.page(page.eval("location.href"))
    other.wait("typeof link === 'object'")
    other.call("Page.close")
    browser.forget(other)
    return "another page"


ACTS: tuple[Callable[[Browser, Page, random.Random], str], ...] = (
    click, click, click, keys, keys, paste, paste, resize, cut, back, anew, another,
)  # fmt: skip


@contextmanager
def steered(shell: object, folder: Path) -> Generator[str]:
    """The address of a console of that shell."""
    private = private_folder.create()
    try:
        with (
            Desk(shell, folder=folder, private=private.path),  # type: ignore[arg-type]
            served(folder) as console,
        ):
            yield console.url
    finally:
        private_folder.remove(private)


if __name__ == "__main__":
    typer.run(main)
