"""What happened in a run, as a value: `executive.journal.reader` makes it from a journal.

`why`, the list of past runs, the dumps and the tree on the screen are views of this one value.
Most of it is also the JSON of `humanoid dump --format json` and the data inside the HTML page
(`dumped`); lists of what comes often are therefore arrays rather than objects.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, Literal

import msgspec

from executive.journal.floor_plan import Outline, Plan, Pose, Sight
from executive.journal.tree import Node

Result = Literal["going on", "done", "failed", "stopped"]

FORMAT = 1
"""Of the JSON."""
_NOT_DUMPED = frozenset({"tasks", "missing"})
"""What is told by `why` rather than as data."""


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


class LogLine(msgspec.Struct, frozen=True, array_like=True):
    """An event in words, with its kind."""

    t_s: float
    kind: str
    text: str


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


class Attempt(msgspec.Struct, kw_only=True):
    """One go at a step.

    Attributes:
        step, id: the step's name, and its path in the task (empty in old journals).
        began_s, ended_s: when; None while it goes on.
        phase, phase_s: what it did last, and since when.
        result: how it ended.
        trouble: why it failed, and what was done about that.
        remedies: the steps of the recoveries before the next go.
    """

    step: str
    id: str
    began_s: float
    phase: str = ""
    phase_s: float = 0.0
    ended_s: float | None = None
    result: Result = "going on"
    trouble: Trouble | None = None
    remedies: list[Attempt] = []

    def same_step(self, other: Attempt) -> bool:
        """Whether the other one is a go at the same step."""
        return self.of_step == other.of_step

    @property
    def of_step(self) -> tuple[str, str]:
        """The step, whichever go it is: a path loses the number of its recovery, "2.1+1"."""
        return self.step, self.id.partition("+")[0]


class Reason(msgspec.Struct, frozen=True, kw_only=True):
    """Why a whole task failed."""

    code: str = "internal"
    cause: str = ""
    evidence: dict[str, Any] = {}


class Task(msgspec.Struct, kw_only=True):
    """One job from when it began, or went on, until another one did.

    Attributes:
        text: what was asked for.
        began_s: when.
        attempts: every go at every step, in order; those of remedies stand with what they remedy.
        notes: health, faults, holds, what people did: in hindsight.
        state: of the job, or how it ended; "" where the journal just ends.
        reason: why it failed.
        took_s: as the robot counted it, None as long as it has not.
    """

    text: str = ""
    began_s: float = 0.0
    attempts: list[Attempt] = []
    notes: list[LogLine] = []
    state: str = ""
    reason: Reason | None = None
    took_s: float | None = None

    @property
    def current(self) -> Attempt | None:
        """The newest go that has not ended."""
        every = [go for first in self.attempts for go in (first, *first.remedies)]
        return next((go for go in reversed(every) if go.result == "going on"), None)

    def of(self, step: Attempt) -> list[Attempt]:
        """Every go at the same step, in order."""
        return [one for one in self.attempts if one.same_step(step)]


OVER = frozenset({"done", "failed", "cancelled"})
"""States of a job that is over."""


class RecordedJob(msgspec.Struct, kw_only=True, omit_defaults=True):
    """Something that was asked for, and its states with their times."""

    number: int
    text: str
    urgent: bool = False
    states: list[tuple[float, str]] = []

    @property
    def weight(self) -> tuple[int, float, int]:
        """Of several jobs, the one that people mean without naming it weighs most.

        That is one that runs, or else one that was interrupted, the first begun: those beside it
        only speak. If all is over it is the one that ended last, of those that ever began, or
        failed before they did.
        """
        states = [state for _, state in self.states]
        last_s, last = self.states[-1] if self.states else (0.0, "waiting")
        if last in ("running", "interrupted", "paused"):
            return (3 if last == "running" else 2, 0.0, -self.number)
        counts = last == "failed" or ("running" in states and last != "waiting")
        return (1 if counts else 0, last_s, self.number)


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
    says that the last line was half written; `missing` events were never written. Of a very long
    run only so much is held: `left_out` counts what was let go of. `recoveries` counts those of all
    its jobs. `tasks` are the newest ones, one
    or more, the newest last.
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
    left_out: int = 0
    recoveries: int = 0
    roots: list[int] = []
    nodes: dict[int, Node] = {}
    board: list[BoardChange] = []
    health: list[Finding] = []
    troubles: list[Trouble] = []
    log: list[LogLine] = []
    jobs: list[RecordedJob] = []
    path: list[Pose] = []
    modes: list[tuple[float, str]] = []
    things: dict[str, list[Sight]] = {}
    unmapped: dict[str, list[Outline]] = {}
    plan: Plan | None = None
    endings: list[Ending] = []
    tasks: list[Task] = msgspec.field(default_factory=lambda: [Task()])
    missing: int = 0

    @property
    def task(self) -> Task:
        """The newest one."""
        return self.tasks[-1]

    @property
    def outcome(self) -> Ending | None:
        """How the newest task ended."""
        return self.endings[-1] if self.endings else None

    @property
    def of_jobs(self) -> tuple[int, int]:
        """How many jobs are done, and how many there were: the newest task says nothing of them."""
        last = [job.states[-1][1] if job.states else "" for job in self.jobs]
        return last.count("done"), len(last)

    @property
    def idle(self) -> bool:
        """Whether somebody was there and asked for nothing."""
        return bool(self.about.get("attended")) and not self.task.attempts and not self.task.state

    @property
    def asked(self) -> bool:
        """Whether a run began, and somebody asked for something in it: what can be gone on with."""
        requested = any(line.kind == "request" for line in self.log)
        return bool(self.about) and (requested or bool(self.jobs or self.task.attempts))

    def walk(
        self, roots: Sequence[int] | None = None, *, t_s: float = math.inf
    ) -> Iterator[tuple[int, Node]]:
        """Nodes, parents first, with their depths.

        Args:
            roots: they and what is below them; None: every tree there was.
            t_s: only what is in view at that time; without it, every node that ever was.
        """
        stack = [(0, root) for root in reversed(self.roots if roots is None else roots)]
        while stack:
            depth, number = stack.pop()
            node = self.nodes[number]
            if t_s < math.inf and not node.in_view(t_s):
                continue  # nor is anything below it
            yield depth, node
            stack.extend((depth + 1, child) for child in reversed(node.children))

    def dumped(self) -> dict[str, Any]:
        """What of it is given to other programs, by name."""
        every = msgspec.structs.asdict(self)
        return {name: value for name, value in every.items() if name not in _NOT_DUMPED}
