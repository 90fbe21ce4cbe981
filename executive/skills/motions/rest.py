"""How the body comes to rest, whatever it was doing: the last act of every skill that moved it."""

from __future__ import annotations

from executive.skills.motions.body_access import ARM_CHANNEL, SIDES, Body
from executive.skills.motions.script import Script
from executive.skills.skill import Resource
from robot.messages import HoldArm, Side, Stand

REST_TIMEOUT_S = 6.0


def come_to_rest(body: Body, resources: frozenset[Resource]) -> Script[None]:
    """Hold the arms where they are, finish the step and stand; ends when the body is still.

    Fingers keep their grip. Ends after `REST_TIMEOUT_S` in any case.
    """
    body.phase = "coming to rest"
    sides: list[Side] = [side for side in SIDES if ARM_CHANNEL[side] in resources]
    for side in sides:
        hold_arm(body, side)
    stand = body.send(Stand(**body.header())) if "legs" in resources else None
    end_s = body.now_s + REST_TIMEOUT_S
    while body.now_s < end_s:
        yield
        if (stand is None or _stands(body, stand)) and all(_is_still(body, s) for s in sides):
            return


def _stands(body: Body, command_id: int) -> bool:
    """Whether the body has taken the posture it was told to, or cannot any more."""
    state = body.state
    if state.mode == "damping":
        return True
    activity = state.activities.get("legs")
    # A posture that is still being taken, or an older command's, is no rest yet.
    taken = activity is not None and activity.id >= command_id and activity.status != "running"
    return taken and state.mode == "stand"


def _is_still(body: Body, side: Side) -> bool:
    """Whether an arm's joints hardly move."""
    speeds_rad_s = (body.state.qd_rad_s[i] for i in body.description.indices(f"{side}_arm"))
    return max(map(abs, speeds_rad_s)) < body.description.arms.still_rad_s


def hold_arm(body: Body, side: Side) -> None:
    """Brake one arm, if it is under way."""
    activity = body.state.activities.get(ARM_CHANNEL[side])
    if activity is not None and activity.status == "running":
        body.send(HoldArm(**body.header(), side=side))
