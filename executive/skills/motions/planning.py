"""Asking the planner and waiting for its answer."""

from __future__ import annotations

from typing import TypeVar

from executive.skills.motions.body_access import Body
from executive.skills.motions.script import GaveUp, Script, give_up
from robot.failures import Failure
from robot.messages import Side
from robot.planning import requests
from robot.planning.requests import PlanRequest, Stance
from robot.se3 import SE3

ANSWER_TIMEOUT_S = 30.0

P = TypeVar("P")


def ask(body: Body, request: PlanRequest, plan: type[P]) -> Script[P]:
    """Submit a request and wait for the plan; gives up with the planner's own failure."""
    planner = body.context.planner
    ticket = planner.submit(request, now_s=body.now_s)
    end_s = body.now_s + ANSWER_TIMEOUT_S
    try:
        while True:
            answer = planner.poll(ticket, now_s=body.now_s)
            if isinstance(answer, Failure):
                raise GaveUp(answer)
            if isinstance(answer, plan):
                return answer
            if answer is not None:
                raise TypeError(f"asked for a {plan.__name__}, got a {type(answer).__name__}")
            if body.now_s > end_s:
                raise give_up("planner_timeout", f"no plan while {body.phase}")
            yield
    finally:
        planner.cancel(ticket)


def held_in(body: Body, side: Side) -> requests.Held | None:
    """What a hand carries, as the planner wants to know it."""
    held = body.context.holdings.at(side)
    if held is None:
        return None
    shape = body.object_info(held.object_id).shape
    return requests.Held(id=held.object_id, shape=shape, X_GO=held.X_GO)


def stance_of(X_WS: SE3) -> Stance:
    """A pose on the floor as the planner writes it."""
    return (X_WS.p[0], X_WS.p[1], X_WS.yaw_rad)


def pose_of(stance: Stance) -> SE3:
    """A planner's stance as a pose X_WS."""
    return SE3.from_xy_yaw(*stance)
