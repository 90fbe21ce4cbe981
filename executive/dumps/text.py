"""A tree as lines of text: what is done, what is being done, what comes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Composite, Selector
from py_trees.decorators import Decorator, OneShot

from executive.dumps.model import State
from executive.dumps.record import kind
from executive.dumps.snapshot import WORKINGS, Shown
from executive.trees.recovery import Recover

Style = Literal["unicode", "ascii", "colour"]

_STATES: dict[Status, State] = {
    Status.INVALID: "waiting",
    Status.RUNNING: "running",
    Status.SUCCESS: "done",
    Status.FAILURE: "failed",
}
MARKS: dict[State, str] = {
    "waiting": "·", "running": "▸", "done": "✓", "failed": "✗", "stopped": "■",
}  # fmt: skip
ASCII_MARKS: dict[State, str] = {
    "waiting": " ", "running": ">", "done": "+", "failed": "x", "stopped": "#",
}  # fmt: skip
COLOURS: dict[State, str] = {
    "waiting": "2", "running": "1;33", "done": "32", "failed": "31", "stopped": "35",
}  # fmt: skip
"""How a terminal shows a state: parameters of the SGR sequence (ECMA-48)."""


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


def picture(roots: Iterable[Shown], *, style: Style = "unicode") -> str:
    """A snapshot as text, one line a node, with how long each has taken.

    Control characters in names are left out, so that no name can command a terminal.
    """
    return "\n".join(_drawn(depth, shown, style) for root in roots for depth, shown in root.walk())


def _drawn(depth: int, shown: Shown, style: Style) -> str:
    marks = ASCII_MARKS if style == "ascii" else MARKS
    words = "".join(letter for letter in shown.name if letter.isprintable())
    note = "".join(letter for letter in shown.note if letter.isprintable())
    line = f"{marks[shown.state]} {words}"
    tail = f": {note}" if note else ""
    tail += f"  ({shown.took_s:.1f} s)" if shown.took_s else ""
    if style == "ascii":
        line, tail = (text.encode("ascii", "replace").decode() for text in (line, tail))
    if style == "colour":
        line = f"\x1b[{COLOURS[shown.state]}m{line}\x1b[0m"
        tail = f"\x1b[2m{tail}\x1b[0m" if tail else ""
    return "  " * depth + line + tail


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
