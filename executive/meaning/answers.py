"""What the robot says of itself and of what it knows, put into words when its turn comes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from executive.behaviours.conditions import Predicate
from executive.behaviours.run_skill import Bound
from executive.blackboard import HEALTH, HELD, WORLD, Blackboard
from executive.meaning.knowledge import Knowledge, stands_on
from executive.skills.say import SayParams
from robot.errors import Failure, failure
from robot.messages import Place, Track


def is_held(ids: frozenset[str]) -> Predicate:
    """Whether one of the objects is in a hand."""
    return lambda board: bool(ids & set(board.read(HELD).values()))


def is_there(ids: frozenset[str], places: Iterable[Place]) -> Predicate:
    """Whether one of the objects is believed to be there (on one of the places, if any)."""
    surfaces = tuple(places)
    return lambda board: bool(_seen(board, ids, surfaces))


def count(ids: frozenset[str], places: Iterable[Place], *, noun: str) -> Bound:
    """Says how many of the objects have been seen (on one of the places, if any)."""
    surfaces = tuple(places)

    def words(board: Blackboard) -> SayParams:
        number = len(_seen(board, ids, surfaces))
        where = f" on the {surfaces[0].name}" if surfaces else ""
        plural = "" if number == 1 else "s"
        return SayParams(text=f"I see {number} {noun}{plural}{where}.")

    return words


def report(topic: str, knowledge: Knowledge) -> Bound:
    """Says something about the robot itself."""

    def words(board: Blackboard) -> SayParams | Failure:
        speak = _REPORTS.get(topic)
        if speak is None:
            return failure("unsupported", f"this robot cannot report on {topic!r} yet")
        return SayParams(text=speak(board, knowledge))

    return words


def _seen(board: Blackboard, ids: frozenset[str], places: tuple[Place, ...]) -> list[Track]:
    world = board.read(WORLD)
    if world is None:
        return []
    seen = [t for t in world.tracks if t.id in ids and t.X_WO is not None and not t.missing]
    if not places:
        return seen
    return [t for t in seen if t.X_WO and any(stands_on(t.X_WO, place) for place in places)]


def _names(ids: Iterable[str], knowledge: Knowledge) -> str:
    infos = [knowledge.object(object_id) for object_id in ids]
    names = [info.full_name for info in infos if info is not None]
    return " and ".join(names)


def _holding(board: Blackboard, knowledge: Knowledge) -> str:
    held = board.read(HELD).values()
    return f"I hold {_names(held, knowledge)}." if held else "My hands are empty."


def _seeing(board: Blackboard, knowledge: Knowledge) -> str:
    ids = frozenset(info.id for info in knowledge.map.objects)
    seen = [track.id for track in _seen(board, ids, ())]
    return f"I have seen {_names(seen, knowledge)}." if seen else "I have not seen anything yet."


def _location(board: Blackboard, knowledge: Knowledge) -> str:
    world = board.read(WORLD)
    if world is None:
        return "I do not know where I am."
    x, y, _ = world.X_WB.p
    heading = math.degrees(world.X_WB.yaw_rad)
    here = knowledge.room_at(world.X_WB.p)
    room = f" in the {here}" if here else ""
    return f"I am{room} at x {x:.1f} m, y {y:.1f} m, heading {heading:.0f} degrees."


def _health(board: Blackboard, _knowledge: Knowledge) -> str:
    findings = board.read(HEALTH).findings
    if not findings:
        return "I am well."
    return "Not well: " + "; ".join(finding.failure.cause for finding in findings) + "."


def _status(board: Blackboard, knowledge: Knowledge) -> str:
    return f"{_location(board, knowledge)} {_holding(board, knowledge)}"


def _capabilities(_board: Blackboard, _knowledge: Knowledge) -> str:
    return "I can walk, look for things, pick them up, put them down, and keep my balance."


_REPORTS: dict[str, Callable[[Blackboard, Knowledge], str]] = {
    "holding": _holding,
    "seeing": _seeing,
    "location": _location,
    "status": _status,
    "health": _health,
    "capabilities": _capabilities,
}
