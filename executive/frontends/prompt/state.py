"""What the robot knows of itself, in the form that a conversation is held with."""

from __future__ import annotations

from msgspec.structs import replace

from executive.blackboard import HEALTH, HELD, PHASE, WORLD
from executive.engine.executive import Executive
from executive.engine.jobs import OVER, UNDER_WAY, Job
from executive.journal import failures
from executive.meaning.knowledge import Knowledge
from executive.meaning.tasks import HANDLERS
from intents.grounding import Entity
from intents.relations import Viewpoint
from intents.state import RobotState
from robot.link import BodyLink
from robot.messages import Place, WorldState
from robot.se3 import Vector3

SKILLS: frozenset[str] = frozenset(kind.__struct_config__.tag for kind in HANDLERS)
"""The types of goals that there are handlers for."""
IN_VIEW_S = 0.5


def robot_state(executive: Executive, link: BodyLink, knowledge: Knowledge) -> RobotState:
    """A snapshot for one turn of a conversation."""
    board = executive.board
    world, findings = board.read(WORLD), board.read(HEALTH).findings
    held = frozenset(board.read(HELD).values())
    jobs = executive.jobs
    under_way = [job for job in jobs if job.state in UNDER_WAY]
    over = [job for job in jobs if job.state in OVER]
    power = link.power()
    state = RobotState(
        entities=tuple(_entities(knowledge, world, held)),
        doing=under_way[0].text if under_way else "",
        step=board.read(PHASE) if under_way else "",
        waiting=tuple(job.text for job in jobs if job.state == "waiting"),
        mode={"pausing": "paused", "stopping": "stopped"}.get(executive.state, executive.state),
        problems=tuple(finding.failure.cause for finding in findings),
        battery=power.charge if power else None,
        last=_ending(over[-1]) if over else "",
        skills=SKILLS,
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
        seen=tuple(track.id for track in seen if not track.missing),
    )


def _entities(knowledge: Knowledge, world: WorldState | None, held: frozenset[str]) -> list[Entity]:
    """Every object of the map, with where it is believed to be."""
    tracks = {track.id: track for track in world.tracks} if world else {}
    found: list[Entity] = []
    for info in knowledge.map.objects:
        entity, track = knowledge.entity(info), tracks.get(info.id)
        if info.id in held:
            entity = replace(entity, held=True)
        elif track is not None and track.X_WO is not None and not track.missing:
            at = knowledge.surface_under(track.X_WO)
            entity = _standing(entity, at, track.X_WO.p, knowledge)
        found.append(entity)
    return found


def _standing(entity: Entity, at: Place | None, p_WO: Vector3, knowledge: Knowledge) -> Entity:
    return replace(entity, at=at.name if at else "", room=knowledge.room_at(p_WO), p_WO=p_WO)


def _ending(job: Job) -> str:
    """How a job ended, in the robot's words."""
    if job.failure is None:
        return f"I have done “{job.text}”."
    stopped = job.state == "cancelled"
    return failures.in_first_person(f"“{job.text}”", job.failure.cause, stopped=stopped)
