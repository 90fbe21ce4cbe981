"""Writes what the tree does into the journal: its shape, its statuses, the board, the way walked.

`Recorder.update` is called after every tick and writes what has changed since the last one:

- ``tree``: ``nodes`` that are new, as ``[number, parent's number or -1, kind, name, step id]``, and
  ``order``, the children of each older node that got or lost some, as ``[number, [numbers]]``.
  Numbers count up from 0 in order of appearance and are not used again; a root (parent -1) begins
  a new tree. A node that no parent names any more is gone.
- ``node``: ``id``, ``status`` (a py_trees status in lower case), and what the node says of itself.
- ``board``: ``key`` and ``value`` of the blackboard.
- ``map``: once, what a drawing of the world needs; ``pose``: see `executive.engine.surroundings`.

All of it is a function of the ticks alone, so that the same `fast` run writes the same bytes.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import msgspec
from py_trees import composites
from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import Decorator

from executive.behaviours.conditions import Check
from executive.behaviours.run_skill import RunSkill
from executive.blackboard import BODY, HEALTH, KEYS, MAP, NOW, WORLD, Blackboard, Key
from executive.engine.surroundings import PoseWatch, drawing

if TYPE_CHECKING:
    from executive.engine.executive import Executive

POSE_PERIOD_S = 0.5
NOTE_CHARS, NAME_CHARS = 160, 200

Write = Callable[..., None]
"""`Stage.record`: an event, stamped with the tick's time."""

_UNRECORDED = frozenset(key.name for key in (NOW, BODY, WORLD, MAP, HEALTH))
"""Keys that change all the time, or have events of their own."""

_KINDS: tuple[tuple[type[Behaviour], str], ...] = (
    (composites.Sequence, "sequence"),
    (composites.Selector, "selector"),
    (composites.Parallel, "parallel"),
    (RunSkill, "skill"),
    (Check, "check"),
)

_status_of: Callable[[Behaviour], Status] = operator.attrgetter("status")
_children_of: Callable[[Behaviour], list[Behaviour]] = operator.attrgetter("children")


class Recorder:
    """Follows one executive; `update` after every tick."""

    def __init__(self, executive: Executive) -> None:
        """Begin with the tree as it stands."""
        self._executive = executive
        self._stage = executive.stage
        write = executive.stage.record
        self._tree = TreeWatch(write)
        self._board = BoardWatch(executive.board, write)
        self._poses = PoseWatch()
        self._map_known = False
        self._pose_due_s = 0.0

    def update(self) -> None:
        """Write what has changed."""
        self._tree.look(self._executive.tree.root)
        self._board.look()
        now_s = self._stage.now_s
        if now_s >= self._pose_due_s:
            self._pose_due_s = now_s + POSE_PERIOD_S - 1e-6
            self._look_around()

    def _look_around(self) -> None:
        board = self._executive.board
        world_map, world, body = board.read(MAP), board.read(WORLD), board.read(BODY)
        if world_map is not None and not self._map_known:
            self._map_known = True
            self._stage.record("map", **drawing(world_map))
        if world is not None:
            news = self._poses.news(world, mode=body.mode if body else "")
            if news:
                self._stage.record("pose", **news)


class TreeWatch:
    """Numbers the nodes of a tree and tells what becomes of them.

    A tick in which nothing changes costs two comparisons of lists.
    """

    def __init__(self, write: Write) -> None:
        """Tell by `write`."""
        self._write = write
        self._count = 0
        self._numbers: dict[Behaviour, int] = {}
        self._nodes: list[Behaviour] = []
        self._statuses: list[Status] = []
        self._parents: list[Behaviour] = []
        self._families: list[list[Behaviour]] = []

    def look(self, root: Behaviour) -> None:
        """Tell what is new; nodes that were taken out tell their last status first."""
        self._tell_statuses()
        if self._nodes[:1] != [root] or self._families != [*map(_children_of, self._parents)]:
            self._tell_structure(root)
            self._tell_statuses()

    def _tell_statuses(self) -> None:
        statuses = [*map(_status_of, self._nodes)]
        if statuses == self._statuses:
            return
        changes = zip(self._nodes, self._statuses, statuses, strict=True)
        self._statuses = statuses
        for node, before, after in changes:
            if after is not before:
                note = node.feedback_message[:NOTE_CHARS]
                noted = {"note": note} if note and not node.children else {}
                self._write("node", id=self._numbers[node], status=after.value.lower(), **noted)

    def _tell_structure(self, root: Behaviour) -> None:
        if self._nodes[:1] != [root]:
            self._numbers = {}
        before = dict(zip(self._nodes, self._statuses, strict=True))
        families = dict(zip(self._parents, self._families, strict=True))
        known = self._numbers
        self._nodes = list(_depth_first(root))
        self._numbers = {node: known.get(node, -1) for node in self._nodes}
        self._parents = [n for n in self._nodes if isinstance(n, composites.Composite | Decorator)]
        self._families = [list(node.children) for node in self._parents]
        nodes = [self._introduce(node) for node in self._nodes if self._numbers[node] < 0]
        order = [
            [known[parent], [self._numbers[child] for child in children]]
            for parent, children in zip(self._parents, self._families, strict=True)
            if parent in known and families[parent] != children
        ]
        self._statuses = [before.get(node, Status.INVALID) for node in self._nodes]
        self._write("tree", nodes=nodes, **({"order": order} if order else {}))

    def _introduce(self, node: Behaviour) -> list[object]:
        """Number a node; its parent has a number already."""
        number = self._numbers[node] = self._count
        self._count += 1
        parent = -1 if node.parent is None else self._numbers.get(node.parent, -1)
        entry: list[object] = [number, parent, kind(node), node.name[:NAME_CHARS]]
        step_id = getattr(node, "step_id", "")
        return [*entry, step_id] if step_id else entry


class BoardWatch:
    """Tells changes of the blackboard, as plain values."""

    def __init__(self, board: Blackboard, write: Write) -> None:
        """Begin with the keys' initial values."""
        self._board = board
        self._write = write
        self._keys: list[Key[Any]] = [key for key in KEYS if key.name not in _UNRECORDED]
        self._values: list[object] = [key.initial for key in self._keys]

    def look(self) -> None:
        """Tell every key whose value is another one than at the last look."""
        read = self._board.read
        for index, key in enumerate(self._keys):
            value = read(key)
            before = self._values[index]
            if value is not before and value != before:
                self._values[index] = value
                self._write("board", key=key.name, value=plain(value))


def kind(node: Behaviour) -> str:
    """What a node is: `sequence`, `selector`, `parallel`, `skill`, `check`, else its class."""
    for kind_, name in _KINDS:
        if isinstance(node, kind_):
            return name
    return re.sub(r"(?<!^)(?=[A-Z])", "_", type(node).__name__).lower()


def plain(value: object) -> object:
    """A value of the blackboard as JSON can have it."""
    if isinstance(value, str):
        return value[:NOTE_CHARS]
    return msgspec.to_builtins(value, enc_hook=lambda odd: str(odd)[:NOTE_CHARS], str_keys=True)


def _depth_first(root: Behaviour) -> Iterator[Behaviour]:
    """Every node, parents first, children in order; no recursion, however deep the tree."""
    stack = [root]
    while stack:
        node = stack.pop()
        yield node
        stack.extend(reversed(node.children))
