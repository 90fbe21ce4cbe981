"""Where the things and the robot were when a sentence was taken: what "the leftmost" meant by then.

A sentence that means things by where they are keeps what it was understood by, so that it means the
same when its job is made again, by another executive or in a replay.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

import msgspec
from msgspec.structs import replace

from executive.meaning.knowledge import Knowledge
from intents.goals import Goal, to_builtins
from intents.grounding import Entity
from intents.relations import Point, Viewpoint
from intents.state import RobotState

RELATIVE = frozenset({"superlative", "relation", "at"})
"""What in a description means things by where they are, or may."""


class Spot(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Where a thing was believed to be; attributes as of `Entity`."""

    at: str = ""
    room: str = ""
    p_WO: Point | None = None
    held: bool = False
    holder: str = ""


class Whereabouts(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Where the things were, by id, and where the robot stood (None: not known).

    `busy`: something else was under way, after which things may stand elsewhere.
    """

    things: dict[str, Spot]
    view: Viewpoint | None = None
    busy: bool = False


def needed(goals: Iterable[Goal], state: RobotState) -> Whereabouts | None:
    """What goals are understood by; None if they mean the same wherever things are."""
    if not state.entities or not _relative(to_builtins(goals)):
        return None
    things = {
        one.id: Spot(at=one.at, room=one.room, p_WO=one.p_WO, held=one.held, holder=one.holder)
        for one in state.entities
    }
    return Whereabouts(things=things, view=state.view, busy=is_busy(state))


def is_busy(state: RobotState) -> bool:
    """Whether something is done before what is asked for now."""
    return bool(state.doing or state.waiting)


def recalled(whereabouts: Whereabouts, knowledge: Knowledge) -> RobotState:
    """The state that they were taken from, as far as the meaning of goals depends on it."""
    entities = tuple(_put(entity, whereabouts) for entity in knowledge.entities())
    before = ("something else",) if whereabouts.busy else ()
    return RobotState(entities=entities, view=whereabouts.view, waiting=before)


def _put(entity: Entity, whereabouts: Whereabouts) -> Entity:
    spot = whereabouts.things.get(entity.id, Spot())
    return replace(
        entity, at=spot.at, room=spot.room, p_WO=spot.p_WO, held=spot.held, holder=spot.holder
    )


def _relative(plain: object) -> bool:
    """Whether a description in plain data is a relative one."""
    if isinstance(plain, dict):
        items = cast("dict[str, object]", plain).items()
        return any(key in RELATIVE or _relative(value) for key, value in items)
    return isinstance(plain, list) and any(map(_relative, cast("list[object]", plain)))
