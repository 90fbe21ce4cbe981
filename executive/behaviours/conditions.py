"""Leaves that read the blackboard and answer at once."""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.blackboard import HEALTH, PAUSE, RESTLESS, STOP, Blackboard
from executive.health import Level

Predicate = Callable[[Blackboard], bool]


class Check(Behaviour):
    """SUCCESS while a predicate over the blackboard holds, else FAILURE."""

    def __init__(self, name: str, predicate: Predicate, *, board: Blackboard) -> None:
        """Make the leaf; `predicate` only reads."""
        super().__init__(name)
        self._predicate = predicate
        self._board = board

    def update(self) -> Status:
        """Ask the predicate."""
        return Status.SUCCESS if self._predicate(self._board) else Status.FAILURE


def must_end(board: Blackboard) -> bool:
    """A person asked for a stop, or the robot is too unwell to go on."""
    return bool(board.read(STOP)) or board.read(HEALTH).calls_for(Level.SIT)


def must_return(board: Blackboard) -> bool:
    """The robot had better go back while it can."""
    return board.read(HEALTH).level is Level.RETURN


def must_hold(board: Blackboard) -> bool:
    """Something is missing without which the robot had better stand still."""
    return board.read(HEALTH).calls_for(Level.HOLD)


def must_pause(board: Blackboard) -> bool:
    """A person wants the robot to stand for a while, or a skill left it moving."""
    return bool(board.read(PAUSE)) or board.read(RESTLESS)
