"""`python -m benchmarks.kills`: kill processes of live runs at random, and look at what is left.

Every run does a task in physics and loses one to four of its processes by SIGKILL. An observer on
the run's bus sees every command and where the soles are. Counted: runs that hang, processes that
outlive their run, motion that nobody asked for (an executive is dead, the robot has had the time to
finish its step, and a sole moves before the next command), and falls.
"""

from __future__ import annotations

import json
import math
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from robot.bringup.private_folder import PREFIX
from robot.bus import topics
from robot.bus.zenoh_bus import ZenohBus
from robot.closing import Closing
from robot.errors import BusError

WORDS = "put the red cup on the sideboard"
ROLES = {
    "controller": b"robot.control.main",
    "perception": b"robot.perception.main",
    "plant": b"sim.main",
    "owner": b"robot.owner.main",
    "executive": b"executive.main",
    "planner": b"--multiprocessing-fork",
}
WEIGHTS = {
    "controller": 3, "executive": 3, "planner": 2, "perception": 2, "spare controller": 1,
    "spare executive": 1, "plant": 0.3, "launcher": 0.3,
}  # fmt: skip
UP_S, END_S, GONE_S = 60.0, 240.0, 5.0
"""Wall time until a run is taken to hang: to come up, to end, to leave no process."""
FINISH_S = 3.0
"""Body time in which a robot that nobody commands finishes its step and stands."""
STILL_M = 0.02
POLL_S = 0.02
CENSUS_S = 0.5


@dataclass
class Row:
    """What one run came to."""

    seed: int
    kills: list[tuple[float, str]] = field(default_factory=list)
    status: int | None = None
    problem: str = ""
    orphans: list[str] = field(default_factory=list)
    unasked_m: float = 0.0
    fell: bool = False
    outcome: str = ""


class Observer(Closing):
    """Sees commands and soles on the bus of a run."""

    def __init__(self, private: Path) -> None:
        """Join the bus. Raises BusError."""
        self._bus = ZenohBus("observer", private)
        self._states = self._bus.subscribe(topics.BODY_STATE)
        self._commands = self._bus.subscribe(topics.BODY_COMMAND)
        self._orphaned_s = math.inf  # body time at which the executive died
        self._rest: tuple[float, ...] = ()
        self._now_s = 0.0
        self._since_s = 0.0
        self.unasked_m = 0.0
        self.fell = False

    def executive_died(self) -> None:
        """From here on motion is unasked for, once the step in hand is finished."""
        self._orphaned_s, self._rest = self._now_s, ()

    def look(self) -> None:
        """Take in what came."""
        if self._commands.take():
            self._orphaned_s, self._rest = math.inf, ()
        for state in self._states.take():
            self._now_s = state.stamp_s
            self.fell |= state.mode == "fallen"
            if state.since_s != self._since_s:  # another controller, and another frame N
                self._since_s, self._rest = state.since_s, ()
                self._orphaned_s = max(self._orphaned_s, self._now_s)
            if self._now_s < self._orphaned_s + FINISH_S or state.mode != "stand":
                continue
            soles = (*state.X_NL.p[:2], *state.X_NR.p[:2])
            self._rest = self._rest or soles
            self.unasked_m = max(self.unasked_m, math.dist(soles, self._rest))

    def close(self) -> None:
        """Leave the bus."""
        self._bus.close()


def main(
    *,
    kills: Annotated[int, typer.Option(min=1, help="at least so many in all")] = 200,
    seed: Annotated[int, typer.Option(min=0, help="of the first run")] = 0,
) -> None:
    """Run, kill, count; one line a run on standard output, the sum on standard error."""
    console = Console(stderr=True)
    runs = math.ceil(kills / 2.5)
    rows: list[Row] = []
    for number in track(range(seed, seed + 2 * runs), "killing", console=console, total=runs):
        rows.append(once(number))
        print(json.dumps(asdict(rows[-1])), flush=True)
        if sum(len(row.kills) for row in rows) >= kills:
            break
    told = Counter(role for row in rows for _, role in row.kills)
    console.print(f"{len(rows)} runs, {told.total()} kills: {dict(told)}")
    console.print(
        f"hung or broken: {sum(bool(row.problem) for row in rows)}; with orphans: "
        f"{sum(bool(row.orphans) for row in rows)}; moved unasked: "
        f"{sum(row.unasked_m > STILL_M for row in rows)}; fell: {sum(row.fell for row in rows)}; "
        f"ends: {dict(Counter(row.outcome for row in rows))}"
    )


