"""Where every body of a scene is, moment by moment: poses by the kinematics of the scene alone."""

from __future__ import annotations

import math

from robot.reality.visual_scene import Flat, Joint, VisualBody, VisualScene
from robot.se3 import SE3


def pose_of(flat: Flat) -> SE3:
    """A pose from its seven numbers; where the last four are no turn, nothing is turned."""
    x, y, z, *quaternion = flat
    norm = math.hypot(*quaternion)
    if not 0.0 < norm < math.inf:
        return SE3((x, y, z))
    qw, qx, qy, qz = (one / norm for one in quaternion)
    return SE3((x, y, z), (qw, qx, qy, qz))


def moved(joint: Joint, q: tuple[float, ...]) -> SE3:
    """How a joint moves its body from where it is at 0, in the body's own frame.

    Args:
        joint: of the body.
        q: positions of the motors [rad], of fingers [m].
    """
    value = joint.gain * q[joint.motor] if 0 <= joint.motor < len(q) else 0.0
    x, y, z = joint.axis
    if joint.kind == "slide":
        return SE3((x * value, y * value, z * value))
    sine = math.sin(value / 2.0)
    turn = SE3(quat_wxyz=(math.cos(value / 2.0), x * sine, y * sine, z * sine))
    px, py, pz = joint.at_m
    return SE3(joint.at_m) @ turn @ SE3((-px, -py, -pz))


def in_parent(body: VisualBody, q: tuple[float, ...]) -> SE3:
    """X_PB of one of the robot's bodies, other than its base."""
    found = pose_of(body.X_PB)
    for joint in body.joints:
        found = found @ moved(joint, q)
    return found


def moves(body: VisualBody) -> bool:
    """Whether any motor moves it in its parent."""
    return any(joint.motor >= 0 for joint in body.joints)


def links(scene: VisualScene) -> list[VisualBody]:
    """The robot's bodies but its base."""
    return [
        body
        for place, body in enumerate(scene.bodies)
        if body.role == "robot" and place != scene.base
    ]
