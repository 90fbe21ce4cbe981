"""Which parts of the body a step needs: what decides on what can be done side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from executive.skills import parameters as p
from executive.skills.balance import Balance
from executive.skills.follow import Follow
from executive.skills.gesture import HEAD_ONLY
from executive.skills.give import Give
from executive.skills.look import Look
from executive.skills.navigate import Navigate
from executive.skills.pick import Pick
from executive.skills.place import PutDown
from executive.skills.say import Say
from executive.skills.search import Search
from executive.skills.skill import Resource
from executive.skills.stop import Stop
from executive.skills.wait import Wait

NEEDS: dict[type[p.Parameters], frozenset[Resource]] = {
    p.NavigateParams: Navigate.resources,
    p.PickParams: Pick.resources,
    p.PlaceParams: PutDown.resources,
    p.LookParams: Look.resources,
    p.SearchParams: Search.resources,
    p.BalanceParams: Balance.resources,
    p.GiveParams: Give.resources,
    p.FollowParams: Follow.resources,
    p.GestureParams: frozenset({"legs", "left_arm", "right_arm", "head"}),
    p.SayParams: Say.resources,
    p.WaitParams: Wait.resources,
    p.StopParams: Stop.resources,
}
"""The resource table: parameters of a skill to the parts of the body that it takes at most."""

SPOKEN: frozenset[Resource] = frozenset({"voice"})


def needed(params: p.SkillParams | Callable[..., Any]) -> frozenset[Resource]:
    """What one step takes. Parameters made from the blackboard are those of speech."""
    if isinstance(params, p.GestureParams) and params.kind in HEAD_ONLY:
        return frozenset({"head"})
    return SPOKEN if callable(params) else NEEDS[type(params)]


def needed_by(steps: Iterable[p.SkillParams | Callable[..., Any]]) -> frozenset[Resource]:
    """What several steps take, all together."""
    return frozenset[Resource]().union(*(needed(params) for params in steps))


def conflicts(branches: Iterable[frozenset[Resource]]) -> frozenset[Resource]:
    """The parts of the body that more than one of the branches of a `parallel` wants."""
    seen: set[Resource] = set()
    twice: set[Resource] = set()
    for wanted in branches:
        twice |= wanted & seen
        seen |= wanted
    return frozenset(twice)