def once(seed: int) -> Row:
    """One run and its kills."""
    rng, row = random.Random(seed), Row(seed)
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "executive", "do", WORDS, "--world", "bench", "--json"]
        command += ["--run-dir", f"{folder}/run", "--seed", str(seed)]
        job = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True
        )
        seen: dict[int, str] = {}
        try:
            _strike(job, rng, row, seen)
            out, _ = job.communicate(timeout=END_S)
            row.status = job.returncode
            # An executive that dies after its last words is followed by one that says them again.
            last = out.decode().rpartition("\n{")
            words = "".join(last[1:]).strip()
            row.outcome = json.loads(words).get("status", "?") if out else f"status {row.status}"
        except (TimeoutError, subprocess.TimeoutExpired) as error:
            row.problem = str(error) or type(error).__name__
        finally:
            row.orphans = _left(seen)
            for pid in (job.pid, *(pid for pid in seen if _alive(pid))):
                if pid != job.pid or job.poll() is None:
                    os.kill(pid, signal.SIGKILL)
            job.communicate()
    return row


def _strike(
    job: subprocess.Popen[bytes], rng: random.Random, row: Row, seen: dict[int, str]
) -> None:
    """Kill now and then while the run lasts, and watch until it ends."""
    private = _private(job, seen)
    if private is None:
        raise TimeoutError("the robot did not come up")
    try:
        observer = Observer(private)
    except BusError as error:
        raise TimeoutError(f"nobody can observe: {error}") from error
    begin_s, left = time.monotonic(), rng.randint(1, 4)
    next_s = begin_s + rng.uniform(1.0, 8.0)
    looked_s = begin_s
    with observer:
        while job.poll() is None and (now_s := time.monotonic()) < begin_s + END_S:
            observer.look()
            if left and now_s >= next_s:
                found = roles(job.pid, seen)
                role = _choose(rng, found)
                os.kill(found[role], signal.SIGKILL)
                row.kills.append((round(now_s - begin_s, 2), role))
                if role == "executive":
                    observer.executive_died()
                left -= 1
                next_s = now_s + rng.choice([rng.uniform(0.0, 2.0), rng.uniform(2.0, 12.0)])
            if now_s > looked_s + CENSUS_S:
                roles(job.pid, seen)
                looked_s = now_s
            time.sleep(POLL_S)
        observer.look()
        row.unasked_m, row.fell = round(observer.unasked_m, 4), observer.fell


def _private(job: subprocess.Popen[bytes], seen: dict[int, str]) -> Path | None:
    """The run's private folder, once all of its processes are there and the map is looked at."""
    until_s = time.monotonic() + UP_S
    while job.poll() is None and time.monotonic() < until_s:
        there = roles(job.pid, seen)
        if {"controller", "perception", "plant", "planner"} <= there.keys():
            words = _words(there["controller"])
            return next((Path(w).parent for w in words if PREFIX in w), None)
        time.sleep(POLL_S)
    return None


def _choose(rng: random.Random, found: dict[str, int]) -> str:
    names = [name for name in WEIGHTS if name in found]
    return rng.choices(names, [WEIGHTS[name] for name in names])[0]


def roles(launcher: int, seen: dict[int, str]) -> dict[str, int]:
    """The processes below one by what they do; `seen` keeps every one that ever was."""
    found = {"launcher": launcher}
    for pid in sorted(_descendants(launcher)):
        words = _words(pid)
        for role, mark in ROLES.items():
            if any(mark == os.fsencode(word) for word in words):
                name = f"spare {role}" if role in found else role
                found.setdefault(name, pid)
                seen[pid] = name
    seen[launcher] = "launcher"
    return found


def _descendants(root: int) -> set[int]:
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if fields[0] != "Z":
            children.setdefault(int(fields[1]), []).append(int(entry.name))
    found: set[int] = set()
    queue = [root]
    while queue:
        for child in children.get(queue.pop(), []):
            found.add(child)
            queue.append(child)
    return found


def _words(pid: int) -> list[str]:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return []


def _alive(pid: int) -> bool:
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


def _left(seen: dict[int, str]) -> list[str]:
    """What outlives the run by more than it takes the kernel to end it."""
    until_s = time.monotonic() + GONE_S
    while (left := [name for pid, name in seen.items() if _alive(pid)]) and (
        time.monotonic() < until_s
    ):
        time.sleep(POLL_S)
    return left


if __name__ == "__main__":
    typer.run(main)
