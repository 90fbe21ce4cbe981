"""Getting up from the floor."""

from __future__ import annotations

from executive.skills.body import Body
from executive.skills.gripping import open_fingers
from executive.skills.script import Script, give_up
from robot.messages import GetUp, Side

RISE_LIMIT_S = 120.0
GOING_DOWN_S = 3.0


def get_up(body: Body) -> Script[None]:
    """Get up and stand; does nothing for a robot that does not lie.

    What the hands held counts as lost: they let go of it before the next step looks for it.
    Gives up with `fallen`.
    """
    down_s = body.now_s + GOING_DOWN_S
    while body.state_down.mode == "damping" and body.now_s < down_s:
        yield
    if body.state_down.mode != "fallen":
        return
    body.phase = "getting up"
    holdings = body.context.holdings
    held: list[Side] = [hold.side for hold in holdings.all()]
    for side in held:
        holdings.release(side)
    command = GetUp(**body.header())
    body.send(command)
    end_s = body.now_s + RISE_LIMIT_S
    while True:
        yield
        activity = body.state_down.activities.get("legs")
        answer = activity if activity is not None and activity.id >= command.id else None
        if answer is not None and answer.status == "failed":
            raise give_up("fallen", f"the robot did not get up: {answer.detail}")
        if answer is not None and answer.status == "done":
            break
        if body.now_s > end_s:
            raise give_up("fallen", "the robot did not get up in time")
    for side in held:
        yield from open_fingers(body, side)
