"""A grasp with which a thing can also be put down where it is to go.

A hand that came from above cannot put things on a board higher than the shoulder, or only with the
arm over its edge: how a thing is taken depends on what is wanted of it.
"""

from __future__ import annotations

import msgspec

from executive.skills.motions.body_access import Body
from executive.skills.motions.past_people import ask_past_people
from executive.skills.motions.script import GaveUp, Script
from robot.messages import Place
from robot.planning.requests import Held, PickPlan, PickRequest, PlacePlan, PlaceRequest

LEVEL_RAD = 0.25
"""With a hand as level as this things are put wherever an arm gets; it is not asked."""
UNFIT = ("goal_in_collision", "out_of_reach", "planner_timeout")
"""Why a thing cannot be put there with this grasp, and may with another."""


def ask_fitting(body: Body, request: PickRequest, place: Place | None) -> Script[PickPlan]:
    """How to take a thing, the hand as level as it takes to put it on `place` (None: no matter).

    As if there were no such place where no grasp will do, or the thing is not reached with those
    that would: the thing can be taken at least.
    """
    first = plan = yield from ask_past_people(body, request, PickPlan)
    while place is not None and plan.tilt_rad > LEVEL_RAD:
        if (yield from _can_put(body, request, plan, place)):
            return plan
        leveller = msgspec.structs.replace(request, most_tilt_rad=0.5 * plan.tilt_rad)
        try:
            plan = yield from ask_past_people(body, leveller, PickPlan)
        except GaveUp:
            return first
    return plan


def _can_put(body: Body, request: PickRequest, plan: PickPlan, place: Place) -> Script[bool]:
    """Whether what is held so can be put on a place with ease, as far as the grasp matters."""
    ignored = (*request.around.ignored, request.object_id)
    put = PlaceRequest(
        place=place,
        side=plan.side,
        held=Held(
            id=request.object_id,
            shape=body.object_info(request.object_id).shape,
            X_GO=plan.X_OG.inverse(),
        ),
        around=msgspec.structs.replace(request.around, ignored=ignored),
        start=plan.standoff,
        seed=request.seed,
    )
    try:
        placing = yield from ask_past_people(body, put, PlacePlan)
    except GaveUp as end:
        return end.failure.code not in UNFIT
    return placing.over is None
