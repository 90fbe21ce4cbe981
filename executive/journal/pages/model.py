"""What happened in a run, as a value: `executive.journal.pages.reading` makes it from a journal.

The same value is the JSON of `humanoid dump --format json` and the data inside the HTML page, so
whatever is shown can be had as data. Lists of what comes often are arrays rather than objects.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Literal, TypeVar

import msgspec

T = TypeVar("T")

State = Literal["waiting", "running", "done", "failed", "stopped"]
"""What people are told of a node. `stopped`: it was running and was interrupted from above.

A node that was done or has failed stays so until it begins anew, or what it belongs to comes round
again; py_trees itself forgets it sooner.
"""

FORMAT = 1
"""Of the JSON."""


class Change(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """From `t_s` on a node is in a state and says `note` of itself."""

    t_s: float
    state: State
    note: str = ""


class Node(msgspec.Struct, kw_only=True, omit_defaults=True):
    """A node of the tree. `children` are all it ever had, in order.

    `title` is what was asked for, where it is the root of a job. `step` is its path in the job.
    `born_s` is when it came into the tree, `gone_s` when it was taken out. One that is gone stays
    in view until something takes its place: until `hidden_s`.
    """

    id: int
    parent: int
    kind: str
    name: str
    title: str = ""
    step: str = ""
    born_s: float = 0.0
    gone_s: float | None = None
    hidden_s: float | None = None
    children: list[int] = []
    changes: list[Change] = []

    def at(self, t_s: float) -> Change:
        """The newest change at a time."""
        return newest(self.changes, t_s, when=_t_s) or Change(self.born_s, "waiting")

    def in_view(self, t_s: float) -> bool:
        """Whether it belongs to the tree as it is shown at a time."""
        return self.born_s <= t_s and (self.hidden_s is None or t_s < self.hidden_s)

    def intervals(self, end_s: float) -> list[Interval]:
        """Its states other than waiting, one after the other, up to the end of the run."""
        ends = [*(change.t_s for change in self.changes[1:]), self.gone_s or end_s]
        pairs = zip(self.changes, ends, strict=False)
        found = [Interval(change.t_s, end, change.state) for change, end in pairs]
        return [interval for interval in _joined(found) if interval.state != "waiting"]


class Interval(msgspec.Struct, frozen=True, array_like=True):
    """A state and how long it lasted."""

    begin_s: float
    end_s: float
    state: State


class BoardChange(msgspec.Struct, frozen=True, array_like=True):
    """A key of the blackboard has a new value."""

    t_s: float
    key: str
    value: Any


class Finding(msgspec.Struct, frozen=True, array_like=True):
    """Something about the robot's health came up, changed its level, or (OK) went away."""

    t_s: float
    name: str
    level: str
    code: str = ""
    cause: str = ""


class Trouble(msgspec.Struct, kw_only=True, omit_defaults=True):
    """A failure of a step, and what became of it.

    `node` failed; `tried` are the remedies in order, with their times; `around` says what was known
    to be wrong then; `ended` is how it ended, `ended_s` when.
    """

    t_s: float
    step: str
    id: str = ""
    node: int = -1
    code: str
    cause: str
    evidence: dict[str, Any] = {}
    suggestion: str = ""
    around: list[str] = []
    tried: list[tuple[float, str]] = []
    ended: Literal["", "recovered", "not recovered"] = ""
    ended_s: float | None = None


class Line(msgspec.Struct, frozen=True, array_like=True):
    """An event in words, with its kind."""

    t_s: float
    kind: str
    text: str


class Pose(msgspec.Struct, frozen=True, array_like=True):
    """Where the robot was."""

    t_s: float
    x_m: float
    y_m: float
    yaw_rad: float


