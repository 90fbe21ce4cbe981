"""`python -m benchmarks.console_page`: how soon the page shows the robot, and what it costs.

Three parts, all with the real page in Chromium:

- *first*: from the start of the command to the first picture, in a browser that is open;
- *watched*: a live robot walks, with nobody looking and with two pages, in turns; the loops' late
  share, the console's share of a core, and the pictures a second of each page;
- *large*: a run of an hour with a tree of 1,000 nodes is loaded and looked through;

Chromium draws with the processor here where there is no graphics card: then its pictures are fewer,
and it takes what the robot has of the machine. Both are printed; loads as well.
"""

from __future__ import annotations

import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Annotated, Any

import msgspec
import typer

from executive.journal import journal, motion
from executive.journal.motion import Moment
from robot.model import description
from tests.fakes.browser import BROWSER, Browser, Page
from tests.fakes.long_run import LongRun

COMMAND = (sys.executable, "-c", "from executive.frontends.cli import main; main()")
ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/#\S+")
LATE = re.compile(r"([\w ]+): (\d+) of (\d+) periods late")
PICTURE = "typeof page === 'object' && page.scene && page.drawn > 0 && motion.times.length > 0"


def main(
    parts: Annotated[str, typer.Option(help="with commas between")] = "first,watched,large",
    *,
    times: Annotated[int, typer.Option(help="of first; turns of watched")] = 3,
    walk_s: Annotated[float, typer.Option(help="of a turn")] = 40.0,
) -> None:
    """Measure, and print."""
    if not BROWSER:
        raise SystemExit("there is no Chromium here (apt install chromium)")
    with tempfile.TemporaryDirectory() as folder, Browser() as browser:
        for part in parts.split(","):
            found = PARTS[part](browser, Path(folder), times, walk_s)
            print(f"{part} (load {os.getloadavg()[0]:.1f}): {json.dumps(found)}", flush=True)


def first(browser: Browser, folder: Path, times: int, _walk_s: float) -> dict[str, Any]:
    """From the start of a command to the first picture: wall time, and the processor time of it."""
    seen: dict[str, list[tuple[float, float]]] = {"walk --fast --view": [], "console RUN": []}
    for number in range(times):
        run = folder / f"first-{number}"
        walk = ("walk", "--fast", "--for", "60", "--view", "--run-dir", str(run))
        seen["walk --fast --view"].append(_until_picture(browser, walk, folder))
        seen["console RUN"].append(_until_picture(browser, ("console", str(run)), folder))
    return {
        name: {
            "p50 [s]": statistics.median(wall_s for wall_s, _ in one),
            "worst [s]": max(wall_s for wall_s, _ in one),
            "of processor time before it [s]": statistics.median(cpu_s for _, cpu_s in one),
        }
        for name, one in seen.items()
    }


def _until_picture(browser: Browser, command: tuple[str, ...], folder: Path) -> tuple[float, float]:
    """Wall time [s], and processor time [s] of command and console up to then; not the browser's.

    Of a command with --view its own share ends as the address is told: physics goes on beside it.
    """
    begun_s = time.monotonic()
    with _started(command, folder) as process:
        address = _address(process)
        cpu_s = _cpu_s(process.pid)
        page = browser.page(address)
        page.wait(PICTURE)
        took_s = time.monotonic() - begun_s
        viewed = "--view" in command
        cpu_s = cpu_s + _cpu_s(_console_of(process.pid)) if viewed else _cpu_s(process.pid)
        browser.close_pages()
        _end(process)
    return round(took_s, 2), round(cpu_s, 2)


def watched(browser: Browser, folder: Path, times: int, walk_s: float) -> dict[str, Any]:
    """Late shares with nobody and with two pages, in turns, and what the console costs."""
    late: dict[int, list[int]] = {0: [0, 0], 2: [0, 0]}
    shares: list[float] = []
    drawn: list[float] = []
    told: list[float] = []
    for number in range(2 * times):
        pages = 2 if number % 4 in (1, 2) else 0  # ABBA
        run = folder / f"watched-{number}"
        command = (
            "walk",
            "--for",
            str(walk_s),
            "--run-dir",
            str(run),
            *(("--view",) if pages else ()),
        )
        with _started(command, folder) as process:
            if pages:
                address = _address(process)
                views: list[Page] = []
                for _ in range(pages):  # one after the other: a page behind another draws nothing
                    views.append(browser.page(address))
                    views[-1].wait(PICTURE)
                console = _console_of(process.pid)
                begun = _cpu_s(console), time.monotonic(), [_counts(view) for view in views]
                time.sleep(0.4 * walk_s)
                span_s = time.monotonic() - begun[1]
                shares.append((_cpu_s(console) - begun[0]) / span_s)
                for view, before in zip(views, begun[2], strict=True):
                    after = _counts(view)
                    drawn.append((after[0] - before[0]) / span_s)
                    told.append((after[1] - before[1]) / span_s)
                browser.close_pages()
            out, _ = process.communicate(timeout=600)
        for _, bad, all_ in LATE.findall(out):
            late[pages][0] += int(bad)
            late[pages][1] += int(all_)
    per = {pages: bad / max(1, all_) for pages, (bad, all_) in late.items()}
    return {
        "late share, nobody": per[0], "late share, two pages": per[2],
        "periods": late[0][1] + late[2][1],
        "console's share of a core": shares, "pictures a second": drawn, "moments a second": told,
    }  # fmt: skip


