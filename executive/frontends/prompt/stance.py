"""What is true of a robot that has nothing to do: it stands, or it lies there."""

from __future__ import annotations

from executive.blackboard import BODY
from executive.engine.executive import Executive
from executive.frontends.prompt.view import View

_MODES = {
    "stand": "I stand already.",
    "fallen": "I lie on the floor; nothing moves. Say “get up” to have me try.",
    "damping": "My motors are damped: nothing holds me up or moves.",
    "gone": "I am gone: nothing moves any more.",
    "unknown": "I am not moving.",
}


def standing(executive: Executive, view: View) -> str:
    """What the robot says that is told to stop and has nothing to stop.

    Args:
        executive: of the robot, which knows the newest of its body.
        view: what was seen last, which also knows of a robot that is gone.
    """
    body = executive.board.read(BODY)
    if view.mode == "gone":
        mode = "gone"
    else:
        mode = body.mode if body is not None else "unknown"
    if mode == "stand" and view.low:
        return "I am down in a squat, and nothing moves."
    told = _MODES.get(mode, "I am coming to a stand.")
    return f"{told} The emergency stop is on." if executive.estop.latched else told
