"""Shapes of trees that come again, as functions over py_trees' stock nodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from py_trees.behaviour import Behaviour
from py_trees.common import OneShotPolicy
from py_trees.composites import Selector
from py_trees.composites import Sequence as InOrder
from py_trees.decorators import OneShot

from executive.behaviours.conditions import Check, Predicate
from executive.blackboard import Blackboard


def once(node: Behaviour) -> Behaviour:
    """A node that, once it succeeded, is not run again: an interrupted task goes on after it."""
    return OneShot(node.name, node, policy=OneShotPolicy.ON_SUCCESSFUL_COMPLETION)


def in_order(name: str, steps: Sequence[Behaviour]) -> Behaviour:
    """One step after the other until one fails; after an interruption, on from the same step."""
    return InOrder(name, memory=True, children=[once(step) for step in steps])


def guarded(name: str, condition: Behaviour, steps: Sequence[Behaviour]) -> Behaviour:
    """The steps if the condition holds when its turn comes; asked once, then seen through."""
    return InOrder(name, memory=True, children=[condition, *steps])


def either(
    name: str, question: Predicate, *, then: Behaviour, otherwise: Behaviour, board: Blackboard
) -> Behaviour:
    """One branch or the other, as the answer is when asked; it is asked once in a task."""
    answers: list[bool] = []

    def yes(read: Blackboard) -> bool:
        if not answers:
            answers.append(question(read))
        return answers[0]

    def no(read: Blackboard) -> bool:
        return not yes(read)

    branches = [
        guarded("then", Check("yes", yes, board=board), [then]),
        guarded("else", Check("no", no, board=board), [otherwise]),
    ]
    return Selector(name, memory=True, children=branches)


class Alternatives(Selector):
    """A selector with memory that can be given one more alternative while it runs."""

    def __init__(self, name: str, first: Behaviour) -> None:
        """Begin with one alternative."""
        super().__init__(name, memory=True, children=[first])

    def extend(self, after: Behaviour, nodes: Sequence[Behaviour]) -> None:
        """Put nodes after one of the alternatives, in place of what came after it."""
        index = self.children.index(after)
        for old in self.children[index + 1 :]:
            self.remove_child(old)
        self.add_children(list(nodes))


Build = Callable[[int], Behaviour]
"""Builds a fresh subtree for an attempt, counted from 0."""
