"""What the robot says of itself and of what it knows, put into words when its turn comes."""

from __future__ import annotations

from collections.abc import Iterable

from executive.behaviours.conditions import Predicate
from executive.behaviours.run_skill import Bound
from executive.blackboard import HELD, WORLD, Blackboard
from executive.meaning.knowledge import Knowledge
from executive.meaning.robot_state import state_of
from executive.skills.motions.support import stands_on
from executive.skills.say import SayParams
from intents import replies
from intents.goals import ReportTopic
from robot.messages import Place, Track


def is_held(ids: frozenset[str]) -> Predicate:
    """Whether one of the objects is in a hand."""
    return lambda board: bool(ids & set(board.read(HELD).values()))


def is_there(ids: frozenset[str], places: Iterable[Place]) -> Predicate:
    """Whether one of the objects is believed to be there (on one of the places, if any)."""
    surfaces = tuple(places)
    return lambda board: bool(_seen(board, ids, surfaces))


def count(ids: frozenset[str], places: Iterable[Place], *, noun: str, where: str = "") -> Bound:
    """Says how many of the objects have been seen (on one of the places, if any)."""
    surfaces = tuple(places)

    def words(board: Blackboard) -> SayParams:
        number = len(_seen(board, ids, surfaces))
        plural = "" if number == 1 else "s"
        return SayParams(text=f"I see {number} {noun}{plural}{where}.")

    return words


def report(topic: ReportTopic, knowledge: Knowledge, *, skills: frozenset[str]) -> Bound:
    """Says something about the robot itself; `skills` as for `state_of`."""

    def words(board: Blackboard) -> SayParams:
        return SayParams(text=replies.report(topic, state_of(board, knowledge, skills=skills)))

    return words


def _seen(board: Blackboard, ids: frozenset[str], places: tuple[Place, ...]) -> list[Track]:
    world = board.read(WORLD)
    if world is None:
        return []
    seen = [t for t in world.tracks if t.id in ids and t.X_WO is not None and not t.missing]
    if not places:
        return seen
    return [t for t in seen if t.X_WO and any(stands_on(t.X_WO, place) for place in places)]
