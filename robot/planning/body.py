"""The robot as planners know it: chains of its arms, how it stands, what it touches."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import mujoco
import numpy as np

from robot.errors import DescriptionError
from robot.messages import Side
from robot.model.body import SIDES, BodyModel
from robot.model.description import RobotDescription
from robot.planning.ik import Chain
from robot.planning.requests import BodyPosture, Stance
from robot.planning.scene import Scene, SceneCache, Touch
from robot.planning.solids import Solid
from robot.se3 import SE3, Array

UPRIGHT = BodyPosture()
BODY_CLEARANCE_M = 0.0
"""Of legs and trunk where the robot is or wants to be; paths and stances ask for more [m]."""


@dataclass(frozen=True, slots=True)
class Standing:
    """How the robot stands in a posture: base and shoulders in S, all motors."""

    X_SB: SE3
    q: Array
    X_ST: dict[Side, SE3]


class Arm:
    """One arm as a chain from its root T (the trunk's last link) to the grasp point.

    Attributes:
        chain: the hinges, in its group's order.
        motors: their motor indices, shape (k,).
        lower, upper: limits [rad], shape (k,).
    """

    def __init__(self, body: BodyModel, side: Side) -> None:
        """Find the joints between trunk and hand.

        Raises:
            DescriptionError: if the group does not list exactly these joints, outwards.
        """
        description, model = body.description, body.model
        names = description.groups[f"{side}_arm"]
        first = model.jnt_bodyid[body.joint_id(description.motors[names[0]].joint)]
        root = model.body(int(model.body_parentid[first])).name
        self.side: Side = side
        self.chain = Chain(model, root, description.hands[side].grasp_site)
        joints = tuple(description.motors[name].joint for name in names)
        if joints != self.chain.joints:
            raise DescriptionError(
                f"group '{side}_arm' lists {', '.join(joints)}; the MJCF has "
                f"{', '.join(self.chain.joints)} from {root} to the grasp site"
            )
        self.motors = np.array(description.indices(f"{side}_arm"))
        self.lower, self.upper = self.chain.lower, self.chain.upper


class Body:
    """What all planners share; not for two threads at once."""

    def __init__(self, description: RobotDescription) -> None:
        """Compile the robot."""
        self.description = description
        self.model = BodyModel(description)
        self.arms: dict[Side, Arm] = {side: Arm(self.model, side) for side in SIDES}
        self.scenes = SceneCache(description)
        self.nominal = np.array(description.posture("nominal"))
        self.standing = lru_cache(maxsize=64)(self._standing)

    def motor(self, name: str) -> int:
        """Index of a motor."""
        return self.description.motor_names.index(name)

    def scene(
        self, solids: tuple[Solid, ...], X_WB: SE3, q_rad: Array, *, clearance_m: float
    ) -> Scene:
        """A scene with nothing held, posed."""
        scene = self.scenes.get(solids)
        scene.pose(X_WB, q_rad)
        scene.set_clearance(clearance_m)
        return scene

    def trunk_touch(
        self, solids: tuple[Solid, ...], stance: Stance, *, clearance_m: float = BODY_CLEARANCE_M
    ) -> Touch | None:
        """What legs, trunk or head touch most deeply when standing upright there, if anything."""
        standing = self.standing(UPRIGHT)
        X_WB = SE3.from_xy_yaw(*stance) @ standing.X_SB
        scene = self.scene(solids, X_WB, standing.q, clearance_m=clearance_m)
        scene.update()
        touches = scene.touches(scene.trunk_geoms, solids_only=True)
        return min(touches, key=lambda touch: touch.distance_m, default=None)

    def _standing(self, posture: BodyPosture) -> Standing:
        """Where everything is when standing so: soles flat, pelvis level, CoM over their midpoint.

        Leaning moves the pelvis back; the legs follow by inverse kinematics.
        """
        description, body = self.description, self.model
        walking = description.walking
        height = posture.height_m or walking.base_height_m
        q = self.nominal.copy()
        for motor in description.indices("waist"):
            name = description.motor_names[motor]
            if name.endswith("yaw"):
                q[motor] = posture.yaw_rad
            elif name.endswith("pitch"):
                q[motor] = posture.pitch_rad
        data = body.data()
        legs = {
            side: Chain(body.model, description.base_body, description.feet[side].sole_site)
            for side in SIDES
        }
        names = [motor.joint for motor in description.motors.values()]
        forward = 0.0
        for _ in range(8):
            for side, sign in (("left", 1.0), ("right", -1.0)):
                sole = np.array([[-forward, sign * 0.5 * walking.stance_width_m, -height]])
                leg = np.array([names.index(name) for name in legs[side].joints])
                q[leg] = legs[side].solve(np.eye(3)[None], sole, q[leg][None], iterations=60).q[0]
            body.write_base(data, SE3((forward, 0.0, height)))
            body.write_joints(data, q)
            mujoco.mj_kinematics(body.model, data)
            mujoco.mj_comPos(body.model, data)
            off = float(data.subtree_com[body.base_body][0])
            if abs(off) < 1e-4:
                break
            forward -= off
        roots = {side: body.body_id(arm.chain.body) for side, arm in self.arms.items()}
        trunks = {
            side: SE3.from_rotation(data.xmat[root].reshape(3, 3), data.xpos[root])
            for side, root in roots.items()
        }
        return Standing(SE3((forward, 0.0, height)), q, trunks)
