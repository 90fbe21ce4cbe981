"""Reads a journal into a `Run`: also one that is still being written, or was cut in the middle.

Events of unknown kinds are kept as words; lines that make no sense are counted and left out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import msgspec

from executive.journal import words
from executive.journal.failures import suggestion
from executive.journal.floor_plan import Outline, Plan, Pose, Sight
from executive.journal.journal import FILE, Event, decode
from executive.journal.run import (
    BoardChange,
    Ending,
    Finding,
    Job,
    LogLine,
    Reason,
    Run,
    Task,
)
from executive.journal.step_reader import StepReader
from executive.journal.tree_reader import TreeReader
from robot.errors import ConfigError

Handler = Callable[[float, Mapping[str, Any]], None]
"""Takes the events of a kind: whole, or it raises and changes nothing."""

OVER = frozenset({"done", "failed", "cancelled"})

CLOCK_RESET_S = 1.0
"""A step back in time by more than that is a clock that began anew."""


def read(path: Path, *, job: int | None = None) -> Run:
    """Read a journal as far as it goes.

    Args:
        path: a run's folder, or the file itself.
        job: read only what is of this job, up to its end, or of none (None: everything).

    Raises:
        ConfigError: if there is no journal.
    """
    file = path / FILE if path.is_dir() else path
    reader = Reader(job=job)
    try:
        with file.open("rb") as lines:
            for line in lines:
                reader.line(line)
    except OSError as error:
        raise ConfigError(f"{path} holds no journal: {error.strerror}") from None
    return reader.run


def told(events: Iterable[Event]) -> Run:
    """The run that some events are of, from its beginning."""
    reader = Reader()
    for event in events:
        reader.event(event)
    return reader.run


class Reader:
    """Takes a journal line by line, or event by event; `run` is what is known so far."""

    def __init__(self, *, job: int | None = None) -> None:
        """Nothing has happened; with a job, what is of others is passed over."""
        self.run = Run()
        self._only = job
        self._only_over = False
        self._trees = trees = TreeReader(self.run)
        self._steps = steps = StepReader(self.run)
        self._lines = 0
        self._number = -1
        self._job: int | None = None
        self._shift_s = 0.0
        self._handlers: dict[str, Handler] = {
            "run": self._run,
            "job": self._job_state,
            "outcome": self._outcome,
            "step": steps.step,
            "phase": self._phase,
            "done": steps.done,
            "stopping": self._stopping,
            "failure": steps.failure,
            "recovery": self._recovery,
            "no recovery": steps.no_recovery,
            "again": steps.again,
            "fault": steps.fault,
            "tree": trees.tree,
            "node": self._node,
            "board": self._board,
            "health": self._health,
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
        if self._number >= 0 and event.n > self._number + 1:
            self.run.missing += event.n - self._number - 1
        self._number = event.n
        if self._only is not None and self._is_of_others(event):
            return
        self._take(self._in_order(event.t_s), event.event, event.data)

    def _take(self, t_s: float, kind: str, data: Mapping[str, Any]) -> None:
        handler = self._handlers.get(kind)
        try:
            if handler is not None:
                handler(t_s, data)
            text, note = words.sentence(kind, data), words.in_hindsight(kind, data)
        except Exception:  # whatever a line holds: who only looks on must never stop a robot
            self._lost()
            return
        self.run.events += 1
        if text:
            self.run.log.append(LogLine(t_s, kind, text))
        if note:
            self.run.task.notes.append(LogLine(t_s, kind, note))

    def _is_of_others(self, event: Event) -> bool:
        """Whether an event is of another job, or came when the only one was over."""
        mine = event.data.get("job", self._only) == self._only
        if self._only_over or not mine or event.event == "outcome":
            return True  # an outcome is that of whichever job ended last
        self._only_over = event.event == "job" and event.data.get("state") in OVER
        return False

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

    # --- what was asked for, and how it ended ---

    def _run(self, t_s: float, data: Mapping[str, Any]) -> None:
        self.run.text = self.run.task.text = str(data.get("text", ""))
        self.run.task.began_s = t_s
        self.run.about = {key: value for key, value in data.items() if key != "text"}

    def _job_state(self, t_s: float, data: Mapping[str, Any]) -> None:
        told, reason = msgspec.convert(data, _Job), msgspec.convert(data, Reason)
        job = next((job for job in self.run.jobs if job.number == told.job), None)
        if job is None:
            job = Job(number=told.job, text=told.text, urgent=told.urgent)
            self.run.jobs.append(job)
        if told.state == "running" and all(state != "running" for _, state in job.states):
            self._trees.begin(told.text)
        job.states.append((t_s, told.state))
        if told.state == "running" and told.job != self._job:
            self._begin_task(t_s, told)
        if told.job == self._job:
            self.run.task.state = "" if told.state == "waiting" else told.state
            if told.state in OVER and "code" in data:
                self.run.task.reason = reason
            if told.state in OVER and self._only is not None:
                self.run.task.took_s = round(t_s - self.run.task.began_s, 4)

    def _begin_task(self, t_s: float, told: _Job) -> None:
        """Another job begins: what came before belongs to the last one."""
        before = self.run.task
        if before.attempts or before.state:
            self.run.tasks.append(Task())
            self._steps.begin_task()
        self.run.task.text = told.text or before.text
        self.run.task.began_s = t_s
        self._job = told.job

    def _outcome(self, t_s: float, data: Mapping[str, Any]) -> None:
        ending = msgspec.convert({"t_s": t_s, **data}, Ending)
        reason = msgspec.convert(data, Reason)
        advice = suggestion(ending.code, ending.suggestion)
        self.run.endings.append(msgspec.structs.replace(ending, suggestion=advice))
        self._steps.outcome(t_s, done=ending.code == "done")
        task = self.run.task
        task.took_s = ending.took_s if "took_s" in data else None
        task.state = ending.code if ending.code in ("done", "cancelled") else "failed"
        if task.state != "done":
            task.reason = reason

    # --- how it went ---

    def _phase(self, t_s: float, data: Mapping[str, Any]) -> None:
        self._trees.phase(t_s, data)
        self._steps.phase(t_s, data)

    def _stopping(self, t_s: float, data: Mapping[str, Any]) -> None:
        self._trees.stopping(t_s, data)
        self._steps.stopping(t_s, data)

    def _node(self, t_s: float, data: Mapping[str, Any]) -> None:
        number = self._trees.node(t_s, data)
        if data["status"] == "failure":
            self._steps.node_failed(t_s, number)

    def _recovery(self, t_s: float, data: Mapping[str, Any]) -> None:
        self._steps.recovery(t_s, data)
        self._trees.remedied(t_s)

    def _board(self, t_s: float, data: Mapping[str, Any]) -> None:
        self.run.board.append(BoardChange(t_s, str(data["key"]), data["value"]))

    def _health(self, t_s: float, data: Mapping[str, Any]) -> None:
        found = msgspec.convert({"t_s": t_s, **data}, _Finding)
        self.run.health.append(Finding(t_s, found.name, found.level, found.code, found.cause))

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
