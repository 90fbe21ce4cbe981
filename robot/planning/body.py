"""The robot as planners know it: chains of its arms, how it stands, what it touches."""

from __future__ import annotations

from functools import lru_cache

import mujoco
import numpy as np

from robot.messages import Side
from robot.model.body import SIDES, BodyModel
from robot.model.description import RobotDescription
from robot.planning.ik import Chain
from robot.planning.requests import BodyPosture, Joints, Stance
from robot.planning.scene import Scene, SceneCache, Touch
from robot.planning.solids import Solid
from robot.se3 import SE3, Array

UPRIGHT = BodyPosture()
BODY_CLEARANCE_M = 0.0
"""Of legs and trunk where the robot is or wants to be; paths and stances ask for more [m]."""


class Arm:
    """One arm as a chain from the base to the grasp point, waist included.

    Attributes:
        chain: the hinges, waist first.
        motors: motor index of every joint of the chain, shape (k,).
        free: positions in the chain of the arm's own joints, in its group's order.
        lower, upper: limits of the arm's own joints [rad].
    """

    def __init__(self, body: BodyModel, side: Side) -> None:
        """Find the joints between base and hand."""
        description = body.description
        site = description.hands[side].grasp_site
        self.side: Side = side
        self.chain = Chain(body.model, description.base_body, site)
        joints = [motor.joint for motor in description.motors.values()]
        self.motors = np.array([joints.index(name) for name in self.chain.joints])
        arm = description.indices(f"{side}_arm")
        chain = self.motors.tolist()
        self.free = [chain.index(motor) for motor in arm]
        self.arm_motors = np.array(arm)
        self.lower, self.upper = self.chain.lower[self.free], self.chain.upper[self.free]

    def joints(self, q_chain: Array) -> Joints:
        """The arm's own joints out of one chain vector, in its group's order."""
        return tuple(float(value) for value in q_chain[self.free])


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
        X_SB, q = self.standing(UPRIGHT)
        scene = self.scene(solids, SE3.from_xy_yaw(*stance) @ X_SB, q, clearance_m=clearance_m)
        scene.update()
        touches = scene.touches(scene.trunk_geoms, solids_only=True)
        return min(touches, key=lambda touch: touch.distance_m, default=None)

    def _standing(self, posture: BodyPosture) -> tuple[SE3, Array]:
        """X_SB and all motors when standing so: soles flat, pelvis level, CoM over their midpoint.

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
        for _ in range(4):
            for side, sign in (("left", 1.0), ("right", -1.0)):
                sole = np.array([[-forward, sign * 0.5 * walking.stance_width_m, -height]])
                leg = np.array([names.index(name) for name in legs[side].joints])
                q[leg] = legs[side].solve(np.eye(3)[None], sole, q[leg][None], iterations=60).q[0]
            body.write_base(data, SE3((forward, 0.0, height)))
            body.write_joints(data, q)
            mujoco.mj_kinematics(body.model, data)
            mujoco.mj_comPos(body.model, data)
            forward -= float(data.subtree_com[body.base_body][0])
        return SE3((forward, 0.0, height)), q
