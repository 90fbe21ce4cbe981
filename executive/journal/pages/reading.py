"""Reads a journal into a `Run`: also one that is still being written, or was cut in the middle.

Events of unknown kinds are kept as words; lines that make no sense are counted and left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import msgspec

from executive.journal.journal import Event, decode
from executive.journal.pages import words
from executive.journal.pages.growing import Growth
from executive.journal.pages.model import (
    BoardChange,
    Finding,
    Job,
    Line,
    Outline,
    Plan,
    Pose,
    Run,
    Sight,
)
from executive.journal.pages.troubles import Troubles

Handler = Callable[[float, Mapping[str, Any]], None]
"""Takes the events of a kind: whole, or it raises and changes nothing."""

CLOCK_RESET_S = 1.0
"""A step back in time by more than that is a clock that began anew."""


def read(path: Path) -> Run:
    """Read a journal as far as it goes.

    Raises:
        OSError: if it cannot be read at all.
    """
    reader = Reader()
    with path.open("rb") as file:
        for line in file:
            reader.line(line)
    return reader.run


class Reader:
    """Takes a journal line by line, or event by event; `run` is what is known so far."""

    def __init__(self) -> None:
        """Nothing has happened."""
        self.run = Run()
        self._growth = Growth(self.run)
        self._troubles = troubles = Troubles(self.run)
        self._lines = 0
        self._shift_s = 0.0
        self._handlers: dict[str, Handler] = {
            "run": self._run,
            "tree": self._growth.tree,
            "node": self._node,
            "phase": self._growth.phase,
            "board": self._board,
            "health": self._health,
            "failure": troubles.failure,
            "recovery": self._recovery,
            "no recovery": troubles.no_recovery,
            "again": troubles.again,
            "done": troubles.done,
            "outcome": troubles.outcome,
            "fault": troubles.fault,
            "job": self._job,
            "map": self._map,
            "pose": self._pose,
        }

    def line(self, line: bytes) -> None:
        """Take a line of the file; the last one may lack its end."""
        self._lines += 1
        self.run.cut = not line.endswith(b"\n")
        if not line.strip():
            return
        try:
            event = decode(line)
        except RecursionError:
            event = None
        if event is not None:
            self.event(event)
        elif not self.run.cut:
            self._lost()

    def event(self, event: Event) -> None:
        """Take an event from a journal that is being written (`Journal.listen`)."""
        self._take(self._in_order(event.t_s), event.event, event.data)

    def _take(self, t_s: float, kind: str, data: Mapping[str, Any]) -> None:
        handler = self._handlers.get(kind)
        try:
            if handler is not None:
                handler(t_s, data)
            text = words.sentence(kind, data)
        except (KeyError, TypeError, ValueError, RecursionError):
            self._lost()
            return
        self.run.events += 1
        if text:
            self.run.log.append(Line(t_s, kind, text))

    def _in_order(self, t_s: float) -> float:
        """Time goes on: a run that was gone on with may count it from the beginning again."""
        run = self.run
        if not run.events:
            run.begin_s = run.end_s = t_s
        if t_s + self._shift_s < run.end_s - CLOCK_RESET_S:
            self._shift_s = run.end_s - t_s
        run.end_s = max(run.end_s, round(t_s + self._shift_s, 4))
        return run.end_s

    def _lost(self) -> None:
        self.run.unreadable += 1
        self.run.unreadable_line = self.run.unreadable_line or self._lines

    def _run(self, _t_s: float, data: Mapping[str, Any]) -> None:
        self.run.text = str(data.get("text", ""))
        self.run.about = {key: value for key, value in data.items() if key != "text"}

    def _node(self, t_s: float, data: Mapping[str, Any]) -> None:
        number = self._growth.node(t_s, data)
        if data["status"] == "failure":
            self._troubles.node_failed(t_s, number)

    def _recovery(self, t_s: float, data: Mapping[str, Any]) -> None:
        self._troubles.recovery(t_s, data)
        self._growth.remedied(t_s)

    def _board(self, t_s: float, data: Mapping[str, Any]) -> None:
        self.run.board.append(BoardChange(t_s, str(data["key"]), data["value"]))

    def _health(self, t_s: float, data: Mapping[str, Any]) -> None:
        found = msgspec.convert({"t_s": t_s, **data}, _Finding)
        self.run.health.append(Finding(t_s, found.name, found.level, found.code, found.cause))

    def _job(self, t_s: float, data: Mapping[str, Any]) -> None:
        told = msgspec.convert(data, _Job)
        job = next((job for job in self.run.jobs if job.number == told.job), None)
        if job is None:
            job = Job(number=told.job, text=told.text, urgent=told.urgent)
            self.run.jobs.append(job)
        if told.state == "running" and all(state != "running" for _, state in job.states):
            self._growth.begin(told.text)
        job.states.append((t_s, told.state))

    def _map(self, _t_s: float, data: Mapping[str, Any]) -> None:
        self.run.plan = msgspec.convert(data, Plan)

    def _pose(self, t_s: float, data: Mapping[str, Any]) -> None:
        told = msgspec.convert(data, _Pose)
        self.run.path.append(Pose(t_s, told.x_m, told.y_m, told.yaw_rad))
        if told.mode:
            self.run.modes.append((t_s, told.mode))
        for name, seen in told.objects.items():
            sight = Sight(t_s, seen.x_m, seen.y_m, seen.z_m, seen.held, seen.missing)
            self.run.things.setdefault(name, []).append(sight)
        for name, corners in told.unmapped.items():
            self.run.unmapped.setdefault(name, []).append(Outline(t_s, corners))


class _Finding(msgspec.Struct):
    name: str
    level: str
    code: str = ""
    cause: str = ""


class _Job(msgspec.Struct):
    job: int
    text: str = ""
    state: str = ""
    urgent: bool = False


class _Sight(msgspec.Struct):
    x_m: float
    y_m: float
    z_m: float = 0.0
    held: str = ""
    missing: bool = False


class _Pose(msgspec.Struct):
    x_m: float
    y_m: float
    yaw_rad: float = 0.0
    mode: str = ""
    objects: dict[str, _Sight] = {}
    unmapped: dict[str, list[tuple[float, float]]] = {}
