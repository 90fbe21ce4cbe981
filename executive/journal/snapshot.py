"""The tree as it stood at a time, for people: without the nodes that mean nothing to them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import msgspec

from executive.journal.run import OVER, Run
from executive.journal.tree import Change, Node, State

_GUARDS = frozenset({"sequence", "selector"})
_WORKINGS = frozenset({"round", "again", "caught", "as_it_ended", "matches"})
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
    return _tree(run.walk(t_s=when_s), hidden, lambda node: _shown(node, when_s))


def come_to_rest(run: Run) -> None:
    """Let what stands around the jobs of a whole run be over where all of them are.

    The last tick, in which that is noted, tells no more of itself; of a run that was cut off what
    ran last is what it was at. What of a job still ran was given up without another tick: it was
    stopped.
    """
    if not run.endings or any(job.states and job.states[-1][1] not in OVER for job in run.jobs):
        return
    around = {node.parent for node in run.nodes.values() if node.kind == "jobs"}
    below = {number for parent in around if parent >= 0 for number in run.nodes[parent].children}
    guards = [number for number in below if run.nodes[number].kind in _GUARDS]
    jobs = [number for number in below if run.nodes[number].kind == "jobs"]
    ends: tuple[tuple[list[int], State], ...] = ((guards, "done"), (jobs, "stopped"))
    for roots, state in ends:
        for _, node in run.walk(roots):
            if _last(node).state == "running":
                node.changes.append(Change(run.end_s, state))


def at_work(run: Run) -> list[Shown]:
    """The newest job as it stands now, for those who watch the robot; nothing if there is none.

    They see the same nodes as in a snapshot, but its root by its own name, since what was asked for
    stands above it, and what every leaf says of itself in place of how long it took.
    """
    jobs = next((node for _, node in run.walk(run.roots[-1:]) if node.kind == "jobs"), None)
    there = [number for number in jobs.children if run.nodes[number].gone_s is None] if jobs else []
    part = list(run.walk(there[-1:], t_s=run.end_s))
    hidden = {node.id for _, node in part if node.kind == "recover" and not _last(node).note}
    _hide_what_holds_together(run, part, hidden, titles=False)
    return _tree(part, hidden, _as_it_works)


def in_order(roots: Iterable[Shown]) -> list[tuple[int, Shown]]:
    """A picture in reading order, with depths."""
    return [one for root in roots for one in root.walk()]


def window(lines: Sequence[tuple[int, Shown]], rows: int) -> Sequence[tuple[int, Shown]]:
    """The lines of a picture around what runs now, `rows` at most."""
    running = [index for index, (_, shown) in enumerate(lines) if shown.state == "running"]
    middle = running[-1] if running else 0
    first = max(0, min(len(lines) - rows, middle - rows // 2))
    return lines[first : first + rows]


def _tree(
    nodes: Iterable[tuple[int, Node]], hidden: set[int], make: Callable[[Node], Shown]
) -> list[Shown]:
    """Some nodes, given in reading order, each below the nearest that is shown."""
    roots: list[Shown] = []
    above: list[tuple[int, list[Shown]]] = []
    for depth, node in nodes:
        while above and above[-1][0] >= depth:
            above.pop()
        if node.id in hidden:
            continue
        shown = make(node)
        (above[-1][1] if above else roots).append(shown)
        above.append((depth, shown.children))
    return roots


def inner(run: Run) -> set[int]:
    """The nodes that mean nothing to people, in the whole run.

    Those are: what stands around the jobs, save guards that had something to do; the workings of
    loops and attempts; deadlines that were kept; choices of a remedy that were never made; and
    nodes around a single one of the same name, or whose name says no more than "task".
    """
    hidden = _around_jobs(run)
    _hide_what_holds_together(run, list(run.walk()), hidden, titles=True)
    return hidden


def _hide_what_holds_together(
    run: Run, nodes: Sequence[tuple[int, Node]], hidden: set[int], *, titles: bool
) -> None:
    """Add to `hidden`, children first; with `titles` the root of a job has what was asked for."""
    for _, node in reversed(nodes):
        if node.id in hidden:
            continue
        if _is_working(node):
            hidden.add(node.id)
        elif len(below := _visible_below(run, node, hidden)) == 1:
            alike = node.name in ("task", run.nodes[below[0]].name)
            if alike and not (titles and node.title):
                hidden.add(node.id)


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
    return node.kind in _WORKINGS or (node.kind == "recover" and not node.changes)


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


def _as_it_works(node: Node) -> Shown:
    """A node as people see it while it is at work."""
    last = _last(node)
    note = last.note if not node.children else ""
    return Shown(id=node.id, kind=node.kind, name=node.name, state=last.state, note=note)


def _last(node: Node) -> Change:
    return node.changes[-1] if node.changes else Change(node.born_s, "waiting")


def _took_s(node: Node, t_s: float) -> float | None:
    """How long the newest activity before `t_s` has lasted."""
    runs = [span for span in node.intervals(t_s) if span.state == "running" and span.begin_s <= t_s]
    return round(min(runs[-1].end_s, t_s) - runs[-1].begin_s, 3) if runs else None
