"""`python -m benchmarks.journal_cost`: what the journal and dumps cost of a `--fast` run.

Two measurements of the same job, both in CPU time of this process, so that a busy machine counts
little:

- *inside*: the time spent in `Journal.write`, in the recorder and in a dumper, as a share of all;
- *in turns*: runs with everything kept and runs with nothing kept (no files, no recorder), one
  after the other. Far noisier on a busy machine, but nothing can hide from it.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated, Any
from unittest.mock import patch

import typer

from benchmarks import machine
from benchmarks.markdown import table
from executive.engine.executive import Executive
from executive.engine.recorder import Recorder
from executive.frontends.dump.writer import Dumper, along
from executive.frontends.progress import Silent
from executive.journal.journal import Journal
from executive.meaning import request
from executive.runs import runtimes, task_run
from executive.runs.runtimes import Setup
from executive.runs.session import Session
from executive.runs.task_run import Assignment
from robot.clock import WallClock
from sim.simulation import Simulation

SENTENCE = "pick up the red cup and put it on the shelf"
DUMPS = ("failure", "change")


class Meter:
    """CPU time inside some methods; what they call of one another is counted once."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.spent_s: dict[str, float] = {}
        self.calls: dict[str, int] = {}
        self._inside = False

    def on(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, measured under a name."""

        def measured(*args: Any, **named: Any) -> Any:
            self.calls[name] = self.calls.get(name, 0) + 1
            if self._inside:
                return function(*args, **named)
            self._inside = True
            begin_s = time.thread_time()
            try:
                return function(*args, **named)
            finally:
                self.spent_s[name] = self.spent_s.get(name, 0.0) + time.thread_time() - begin_s
                self._inside = False

        return measured


class NoRecorder:
    """Records nothing."""

    def __init__(self, _executive: Executive) -> None:
        """Look at nothing."""

    def update(self) -> None:
        """Write nothing."""


def quiet(_executive: Executive) -> Silent:
    return Silent()


def run(sentence: str, *, folder: Path | None, dump_on: str = "", bare: bool = False) -> float:
    """Do a job in `fast`; returns the CPU time [s] from its first tick to its end."""
    where = request.setting(Simulation(), "kitchen", robot="juno")
    understood = request.request(sentence, where, ask=None)
    if isinstance(understood, request.Refused):
        raise SystemExit(understood.reason)
    setup = Setup(where=where, folder=folder)
    show = quiet
    if dump_on and folder is not None:
        formats = "svg,html" if dump_on == "failure" else "text"
        show = along(show, folder / "dump", on=dump_on, formats=formats)
    with ExitStack() as stack:
        robot = stack.enter_context(runtimes.opened(setup))
        if bare:
            stack.enter_context(patch("executive.runs.session.Recorder", NoRecorder))
        begin_s = time.process_time()
        session = stack.enter_context(Session(setup, robot, time_of_day=time.time))
        assignment = Assignment(understood=understood)
        task_run.do(assignment, session, show=show, wall=WallClock())
        return time.process_time() - begin_s


def inside(sentence: str, *, dump_on: str) -> list[str]:
    """One run, and the shares of what is measured in it, as a row of the table."""
    meter = Meter()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory())) / "run"
        for owner, name in (
            (Journal, "write"), (Recorder, "update"), (Dumper, "update"), (Dumper, "close"),
        ):  # fmt: skip
            label = f"{owner.__name__}.{name}"
            stack.enter_context(patch.object(owner, name, meter.on(label, getattr(owner, name))))
        whole_s = run(sentence, folder=folder, dump_on=dump_on)
        size = (folder / "journal.jsonl").stat().st_size

    def share(*names: str) -> str:
        return f"{100.0 * sum(meter.spent_s.get(name, 0.0) for name in names) / whole_s:.2f} %"

    return [
        dump_on or "none", f"{whole_s:.1f}", share("Journal.write"), share("Recorder.update"),
        share("Dumper.update", "Dumper.close"),
        share("Journal.write", "Recorder.update", "Dumper.update", "Dumper.close"),
        f"{meter.calls.get('Journal.write', 0)}", f"{size / 1e3:.0f}",
    ]  # fmt: skip


def in_turns(sentence: str, turns: int) -> str:
    """Runs with everything and with nothing, in turns."""
    spent: dict[str, list[float]] = {"kept": [], "bare": []}
    for _ in range(turns):
        with tempfile.TemporaryDirectory() as folder:
            spent["kept"].append(run(sentence, folder=Path(folder) / "run"))
        spent["bare"].append(run(sentence, folder=None, bare=True))
    rows = [
        f"{name} {kept:.2f} s kept, {bare:.2f} s bare, {100.0 * (kept / bare - 1.0):+.1f} %"
        for name, kept, bare in (
            ("least", min(spent["kept"]), min(spent["bare"])),
            ("median", statistics.median(spent["kept"]), statistics.median(spent["bare"])),
        )
    ]
    spread = statistics.stdev(spent["bare"]) / statistics.mean(spent["bare"]) if turns > 1 else 0.0
    noise = f"standard deviation of the bare ones {100.0 * spread:.1f} %"
    return f"in turns, {turns} runs each: {'; '.join(rows)}; {noise}"


def main(
    *,
    sentence: Annotated[str, typer.Option(help="the job")] = SENTENCE,
    turns: Annotated[int, typer.Option(min=0, help="runs of each kind in turns")] = 5,
) -> None:
    """Measure, and print."""
    heads = ["dumps on", "CPU s", "journal", "recorder", "dumper", "together", "events", "kB"]
    rows = [inside(sentence, dump_on=dump_on) for dump_on in ("", *DUMPS)]
    print(machine.describe())
    print(f"job: {sentence}\n\n{table(heads, rows)}")
    if turns:
        print(in_turns(sentence, turns))


if __name__ == "__main__":
    typer.run(main)
