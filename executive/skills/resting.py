"""How the body comes to rest, whatever it was doing: the last act of every skill that moved it."""

from __future__ import annotations

from executive.skills.body import Body
from executive.skills.script import Script
from executive.skills.skill import Resource
from robot.messages import MoveHand, Side, Stand

REST_TIMEOUT_S = 6.0


def come_to_rest(body: Body, resources: frozenset[Resource]) -> Script[None]:
    """Hold the arms where they are, finish the step and stand; ends when the body stands still.

    Fingers keep their grip. Ends after `REST_TIMEOUT_S` in any case.
    """
    body.phase = "coming to rest"
    for side, resource in _ARMS:
        if resource in resources:
            hold_arm(body, side)
    if "legs" in resources:
        body.send(Stand(**body.header()))
    end_s = body.now_s + REST_TIMEOUT_S
    while body.now_s < end_s:
        yield
        if "legs" not in resources or body.state.mode in ("stand", "damping"):
            return


def hold_arm(body: Body, side: Side) -> None:
    """Brake one arm where its hand is, if it is under way."""
    activity = body.state.activities.get(f"{side}_arm")
    if activity is not None and activity.status == "running":
        body.send(MoveHand(**body.header(), side=side, X_NG=body.hand(side).X_NG))


_ARMS:
        if resource in resources:
            hold_arm(body, side)
    if "legs" in resources:
        body.send(Stand(**body.header()))
    end_s = body.now_s + REST_TIMEOUT_S
    while body.now_s < end_s:
        yield
        if "legs" not in resources or body.state.mode in ("stand", "damping"):
            return


def hold_arm(body: Body, side: Side) -> None:
    """Brake one arm to where it will be in a moment, if it is under way."""
    state = body.state
    activity = state.activities.get(f"{side}_arm")
    if activity is None or activity.status != "running":
        return
    stop_rad = tuple(
        state.q_rad[i] + 0.5 * ARM_STOP_S * state.qd_rad_s[i]
        for i in body.description.indices(f"{side}_arm")
    )
    body.send(
        MoveArm(**body.header(), side=side, times_s=(ARM_STOP_S,), positions_rad=(stop_rad,))
    )


_ARMS: tuple[tuple[Side, Resource], ...] = (("left", "left_arm"), ("right", "right_arm"))
