"""The last check before anything moves: are the numbers of a task within this robot's reach?"""

from __future__ import annotations

from executive.skills.catalogue import skill_of, unable
from executive.skills.parameters import SkillParams
from executive.trees.parts import Each, Errand, Part, Settle, children
from robot.failures import Failure
from robot.messages import WorldMap
from robot.model.description import RobotDescription


def check(part: Part, world_map: WorldMap, robot: RobotDescription) -> Failure | None:
    """The first thing in a task that this robot cannot do wherever things stand, or None.

    Of several things one that can be done is enough to begin; and what is meant only once it was
    looked at is not judged before.
    """
    match part:
        case Errand(params=SkillParams() as params):
            refusal = unable(params, robot)
            return refusal or skill_of(params).refusal(params, world_map, robot)
        case Settle(looks=parts):
            found = [check(child, world_map, robot) for child in parts]
        case Each(parts=parts):
            found = [check(child, world_map, robot) for child in parts]
            found = found[:1] if all(found) else []
        case _:
            found = [check(child, world_map, robot) for _, child in children(part)]
    return next((refusal for refusal in found if refusal is not None), None)
