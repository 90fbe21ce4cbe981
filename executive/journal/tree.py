"""The nodes of a run's trees, with their states over time."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from typing import Literal

import msgspec

State = Literal["waiting", "running", "done", "failed", "stopped"]
"""What people are told of a node. `stopped`: it was running and was interrupted from above.

A node that was done or has failed stays so until it begins anew, or what it belongs to comes round
again; py_trees itself forgets it sooner.
"""


class Change(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """From `t_s` on a node is in a state and says `note` of itself."""

    t_s: float
    state: State
    note: str = ""


class Interval(msgspec.Struct, frozen=True, array_like=True):
    """A state and how long it lasted."""

    begin_s: float
    end_s: float
    state: State


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
        index = bisect_right(self.changes, t_s, key=lambda change: change.t_s)
        return self.changes[index - 1] if index else Change(self.born_s, "waiting")

    def in_view(self, t_s: float) -> bool:
        """Whether it belongs to the tree as it is shown at a time."""
        return self.born_s <= t_s and (self.hidden_s is None or t_s < self.hidden_s)

    def intervals(self, end_s: float) -> list[Interval]:
        """Its states other than waiting, one after the other, up to the end of the run."""
        ends = [*(change.t_s for change in self.changes[1:]), self.gone_s or end_s]
        pairs = zip(self.changes, ends, strict=False)
        found = [Interval(change.t_s, end, change.state) for change, end in pairs]
        return [interval for interval in _joined(found) if interval.state != "waiting"]


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
