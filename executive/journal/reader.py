"""Reads a journal into a `Run`: also one that is still being written, or was cut in the middle.

Events of unknown kinds are kept as words; lines that make no sense are counted and left out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, TypeVar, cast

import msgspec

from executive.journal import words
from executive.journal.failures import suggestion
from executive.journal.floor_plan import Outline, Plan, Pose, Sight
from executive.journal.journal import Event, decode, lines
from executive.journal.keeping import MOST_TEXT, clipped, keep_ends, keep_evenly
from executive.journal.run import (
    OVER,
    BoardChange,
    Ending,
    Finding,
    LogLine,
    Reason,
    RecordedJob,
    Run,
    Task,
)
from executive.journal.step_reader import StepReader
from executive.journal.tree_reader import TreeReader
from robot.printable import printable_data, printable_line

T = TypeVar("T")

Handler = Callable[[float, Mapping[str, Any]], None]
"""Takes the events of a kind: whole, or it raises and changes nothing."""

MOST_LOGGED, MOST_CHANGES, MOST_FINDINGS = 20_000, 20_000, 5000
MOST_POSES, MOST_SIGHTS, MOST_THINGS, MOST_CORNERS = 20_000, 200, 500, 16
MOST_JOBS, MOST_STATES, MOST_TASKS, MOST_NOTES = 2000, 100, 20, 1000
"""What a run holds of each: a long day's work whole, a page of at most some 20 MB."""

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
    reader = Reader(job=job)
    for line in lines(path):
        reader.line(line)
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
        self._jobs: dict[int, RecordedJob] = {}
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
        event = decode(line)
        if event is not None:
            if b"\\" in line:  # no text of an event may pose as a line of what is told of it
                data = cast("dict[str, Any]", printable_data(event.data, printable_line))
                event = msgspec.structs.replace(event, data=data)
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
            if kind in words.DRAWN:  # most of a journal
                self.run.events += 1
                return
            text, note = words.sentence(kind, data), words.in_hindsight(kind, data)
        except Exception:  # whatever a line holds: who only looks on must never stop a robot
            self._lost()
            return
        self.run.events += 1
        if text:
            self._tell(self.run.log, LogLine(t_s, kind, clipped(text)), MOST_LOGGED)
        if note:
            self._tell(self.run.task.notes, LogLine(t_s, kind, clipped(note)), MOST_NOTES)

    def _tell(self, items: list[T], item: T, most: int) -> None:
        self.run.left_out += keep_ends(items, item, most)

    def _draw(self, items: list[T], item: T, most: int) -> None:
        self.run.left_out += keep_evenly(items, item, most)

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
        told, reason = msgspec.convert(data, _JobEvent), msgspec.convert(data, Reason)
        job = self._jobs.get(told.job)
        if job is None:
            job = RecordedJob(number=told.job, text=clipped(told.text), urgent=told.urgent)
            self._tell(self.run.jobs, job, MOST_JOBS)
            if len(self._jobs) > MOST_JOBS:
                self._jobs = {job.number: job for job in self.run.jobs}
            self._jobs[told.job] = job
        if told.state == "running" and (not job.states or job.states[-1][1] == "waiting"):
            self._trees.begin(told.text)
        self._tell(job.states, (t_s, told.state), MOST_STATES)
        refused = told.state == "failed" and self._is_over(self._job)  # before it ever ran
        if (told.state == "running" or refused) and told.job != self._job:
            self._begin_task(t_s, told)
        if told.job == self._job:
            self.run.task.state = "" if told.state == "waiting" else told.state
            if told.state in OVER and "code" in data:
                self.run.task.reason = reason
            if told.state in OVER and self._only is not None:
                self.run.task.took_s = round(t_s - self.run.task.began_s, 4)

    def _is_over(self, number: int | None) -> bool:
        """Whether nothing more comes of a job; of none, nothing does."""
        job = self._jobs.get(number) if number is not None else None
        return job is None or not job.states or job.states[-1][1] in OVER

    def _begin_task(self, t_s: float, told: _JobEvent) -> None:
        """Another job begins: what came before belongs to the last one."""
        before = self.run.task
        if before.attempts or before.state:
            self.run.tasks.append(Task())
            del self.run.tasks[:-MOST_TASKS]
            self._steps.begin_task()
        if self._only is not None:  # what was asked before was asked of others
            self.run.task.notes.clear()
        self.run.task.text = told.text or before.text
        self.run.task.began_s = t_s
        self._job = told.job

    def _outcome(self, t_s: float, data: Mapping[str, Any]) -> None:
        ending = msgspec.convert({"t_s": t_s, **data}, Ending)
        reason = msgspec.convert(data, Reason)
        advice = suggestion(ending.code, ending.suggestion)
        told = msgspec.structs.replace(ending, suggestion=advice)
        self._tell(self.run.endings, told, MOST_JOBS)
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
        self.run.recoveries += 1

    def _board(self, t_s: float, data: Mapping[str, Any]) -> None:
        key, value = clipped(str(data["key"])), _brief(data["value"])
        self._tell(self.run.board, BoardChange(t_s, key, value), MOST_CHANGES)

    def _health(self, t_s: float, data: Mapping[str, Any]) -> None:
        found = msgspec.convert({"t_s": t_s, **data}, _Finding)
        finding = Finding(t_s, found.name, found.level, found.code, found.cause)
        self._tell(self.run.health, finding, MOST_FINDINGS)
        self._steps.health(finding)

    def _map(self, _t_s: float, data: Mapping[str, Any]) -> None:
        self.run.plan = msgspec.convert(data, Plan)

    def _pose(self, t_s: float, data: Mapping[str, Any]) -> None:
        told = msgspec.convert(data, _Pose)
        self._draw(self.run.path, Pose(t_s, told.x_m, told.y_m, told.yaw_rad), MOST_POSES)
        if told.mode:
            self._tell(self.run.modes, (t_s, told.mode), MOST_CHANGES)
        for name, seen in told.objects.items():
            sight = Sight(t_s, seen.x_m, seen.y_m, seen.z_m, seen.held, seen.missing)
            if name in self.run.things or len(self.run.things) < MOST_THINGS:
                self._draw(self.run.things.setdefault(name, []), sight, MOST_SIGHTS)
        for name, corners in told.unmapped.items():
            outline = Outline(t_s, corners[:MOST_CORNERS])
            if name in self.run.unmapped or len(self.run.unmapped) < MOST_THINGS:
                self._draw(self.run.unmapped.setdefault(name, []), outline, MOST_SIGHTS)


def _brief(value: object) -> object:
    """A value of the blackboard; one that nobody would read through, as its first characters."""
    if value is None or isinstance(value, int | float):
        return value
    text = msgspec.json.encode(value)
    return value if len(text) <= MOST_TEXT else clipped(text.decode())


class _Finding(msgspec.Struct):
    name: str
    level: str
    code: str = ""
    cause: str = ""


class _JobEvent(msgspec.Struct):
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
