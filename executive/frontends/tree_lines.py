"""The live tree as lines of text: what is done, what is being done, what comes."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Composite, Selector
from py_trees.decorators import Decorator, OneShot

from executive.engine.recorder import kind
from executive.journal.pages.model import State
from executive.journal.pages.snapshot import WORKINGS
from executive.journal.pages.text import MARKS
from executive.trees.recovery import Recover

_STATES: dict[Status, State] = {
    Status.INVALID: "waiting",
    Status.RUNNING: "running",
    Status.SUCCESS: "done",
    Status.FAILURE: "failed",
}


class Line(msgspec.Struct, frozen=True):
    """One node: how deep it stands, its name, its state, and what it says of itself."""

    depth: int
    name: str
    state: State
    note: str = ""


def lines(node: Behaviour, depth: int = 0, *, past: State | None = None) -> Iterator[Line]:
    """A subtree in reading order, without the nodes that mean nothing to people.

    `past` is the state of a subtree that its parent has left behind: py_trees forgets it.
    """
    if _was_done(node):
        past = "done"
    node = _plain(node)
    if _is_working(node):
        return
    state = past if past and node.status is Status.INVALID else _STATES[node.status]
    if isinstance(node, Recover) and node.parent and node.parent.children[-1] is not node:
        state = "done"  # it fails by design, so that the remedy behind it has its turn
    note = node.feedback_message if not node.children else ""
    yield Line(depth, node.name, state, note)
    for child, left in _left_behind(node, past):
        yield from lines(child, depth + 1, past=left)


def _left_behind(node: Behaviour, past: State | None) -> Iterator[tuple[Behaviour, State | None]]:
    """The children, each with the state that it was left behind in."""
    chooses = isinstance(node, Selector)
    left: State = "failed" if chooses else "done"
    current = node.current_child if isinstance(node, Composite) else None
    ahead = current is None
    for child in node.children:
        ahead = ahead or child is current
        yield child, past if ahead else left
        if ahead and past == "failed" and not chooses and not _was_done(child):
            past = None  # what comes after the one that failed was never begun


def _was_done(node: Behaviour) -> bool:
    """Whether it is a step that is not done again because it was done."""
    return isinstance(node, OneShot) and node.final_status is Status.SUCCESS


def text(node: Behaviour, *, marks: dict[State, str] = MARKS) -> str:
    """A subtree as text, one line a node."""
    return "\n".join(
        f"{'  ' * line.depth}{marks[line.state]} {line.name}{f': {line.note}' if line.note else ''}"
        for line in lines(node)
    )


def _plain(node: Behaviour) -> Behaviour:
    """What stands behind decorators, and behind nodes around a single one of the same name."""
    while True:
        if isinstance(node, Decorator):
            node = node.decorated
            continue
        below = [child for child in node.children if not _is_working(child)]
        if len(below) != 1 or node.name not in ("task", below[0].name):
            return node
        node = below[0]


def _is_working(node: Behaviour) -> bool:
    """Whether it is only there to make a loop, an attempt or a choice work, and did no more."""
    if isinstance(node, Recover):
        return not node.feedback_message
    what = kind(node)
    return what in WORKINGS or (what == "deadline" and node.status is not Status.FAILURE)
