"""The last check before anything moves: are the numbers of a task within this robot's reach?"""

from __future__ import annotations

from executive.skills.catalogue import skill_of, unable
from executive.skills.parameters import SkillParams
from executive.trees.parts import Part, errands
from robot.failures import Failure
from robot.messages import WorldMap
from robot.model.description import RobotDescription


def check(part: Part, world_map: WorldMap, robot: RobotDescription) -> Failure | None:
    """The first thing in a task that this robot cannot do wherever things stand, or None."""
    for errand in errands(part):
        params = errand.params
        if isinstance(params, SkillParams):
            refusal = unable(params, robot)
            refusal = refusal or skill_of(params).refusal(params, world_map, robot)
            if refusal is not None:
                return refusal
    return None