def large(browser: Browser, folder: Path, _times: int, _walk_s: float) -> dict[str, Any]:
    """An hour with a tree of 1,000 nodes: until it is there, and how long looking about takes."""
    run = folder / "large"
    run.mkdir()
    hour = LongRun(nodes=1000, duration_s=3600.0)
    (run / journal.FILE).write_bytes(b"".join(hour.lines))
    robot = description.load("juno")
    q = tuple(robot.posture("nominal"))
    with (run / motion.FILE).open("wb") as file:
        for k in range(72_000):  # 20 a second
            x = 0.001 * (k % 4000)
            one = Moment(t_s=0.05 * (k + 1), base=(x, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0), q=q)
            file.write(motion.encode(one) + b"\n")
    header = msgspec.json.decode(hour.lines[0])
    lines = [msgspec.json.encode({**header, "world": "empty"}), *hour.lines[1:]]
    (run / journal.FILE).write_bytes(b"\n".join(line.strip() for line in lines) + b"\n")
    begun_s = time.monotonic()
    with _started(("console", str(run)), folder) as process:
        page = browser.page(_address(process))
        page.wait(PICTURE)
        first_s = time.monotonic() - begun_s
        page.wait("motion.times.length > 71000", most_s=240.0)
        page.wait("document.querySelectorAll('#tree li').length > 900")
        whole_s = time.monotonic() - begun_s
        page.eval(
            "window.tasks = []; new PerformanceObserver((list) => { for (const one of"
            " list.getEntries()) tasks.push(one.duration); }).observe({ entryTypes: ['longtask'] })"
        )
        looks_ms: list[float] = []
        for k in range(20):
            t_s = 3600.0 * ((7 * k) % 20) / 20 + 5.0
            begun = time.monotonic()
            page.eval(f"goTo({t_s})")
            page.wait(f"page.then && Math.abs(page.then.t_s - {t_s}) < 0.1")
            looks_ms.append(1e3 * (time.monotonic() - begun))
        before = _counts(page), time.monotonic()
        page.eval("play(true)")
        time.sleep(10.0)
        drawn = (_counts(page)[0] - before[0][0]) / (time.monotonic() - before[1])
        tasks = page.eval("tasks")
        nodes = page.eval("document.querySelectorAll('#tree li').length")
        kept_mb = page.eval("performance.memory ? performance.memory.usedJSHeapSize / 1e6 : 0")
        browser.close_pages()
        _end(process)
    return {
        "first picture [s]": first_s, "all of it [s]": whole_s, "rows of the tree": nodes,
        "look at another time, p50 / worst [ms]": [statistics.median(looks_ms), max(looks_ms)],
        "played: pictures a second": drawn, "longest task [ms]": max(tasks, default=0),
        "page's memory [MB]": kept_mb,
    }  # fmt: skip


def _started(command: tuple[str, ...], folder: Path) -> subprocess.Popen[str]:
    root = str(Path(__file__).resolve().parent.parent)
    return subprocess.Popen(
        [*COMMAND, *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        cwd=folder, env={**os.environ, "PYTHONPATH": root},
    )  # fmt: skip


def _address(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    for line in process.stdout:
        if found := ADDRESS.search(line):
            return found[0]
    raise SystemExit("no address was told")


def _end(process: subprocess.Popen[str]) -> None:
    process.terminate()
    process.communicate(timeout=60)


def _console_of(parent: int) -> int:
    """The console's process below another one."""
    listed = subprocess.run(
        ["ps", "-eo", "pid,ppid,args"], capture_output=True, text=True, check=True
    ).stdout
    rows = [line.split(None, 2) for line in listed.splitlines()[1:]]
    return next(
        int(pid) for pid, above, args in rows if int(above) == parent and "console.main" in args
    )


def _cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _counts(page: Page) -> tuple[int, int]:
    drawn, told = page.eval("[page.drawn, motion.times.length]")
    return int(drawn), int(told)


PARTS = {"first": first, "watched": watched, "large": large}

if __name__ == "__main__":
    typer.run(main)
