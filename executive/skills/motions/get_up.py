"""Getting up from the floor."""

from __future__ import annotations

from executive.skills.motions.body_access import Body
from executive.skills.motions.fingers import open_fingers
from executive.skills.motions.script import GaveUp, Script, give_up
from robot.messages import BodyState, GetUp, Side

RISE_LIMIT_S = 120.0  # of 26 falls the slowest took 26 s; one motion after another may be missed
GOING_DOWN_S = 3.0  # of a robot whose motors gave up: it counts as fallen once it lies


def get_up(body: Body) -> Script[None]:
    """Get up and stand; does nothing for a robot that does not lie.

    What the hands held counts as lost: they let go of it before the next step looks for it.
    Gives up with `fallen`, or with `controller_lost` if the next controller found it on its feet.
    """
    down_s = body.now_s + GOING_DOWN_S
    while body.state_down.mode == "damping" and body.now_s < down_s:
        yield
    state = body.state_down
    if state.mode != "fallen":
        return
    body.replaced(state)
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
        state = body.state_down
        if body.replaced(state):
            raise _left_alone(state)
        activity = state.activities.get("legs")
        answer = activity if activity is not None and activity.id >= command.id else None
        if answer is not None and answer.status == "failed":
            raise give_up("fallen", f"the robot did not get up: {answer.detail}")
        if answer is not None and answer.status == "done":
            break
        if body.now_s > end_s:
            raise give_up("fallen", "the robot did not get up in time")
    for side in held:
        yield from open_fingers(body, side)


def _left_alone(state: BodyState) -> GaveUp:
    """The controller that was getting up is dead, and the next one knows nothing of it."""
    cause = "the controller died while the robot was getting up"
    if state.mode == "stand":
        return give_up("controller_lost", cause)
    return give_up("fallen", f"{cause}; it lies again")
