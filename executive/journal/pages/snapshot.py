"""The tree as it stood at a time, for people: without the nodes that mean nothing to them."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from executive.journal.pages.model import Node, Run, State

_GUARDS = frozenset({"sequence", "selector"})
WORKINGS = frozenset({"round", "again", "caught", "as_it_ended", "matches"})
"""Kinds of nodes by which loops, attempts and handlers do their work (`executive.trees.flow`)."""


class Shown(msgspec.Struct, kw_only=True):
    """One node of a picture, with what stands below it.

    `took_s` is how long it has been running, or ran the last time; None if it never did.
    """

    id: int
    kind: str
    name: str
    state: State
    note: str = ""
    took_s: float | None = None
    children: list[Shown] = []

    def walk(self, depth: int = 0) -> Iterator[tuple[int, Shown]]:
        """This and all below it in reading order, with their depths."""
        stack: list[tuple[int, Shown]] = [(depth, self)]
        while stack:
            level, shown = stack.pop()
            yield level, shown
            stack.extend((level + 1, child) for child in reversed(shown.children))


def snapshot(run: Run, t_s: float | None = None, *, everything: bool = False) -> list[Shown]:
    """The tree at a time (None: at the end); more than one root where some are not shown.

    Args:
        run: what happened.
        t_s: when.
        everything: also what is only there to hold the tree together.
    """
    when_s = run.end_s if t_s is None else t_s
    hidden: set[int] = set() if everything else inner(run) | _idle(run, when_s)
    roots: list[Shown] = []
    above: list[tuple[int, list[Shown]]] = []
    for depth, node in run.walk():
        while above and above[-1][0] >= depth:
            above.pop()
        if node.id in hidden or not node.in_view(when_s):
            continue
        shown = _shown(node, when_s)
        (above[-1][1] if above else roots).append(shown)
        above.append((depth, shown.children))
    return roots


def inner(run: Run) -> set[int]:
    """The nodes that mean nothing to people, in the whole run.

    Those are: what stands around the jobs, save guards that had something to do; the workings of
    loops and attempts; deadlines that were kept; choices of a remedy that were never made; and
    nodes around a single one of the same name.
    """
    hidden = _around_jobs(run)
    for _, node in reversed(list(run.walk())):
        if node.id in hidden:
            continue
        if _is_working(node):
            hidden.add(node.id)
        elif len(below := _visible_below(run, node, hidden)) == 1:
            child = run.nodes[below[0]]
            if child.name == node.name and not node.title:
                hidden.add(node.id)
    return hidden


def _idle(run: Run, t_s: float) -> set[int]:
    """Guards that have nothing to do at a time, and choices of a remedy still to be made."""
    around = {node.parent for node in run.nodes.values() if node.kind == "jobs"}
    idle: set[int] = set()
    for _, node in run.walk():
        state = node.at(t_s).state
        guard = node.parent in around and node.kind in _GUARDS and state != "running"
        if node.parent in idle or guard or (node.kind == "recover" and state == "waiting"):
            idle.add(node.id)
    return idle


def _is_working(node: Node) -> bool:
    if node.kind == "deadline":
        return all(change.state != "failed" for change in node.changes)
    return node.kind in WORKINGS or (node.kind == "recover" and not node.changes)


def _visible_below(run: Run, node: Node, hidden: set[int]) -> list[int]:
    """The nearest nodes below that are shown."""
    found: list[int] = []
    stack = list(reversed(node.children))
    while stack:
        number = stack.pop()
        if number not in hidden:
            found.append(number)
        else:
            stack.extend(reversed(run.nodes[number].children))
    return found


def _around_jobs(run: Run) -> set[int]:
    """Everything outside the jobs, except guards that have been at work, with what is in them."""
    jobs = [node for node in run.nodes.values() if node.kind == "jobs"]
    if not jobs:
        return set()
    kept: set[int] = set()
    for node in jobs:
        beside = run.nodes[node.parent].children if node.parent >= 0 else []
        keep = [*node.children, *(number for number in beside if _guarded(run.nodes[number]))]
        while keep:
            number = keep.pop()
            kept.add(number)
            keep.extend(run.nodes[number].children)
    return run.nodes.keys() - kept


def _guarded(node: Node) -> bool:
    return node.kind in _GUARDS and any(change.state == "running" for change in node.changes)


def _shown(node: Node, t_s: float) -> Shown:
    change = node.at(t_s)
    tells = change.state not in ("waiting", "done") or node.kind == "recover"
    note = change.note if tells else ""
    name = node.title or node.name
    return Shown(
        id=node.id, kind=node.kind, name=name, state=change.state, note=note,
        took_s=_took_s(node, t_s), children=[],
    )  # fmt: skip


def _took_s(node: Node, t_s: float) -> float | None:
    """How long the newest activity before `t_s` has lasted."""
    runs = [span for span in node.intervals(t_s) if span.state == "running" and span.begin_s <= t_s]
    return round(min(runs[-1].end_s, t_s) - runs[-1].begin_s, 3) if runs else None
