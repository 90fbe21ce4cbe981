"""Whether a description fits its body: what it says must be within reach of legs and arms.

For somebody who brings a robot: joints, names and postures are checked when it is loaded; this asks
what needs inverse kinematics.
"""

from __future__ import annotations

import mujoco
import numpy as np

from robot.model.description import RobotDescription
from robot.planning.requests import BodyPosture
from robot.planning.robot_body import UPRIGHT, Body
from robot.se3 import SE3

SOLE_M = 0.004
"""Soles that miss the floor by more do not stand."""
HAND_M = 0.01


def misfits(robot: RobotDescription) -> list[str]:
    """What does not fit, a sentence each; none if all does.

    Raises:
        DescriptionError: if the description does not even load.
    """
    body = Body(robot)
    return [*_stances(body), *_touches(body), *_hands(body)]


def _stances(body: Body) -> list[str]:
    """Heights and leans at which the legs do not reach the floor."""
    robot, balance = body.description, body.description.balance
    wanted = {
        "walking": UPRIGHT,
        "balance.lowest_base_m": BodyPosture(height_m=balance.lowest_base_m),
        "balance.highest_base_m": BodyPosture(height_m=balance.highest_base_m),
        "balance.squat_base_m": BodyPosture(height_m=balance.squat_base_m),
        "balance.lean_forward_rad": BodyPosture(pitch_rad=balance.lean_forward_rad),
        "balance.lean_back_rad": BodyPosture(pitch_rad=balance.lean_back_rad),
    }
    for k, lean in enumerate(robot.handling.reaching.leans if robot.handling else ()):
        wanted[f"reaching.leans[{k}]"] = BodyPosture(
            height_m=lean.base_height_m, pitch_rad=lean.pitch_rad, yaw_rad=lean.yaw_rad
        )
    off = {name: _off_floor_m(body, posture) for name, posture in wanted.items()}
    return [
        f"{name}: the soles miss the floor by {1000 * off_m:.0f} mm"
        for name, off_m in off.items()
        if off_m > SOLE_M
    ]


def _off_floor_m(body: Body, posture: BodyPosture) -> float:
    standing = body.standing(posture)
    data = body.model.data()
    body.model.write_base(data, standing.X_SB)
    body.model.write_joints(data, standing.q)
    mujoco.mj_kinematics(body.model.model, data)
    return max(abs(float(data.site_xpos[site][2])) for site in body.model.sole_site.values())


def _touches(body: Body) -> list[str]:
    """Postures in which the robot touches itself."""
    robot, found = body.description, list[str]()
    for name in robot.postures:
        scene = body.scene((), SE3(), np.array(robot.posture(name)), clearance_m=0.0)
        scene.update()
        every = np.ones(scene.model.ngeom, dtype=bool)
        pairs = {str(touch) for touch in scene.touches(every)}  # once a pair, not a contact
        found += [f"posture {name!r}: {pair}" for pair in sorted(pairs)]
    return found


def _hands(body: Body) -> list[str]:
    """Places for the hand that the arm does not reach, standing upright."""
    robot = body.description
    if robot.handling is None:
        return []
    wanted = {"reaching.raised_hand_m": robot.handling.reaching.raised_hand_m}
    for k, at in enumerate(robot.handling.giving.held_out_m):
        wanted[f"giving.held_out_m[{k}]"] = at
    found: list[str] = []
    for side in robot.hands:
        arm, X_ST = body.arms[side], body.standing(UPRIGHT).X_ST[side]
        sign = 1.0 if side == "left" else -1.0
        for name, (x, y, z) in wanted.items():
            X_TG = X_ST.inverse() @ SE3((x, sign * y, z))
            q = 0.5 * (arm.lower + arm.upper)
            for start in (body.nominal[arm.motors], q):
                solved = arm.chain.solve(
                    X_TG.rotation()[None], np.array([X_TG.p]), start[None], iterations=80
                )
                if solved.ok(position_m=HAND_M)[0]:
                    break
            else:
                short_m = float(solved.position_error_m[0])
                found.append(f"{name}: the {side} hand stays {100 * short_m:.0f} cm short")
    return found
