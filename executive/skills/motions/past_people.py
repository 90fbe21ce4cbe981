"""Plans where people are in the way: furniture stays where it is, people do not.

Who walks by such a plan stops before them, asks them to step aside, and plans again.
"""

from __future__ import annotations

from typing import TypeVar

import msgspec

from executive.skills.motions.body_access import Body
from executive.skills.motions.obstructions import clearance_m
from executive.skills.motions.planning import ask
from executive.skills.motions.script import GaveUp, Script
from robot.failures import Failure
from robot.planning.requests import (
    BasePathRequest,
    LookPlan,
    LookRequest,
    PickRequest,
    PlaceRequest,
    Surroundings,
)

P = TypeVar("P")
R = TypeVar("R", bound=BasePathRequest | LookRequest | PickRequest | PlaceRequest)

CLOSED = ("no_path", "no_stance")
WORTH_ASKING = 0.6
"""Of what a view is worth, where people have to be asked to step aside first: that takes time."""
BESIDE_M = 0.1
"""What the sensors see as near as this to somebody is taken to be them."""


def ask_past_people(
    body: Body, request: BasePathRequest | PickRequest | PlaceRequest, plan: type[P]
) -> Script[P]:
    """A plan, where only people are in its way one as if they were not there.

    Gives up with the planner's own failure, in which they are.
    """
    try:
        return (yield from ask(body, request, plan))
    except GaveUp as end:
        closed = end
    if not _may_be_people(closed.failure, request.around):
        raise closed
    try:
        return (yield from ask(body, _without_people(request), plan))
    except GaveUp:
        raise closed from None


def ask_view_past_people(body: Body, request: LookRequest) -> Script[LookPlan]:
    """The best view; from behind people who close the way there if that shows so much more.

    What can only be seen from there is not cut off.
    """
    plan = yield from ask(body, request, LookPlan)
    if not (plan.cut_off and request.around.map.people):
        return plan
    past = yield from ask(body, _without_people(request), LookPlan)
    if past.stance is not None and past.worth_per_s * WORTH_ASKING > plan.worth_per_s:
        return past
    cut_off = tuple(point for point in plan.cut_off if point in past.cut_off)
    return msgspec.structs.replace(plan, cut_off=cut_off)


def _may_be_people(reason: Failure, around: Surroundings) -> bool:
    blockers = str(reason.evidence.get("blocked_by", "")).split(", ")
    closed = reason.code in CLOSED or not _of_people(around).isdisjoint(blockers)
    return closed and bool(around.map.people)


def _without_people(request: R) -> R:
    """The same request, but nobody is there, nor what the sensors see of them."""
    around = request.around
    ignored = (*around.ignored, *sorted(_of_people(around)))
    around = msgspec.structs.replace(around, ignored=ignored)
    return msgspec.structs.replace(request, around=around)


def _of_people(around: Surroundings) -> frozenset[str]:
    """The people, and what the sensors see of them, which may stand for them in a failure."""
    people = around.map.people
    seen = (
        thing.id
        for thing in around.unmapped
        if any(clearance_m(one.X_WO.p[:2], thing) < one.radius_m + BESIDE_M for one in people)
    )
    return frozenset((*(person.id for person in people), *seen))
