"""How the body comes to rest, whatever it was doing: the last act of every skill that moved it."""

from __future__ import annotations

from executive.skills.body import ARM_CHANNEL, Body
from executive.skills.script import Script
from executive.skills.skill import Resource
from robot.messages import MoveHand, Side, Stand

REST_TIMEOUT_S = 6.0


def come_to_rest(body: Body, resources: frozenset[Resource]) -> Script[None]:
    """Hold the arms where they are, finish the step and stand; ends when the body stands still.

    Fingers keep their grip. Ends after `REST_TIMEOUT_S` in any case.
    """
    body.phase = "coming to rest"
    for side, channel in ARM_CHANNEL.items():
        if channel in resources:
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
    activity = body.state.activities.get(ARM_CHANNEL[side])
    if activity is not None and activity.status == "running":
        body.send(MoveHand(**body.header(), side=side, X_NG=body.hand(side).X_NG))
