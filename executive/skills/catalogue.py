"""Every skill there is: from parameters to the skill that carries them out."""

from __future__ import annotations

from executive.skills.ability import Refused, unable
from executive.skills.balance import Balance
from executive.skills.context import SkillContext
from executive.skills.follow import Follow
from executive.skills.gesture import Gesture
from executive.skills.give import Give
from executive.skills.look import Look
from executive.skills.navigate import Navigate
from executive.skills.parameters import (
    BalanceParams,
    FollowParams,
    GestureParams,
    GiveParams,
    LookParams,
    NavigateParams,
    PickParams,
    PlaceParams,
    SayParams,
    SearchParams,
    SkillParams,
    StopParams,
    WaitParams,
)
from executive.skills.pick import Pick
from executive.skills.place import PutDown
from executive.skills.say import Say
from executive.skills.search import Search
from executive.skills.skill import Skill
from executive.skills.stop import Stop
from executive.skills.wait import Wait


def make(parameters: SkillParams, context: SkillContext) -> Skill:
    """The skill for these parameters; made for one goal, used once.

    What the body cannot do whatever the world is like is refused at once.
    """
    refusal = unable(parameters, context.description)
    if refusal is not None:
        return Refused(refusal)
    return _make(parameters, context)


def _make(parameters: SkillParams, context: SkillContext) -> Skill:
    match parameters:
        case NavigateParams():
            return Navigate(parameters, context)
        case PickParams():
            return Pick(parameters, context)
        case PlaceParams():
            return PutDown(parameters, context)
        case LookParams():
            return Look(parameters, context)
        case SearchParams():
            return Search(parameters, context)
        case BalanceParams():
            return Balance(parameters, context)
        case GiveParams():
            return Give(parameters, context)
        case FollowParams():
            return Follow(parameters, context)
        case GestureParams():
            return Gesture(parameters, context)
        case SayParams():
            return Say(parameters, context)
        case WaitParams():
            return Wait(parameters, context)
        case StopParams():
            return Stop(parameters, context)
