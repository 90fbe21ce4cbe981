"""Trees of a run, as they grow and change: the `tree`, `node` and `phase` events of a journal."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import Any, Literal

import msgspec

from executive.journal.keeping import clipped, keep_ends
from executive.journal.run import Run
from executive.journal.tree import Change, Node, State

Status = Literal["invalid", "running", "success", "failure"]

MOST_NODES, MOST_CHANGES, MOST_OF_ONE, MOST_TITLES = 10_000, 200_000, 1000, 100
"""What is held of trees: a job has some hundred nodes, which change ten times each."""

INTERRUPTED = "interrupted"
_STATES: dict[Status, State] = {"running": "running", "success": "done", "failure": "failed"}


class _Born(msgspec.Struct, array_like=True):
    id: int
    parent: int
    kind: str
    name: str
    step: str = ""


class _Tree(msgspec.Struct):
    nodes: list[_Born] = []
    order: list[tuple[int, list[int]]] = []


class _Status(msgspec.Struct):
    id: int
    status: Status
    note: str = ""


class TreeReader:
    """Puts nodes and their changes into a run.

    Every recorder counts its nodes from 0, so a run that was gone on with has several trees: a new
    root begins a new one, and numbers are moved on.
    """

    def __init__(self, run: Run) -> None:
        """Tell of the trees of `run`."""
        self._run = run
        self._nodes = run.nodes
        self._roots = run.roots
        self._offset = 0
        self._statuses: dict[int, Status] = {}
        self._renewed: dict[int, float] = {}
        self._titles: deque[str] = deque(maxlen=MOST_TITLES)
        self._gone: dict[int, dict[int, None]] = {}  # in view still, by parent
        self._changes = 0
        self._room_at = MOST_CHANGES
        self._remedied_s = -1.0
        self._at_work: dict[str, dict[int, None]] = {}  # running skills by name

    def remedied(self, t_s: float) -> None:
        """A remedy was chosen: the node that did so is about to fail, as it always does."""
        self._remedied_s = t_s

    def begin(self, title: str) -> None:
        """A job is about to get its part of the tree: the next one under a node of kind `jobs`."""
        self._titles.append(clipped(title))

    def tree(self, t_s: float, data: Mapping[str, Any]) -> None:
        """Take a ``tree`` event. Raises ValueError if it does not fit what was told before."""
        told = msgspec.convert(data, _Tree)
        if any(born.parent < 0 for born in told.nodes):
            self._replant(t_s)
        self._make_space(len(told.nodes))
        known = {born.id + self._offset for born in told.nodes} | self._nodes.keys()
        if any(child + self._offset not in known for _, line in told.order for child in line):
            raise ValueError("a child that nobody knows")
        for born in told.nodes:
            self._add(t_s, born)
        for parent, line in told.order:
            self._reorder(t_s, self._known(parent), [child + self._offset for child in line])

    def node(self, t_s: float, data: Mapping[str, Any]) -> int:
        """Take a ``node`` event; returns the node's number in the run. Raises ValueError."""
        told = msgspec.convert(data, _Status)
        node = self._known(told.id)
        before = self._statuses.get(node.id, "invalid")
        self._statuses[node.id] = told.status
        if node.kind == "skill":
            self._note_work(node, told.status)
        if told.status == "running" and before in ("success", "failure"):
            self._renew(t_s, node)
        if node.kind == "check" and told.status in ("success", "failure"):
            self._answer(t_s, node, told.status)
            return node.id
        if node.changes and node.changes[-1] == Change(t_s, "running", INTERRUPTED):
            node.changes.pop()  # for good: what it is now says more
        state = self._state(t_s, node, told.status)
        if state is not None:
            self._change(node, Change(t_s, state, told.note))
        return node.id

    def _answer(self, t_s: float, node: Node, status: Status) -> None:
        """A question that is answered with no has not failed, nor has what asked it first."""
        if status == "success":
            self._change(node, Change(t_s, "done", "yes"))
            return
        self._change(node, Change(t_s, "waiting", "no"))
        asks = self._nodes.get(node.parent)
        if asks is None or asks.children[0] != node.id or not asks.changes:
            return
        if asks.changes[-1].state == "failed" and asks.changes[-1].t_s == t_s:
            asks.changes.pop()
            if _past(asks):
                self._change(asks, Change(t_s, "waiting"))

    def phase(self, t_s: float, data: Mapping[str, Any]) -> None:
        """Take a ``phase`` event: a running skill says something else of itself."""
        self._say(t_s, data, str(data["phase"]))

    def stopping(self, t_s: float, data: Mapping[str, Any]) -> None:
        """Take a ``stopping`` event: a skill is interrupted, be it for a while or for good."""
        self._say(t_s, data, INTERRUPTED)

    def _say(self, t_s: float, data: Mapping[str, Any], text: str) -> None:
        path = str(data.get("id", ""))
        for number in self._at_work.get(str(data["step"]), ()):
            node = self._nodes[number]
            if not path or not node.step or node.step == path:
                self._change(node, Change(t_s, "running", text))

    def _note_work(self, node: Node, status: Status) -> None:
        at_work = self._at_work.setdefault(node.name, {})
        if status == "running":
            at_work[node.id] = None
        else:
            at_work.pop(node.id, None)

    def _known(self, number: int) -> Node:
        try:
            return self._nodes[number + self._offset]
        except KeyError:
            raise ValueError(f"no node {number} is known") from None

    def _replant(self, t_s: float) -> None:
        for root in self._roots[-1:]:
            self._remove(t_s, root)
        self._offset = max(self._nodes, default=-1) + 1

    def _add(self, t_s: float, born: _Born) -> None:
        number = born.id + self._offset
        parent = born.parent + self._offset if born.parent >= 0 else -1
        node = Node(
            id=number, parent=parent, kind=born.kind, name=born.name, step=born.step, born_s=t_s
        )
        if number in self._nodes or (parent >= 0 and parent not in self._nodes):
            raise ValueError(f"node {born.id} cannot stand there")
        self._nodes[number] = node
        if self._titles and parent >= 0 and self._nodes[parent].kind == "jobs":
            node.title = self._titles.popleft()
        siblings = self._nodes[parent].children if parent >= 0 else self._roots
        self._make_room(t_s, parent)
        siblings.append(number)

    def _make_room(self, t_s: float, parent: int) -> None:
        """Something new among nodes of which some are gone: those are not shown any more."""
        stack = list(self._gone.pop(parent, ()))
        while stack:
            node = self._nodes[stack.pop()]
            if node.hidden_s is None:
                node.hidden_s = t_s
                stack.extend(node.children)

    def _reorder(self, t_s: float, parent: Node, line: list[int]) -> None:
        """The children that a node has now; those that are gone keep their place among them."""
        present = set(line)
        gone = [number for number in parent.children if number not in present]
        for number in gone:
            self._remove(t_s, number)
        if any(self._nodes[number].born_s == t_s for number in line):
            self._make_room(t_s, parent.id)
        after: dict[int, list[int]] = {}
        last = -1
        for number in parent.children:
            if number in present:
                last = number
            else:
                after.setdefault(last, []).append(number)
        parent.children = after.get(-1, [])
        for number in line:
            parent.children += [number, *after.get(number, [])]

    def _remove(self, t_s: float, number: int) -> None:
        """Take a subtree out; a node that was still running then was stopped."""
        stack = [number]
        while stack:
            node = self._nodes[stack.pop()]
            if node.gone_s is None:
                node.gone_s = t_s
                self._gone.setdefault(node.parent, {})[node.id] = None
                self._note_work(node, "invalid")
                if self._statuses.pop(node.id, "invalid") == "running":
                    self._change(node, Change(t_s, "stopped"))
            stack.extend(node.children)

    def _change(self, node: Node, change: Change) -> None:
        gone = keep_ends(node.changes, change, MOST_OF_ONE)
        self._run.left_out += gone
        self._changes += 1 - gone
        if self._changes > MOST_CHANGES:
            self._make_space(0)

    def _make_space(self, coming: int) -> None:
        """Let go of the oldest parts that are gone, when there is too much of a tree to hold.

        Raises:
            ValueError: if what is there now is too large already.
        """
        if len(self._nodes) + coming <= MOST_NODES and self._changes <= MOST_CHANGES:
            return
        past = [node.id for node in self._nodes.values() if self._begins_past(node)]
        for number in past:
            if len(self._nodes) + coming <= 0.75 * MOST_NODES:
                break
            self._forget(number)
        share = max(4, MOST_CHANGES // (2 * max(1, len(self._nodes))))
        for node in self._nodes.values():
            if len(node.changes) > share:
                self._run.left_out += len(node.changes) - share
                del node.changes[share // 2 : share // 2 - share]
        self._changes = sum(len(node.changes) for node in self._nodes.values())
        for trouble in self._run.troubles:
            if trouble.node not in self._nodes:
                trouble.node = -1
        if len(self._nodes) + coming > MOST_NODES:
            raise ValueError(f"a tree of more than {MOST_NODES} nodes")

    def _begins_past(self, node: Node) -> bool:
        above = self._nodes.get(node.parent)
        return node.gone_s is not None and (above is None or above.gone_s is None)

    def _forget(self, number: int) -> None:
        """Leave out a node that is gone, and all below it, as if they had never been."""
        parent = self._nodes.get(self._nodes[number].parent)
        (parent.children if parent is not None else self._roots).remove(number)
        self._gone.get(self._nodes[number].parent, {}).pop(number, None)
        stack = [number]
        while stack:
            node = self._nodes.pop(stack.pop())
            self._gone.pop(node.id, None)
            self._renewed.pop(node.id, None)
            self._run.left_out += 1
            stack.extend(node.children)

    def _renew(self, t_s: float, node: Node) -> None:
        """What was done comes round again: nothing below it is done any more."""
        stack = list(node.children)
        while stack:
            below = self._nodes[stack.pop()]
            if below.gone_s is not None:
                continue
            stack.extend(below.children)
            self._renewed[below.id] = t_s
            if self._statuses.get(below.id, "invalid") == "invalid" and _past(below):
                self._change(below, Change(t_s, "waiting"))

    def _state(self, t_s: float, node: Node, status: Status) -> State | None:
        """What a new status is for people; None when it is nothing new."""
        if node.kind == "recover" and status == "failure" and self._remedied_s == t_s:
            return "done"
        if status != "invalid":
            return _STATES[status]
        if self._renewed.get(node.id) == t_s:
            return "waiting"
        running = bool(node.changes) and node.changes[-1].state == "running"
        return "stopped" if running else None


def _past(node: Node) -> bool:
    return bool(node.changes) and node.changes[-1].state != "waiting"
