"""What the robot knows of itself and its world, read off the blackboard in this one place.

What it holds, what it sees, where it is: conversations, reports inside a task and missions all ask
here, and `intents.replies` puts it into words.
"""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import replace

from executive.blackboard import (
    GIVEN,
    GOAL,
    HEALTH,
    HELD,
    PHASE,
    TAKEN_FROM,
    WORLD,
    Blackboard,
)
from executive.meaning.knowledge import Knowledge
from intents.grounding import Entity
from intents.relations import Viewpoint
from intents.state import RobotState
from robot.messages import Place, WorldState
from robot.se3 import SE3, Vector3

IN_VIEW_S = 0.5
"""What was seen that recently is in view: a few frames of the camera."""


def state_of(
    board: Blackboard, knowledge: Knowledge, *, skills: frozenset[str] = frozenset()
) -> RobotState:
    """A snapshot.

    Args:
        board: of the executive.
        knowledge: of the world.
        skills: the types of goals that there are handlers for; empty means all.
    """
    world = board.read(WORLD)
    held = {id_: side for side, id_ in board.read(HELD).items()}
    state = RobotState(
        entities=tuple(
            _entities(knowledge, world, held, board.read(GIVEN), taken_from=board.read(TAKEN_FROM))
        ),
        doing=board.read(GOAL),
        step="" if board.read(PHASE) == "done" else board.read(PHASE),
        problems=tuple(finding.failure.cause for finding in board.read(HEALTH).findings),
        skills=skills,
    )
    return _placed(state, world, knowledge) if world is not None else state


def _placed(state: RobotState, world: WorldState, knowledge: Knowledge) -> RobotState:
    """The state with where the robot is and what it sees."""
    x, y, _ = world.X_WB.p
    seen = (track for track in world.tracks if world.stamp_s - track.seen_s <= IN_VIEW_S)
    return replace(
        state,
        view=Viewpoint(x_m=x, y_m=y, yaw_rad=world.X_WB.yaw_rad),
        room=knowledge.room_at(world.X_WB.p),
        spots=tuple((place.name, *place.X_WP.p[:2]) for place in knowledge.map.places),
        operator=_whereabouts_of_operator(world, knowledge),
        seen=tuple(track.id for track in seen if not track.missing),
    )


def _whereabouts_of_operator(world: WorldState, knowledge: Knowledge) -> str:
    person = knowledge.person(None)
    tracks = {track.id: track for track in world.people}
    track = tracks.get(person.id) if person is not None else None
    if track is None or track.X_WO is None or track.missing:
        return ""
    x, y, _ = track.X_WO.p
    room = knowledge.room_at(track.X_WO.p)
    return f"{f'in the {room} ' if room else ''}at x {x:.1f} m, y {y:.1f} m"


def _entities(
    knowledge: Knowledge,
    world: WorldState | None,
    held: Mapping[str, str],
    given: Mapping[str, str],
    *,
    taken_from: Mapping[str, SE3],
) -> list[Entity]:
    """Every object of the map, with where it is believed to be."""
    tracks = {track.id: track for track in world.tracks} if world else {}
    found: list[Entity] = []
    for info in knowledge.map.objects:
        entity, track = knowledge.entity(info), tracks.get(info.id)
        origin = taken_from.get(info.id)
        stood_on = knowledge.surface_under(origin) if origin is not None else None
        if stood_on is not None:
            entity = replace(entity, came_from=stood_on.name)
        holder = knowledge.person(given[info.id]) if info.id in given else None
        if info.id in held:
            entity = replace(entity, held=True, hand=held[info.id])
        elif holder is not None:
            entity = replace(entity, holder=holder.name)
        elif track is not None and track.X_WO is not None and not track.missing:
            at = knowledge.surface_under(track.X_WO)
            entity = _standing(entity, at, track.X_WO.p, knowledge)
        found.append(entity)
    return found


def _standing(entity: Entity, at: Place | None, p_WO: Vector3, knowledge: Knowledge) -> Entity:
    return replace(
        entity,
        at=at.name if at else "",
        of=at.of.replace("_", " ") if at else "",
        room=knowledge.room_at(p_WO),
        p_WO=p_WO,
    )
