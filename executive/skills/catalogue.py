"""Every skill there is: one row each, from parameters to the skill that carries them out."""

from __future__ import annotations

from typing import Any

from executive.skills.ability import Refused
from executive.skills.ask import Ask
from executive.skills.balance import Balance
from executive.skills.context import SkillContext
from executive.skills.follow import Follow
from executive.skills.gesture import Gesture
from executive.skills.give import Give
from executive.skills.inspect import Inspect
from executive.skills.look import Look
from executive.skills.navigate import Navigate
from executive.skills.parameters import SkillParams
from executive.skills.pick import Pick
from executive.skills.place import PutDown
from executive.skills.say import Say
from executive.skills.scripted import P, ScriptedSkill
from executive.skills.search import Search
from executive.skills.skill import Skill
from executive.skills.stop import Stop
from executive.skills.wait import Wait
from robot.failures import Failure, failure
from robot.model.description import RobotDescription

SKILLS: tuple[type[ScriptedSkill[Any]], ...] = (
    Navigate,
    Search,
    Inspect,
    Pick,
    PutDown,
    Give,
    Follow,
    Gesture,
    Look,
    Balance,
    Say,
    Ask,
    Wait,
    Stop,
)
"""The catalogue, in the order in which people read it."""

_TAKING: dict[type[SkillParams], type[ScriptedSkill[Any]]] = {
    skill.takes: skill for skill in SKILLS
}


def skill_of(parameters: P) -> type[ScriptedSkill[P]]:
    """The skill that takes these parameters."""
    return _TAKING[type(parameters)]


def make(parameters: SkillParams, context: SkillContext) -> Skill:
    """The skill for these parameters; made for one goal, used once.

    What the body cannot do whatever the world is like is refused at once.
    """
    refusal = unable(parameters, context.description)
    if refusal is not None:
        return Refused(refusal)
    return skill_of(parameters)(parameters, context)


def unable(parameters: SkillParams, robot: RobotDescription) -> Failure | None:
    """Why a robot has no body for this, or None."""
    lack = skill_of(parameters).lack(parameters, robot)
    return failure("unsupported", f"{robot.name} {lack}", robot=robot.name) if lack else None