class Sight(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """Where an object is believed to be from `t_s` on; `held` by which hand, or missing there."""

    t_s: float
    x_m: float
    y_m: float
    z_m: float
    held: str = ""
    missing: bool = False


class Outline(msgspec.Struct, frozen=True, array_like=True):
    """From `t_s` on something that no map explains stands here; no corners: it is gone."""

    t_s: float
    corners: list[tuple[float, float]]


class Area(msgspec.Struct, frozen=True, kw_only=True):
    """A room, a spot or a piece of furniture from above."""

    name: str
    outline_m: list[tuple[float, float]]


class Thing(msgspec.Struct, frozen=True, kw_only=True):
    """An object that the map knows."""

    id: str
    name: str
    color: str = ""


class Someone(msgspec.Struct, frozen=True, kw_only=True):
    """A person."""

    name: str
    x_m: float
    y_m: float
    radius_m: float = 0.25


class Plan(msgspec.Struct, frozen=True, kw_only=True):
    """The world from above; `bounds_m` is (least x, least y, largest x, largest y)."""

    name: str = ""
    bounds_m: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    rooms: list[Area] = []
    spots: list[Area] = []
    furniture: list[Area] = []
    objects: list[Thing] = []
    people: list[Someone] = []


class Job(msgspec.Struct, kw_only=True, omit_defaults=True):
    """Something that was asked for, and its states with their times."""

    number: int
    text: str
    urgent: bool = False
    states: list[tuple[float, str]] = []


class Ending(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """How a task ended; `code` is `done` when it went well."""

    t_s: float
    code: str
    cause: str = ""
    suggestion: str = ""
    took_s: float = 0.0
    recoveries: int = 0


class Run(msgspec.Struct, kw_only=True):
    """All of it. Times are the runtime's; lists are in their order.

    `unreadable` lines could not be understood, the first of them in line `unreadable_line`; `cut`
    says that the last line was half written; `outcome` is None while the run goes on.
    """

    format: int = FORMAT
    text: str = ""
    about: dict[str, Any] = {}
    begin_s: float = 0.0
    end_s: float = 0.0
    events: int = 0
    unreadable: int = 0
    unreadable_line: int = 0
    cut: bool = False
    roots: list[int] = []
    nodes: dict[int, Node] = {}
    board: list[BoardChange] = []
    health: list[Finding] = []
    troubles: list[Trouble] = []
    log: list[Line] = []
    jobs: list[Job] = []
    path: list[Pose] = []
    modes: list[tuple[float, str]] = []
    things: dict[str, list[Sight]] = {}
    unmapped: dict[str, list[Outline]] = {}
    plan: Plan | None = None
    endings: list[Ending] = []

    @property
    def outcome(self) -> Ending | None:
        """How the newest task ended."""
        return self.endings[-1] if self.endings else None

    def board_at(self, t_s: float) -> dict[str, Any]:
        """The blackboard at a time, as far as it was written by then."""
        changes = self.board[: bisect_right(self.board, t_s, key=_t_s)]
        return {change.key: change.value for change in changes}

    def health_at(self, t_s: float) -> dict[str, Finding]:
        """What was wrong at a time, by name."""
        return findings(self.health[: bisect_right(self.health, t_s, key=_t_s)])

    def pose_at(self, t_s: float) -> Pose | None:
        """Where the robot was at a time, None before that was known."""
        return newest(self.path, t_s, when=_t_s)

    def walk(self) -> Iterator[tuple[int, Node]]:
        """Every node that ever was, parents first, with its depth."""
        stack = [(0, root) for root in reversed(self.roots)]
        while stack:
            depth, number = stack.pop()
            node = self.nodes[number]
            yield depth, node
            stack.extend((depth + 1, child) for child in reversed(node.children))


def findings(changes: Sequence[Finding]) -> dict[str, Finding]:
    """What remains wrong after some changes."""
    last = {finding.name: finding for finding in changes}
    return {name: finding for name, finding in last.items() if finding.level != "OK"}


def newest(entries: Sequence[T], t_s: float, *, when: Callable[[T], float]) -> T | None:
    """The last of some entries in order of time that is not later than `t_s`."""
    index = bisect_right(entries, t_s, key=when)
    return entries[index - 1] if index else None


def _t_s(entry: Any) -> float:
    return entry.t_s


def _joined(intervals: list[Interval]) -> Iterator[Interval]:
    """Neighbours of the same state as one."""
    last: Interval | None = None
    for interval in intervals:
        if last is not None and last.state == interval.state:
            last = Interval(last.begin_s, interval.end_s, last.state)
            continue
        if last is not None:
            yield last
        last = interval
    if last is not None:
        yield last
