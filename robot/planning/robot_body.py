"""The robot as planners know it: chains of its arms, how it stands, what it touches."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from robot.errors import DescriptionError
from robot.messages import Side
from robot.model.body import SIDES, BodyModel
from robot.model.description import RobotDescription
from robot.planning.ik import Chain
from robot.planning.numerics import Indices
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

    Without a hand the chain ends at its last link.

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
        root = _root(body, f"{side}_arm")
        self.side: Side = side
        last = model.body(int(model.jnt_bodyid[body.joint_id(description.motors[names[-1]].joint)]))
        hand = description.hands.get(side)
        self.chain = Chain(model, root, last.name if hand is None else hand.grasp_site)
        joints = tuple(description.motors[name].joint for name in names)
        if joints != self.chain.joints:
            raise DescriptionError(
                f"group '{side}_arm' lists {', '.join(joints)}; the MJCF has "
                f"{', '.join(self.chain.joints)} from {root} to the grasp site"
            )
        self.motors: Indices = np.array(description.indices(f"{side}_arm"))
        self.lower, self.upper = self.chain.lower, self.chain.upper


class Body:
    """What all planners share; not for two threads at once."""

    def __init__(self, description: RobotDescription) -> None:
        """Compile the robot."""
        self.description = description
        self.model = BodyModel(description)
        self.arms: dict[Side, Arm] = {side: Arm(self.model, side) for side in description.arm_sides}
        self.scenes = SceneCache(description)
        self.nominal = np.array(description.posture("nominal"))
        joints = [motor.joint for motor in description.motors.values()]
        self._legs: dict[Side, tuple[Chain, Indices]] = {}
        for side in SIDES:
            root = _root(self.model, f"{side}_leg")
            leg = Chain(self.model.model, root, description.feet[side].sole_site)
            self._legs[side] = (leg, np.array([joints.index(name) for name in leg.joints]))
        self._standings: dict[tuple[BodyPosture, Side | None], Standing] = {}

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

    def standing(self, posture: BodyPosture, reaching: Side | None = None) -> Standing:
        """Where everything is when standing so, the arms nominal or one of them reaching out.

        Soles flat, pelvis level, the centre of mass over their midpoint; remembered.
        """
        key = (posture, reaching)
        if key not in self._standings:
            q = self.nominal.copy()
            if reaching is not None:
                q[self.arms[reaching].motors] = self._reaching(reaching)
            self._standings[key] = self.stand(posture, q)
        return self._standings[key]

    def stand(self, posture: BodyPosture, q: Array) -> Standing:
        """The same with arms and head as in `q`, shape (motors,).

        Leaning, or stretching an arm out, moves the base back; the legs follow by inverse
        kinematics.
        """
        description, body = self.description, self.model
        walking = description.walking
        height = posture.height_m or walking.base_height_m
        q = q.copy()
        lean = body.leaning(posture.yaw_rad, posture.pitch_rad)
        q[description.indices("waist")] = lean.waist_rad
        base = SE3.from_rpy(0.0, lean.base_pitch_rad, lean.base_yaw_rad, (0.0, 0.0, 0.0))
        data = body.data()
        body.write_joints(data, q)
        mujoco.mj_kinematics(body.model, data)
        X_OB = _body_pose(body, data, description.base_body)
        hips = {
            side: base @ X_OB.inverse() @ _body_pose(body, data, leg.body)
            for side, (leg, _) in self._legs.items()
        }
        at = np.array([0.0, 0.0, height])
        for _ in range(8):
            for side in SIDES:
                leg, motors = self._legs[side]
                aside = (0.5 if side == "left" else -0.5) * walking.stance_width_m
                X_HS = hips[side].inverse() @ SE3((-float(at[0]), aside - float(at[1]), -height))
                goal, p = X_HS.rotation()[None], np.array([X_HS.p])
                q[motors] = leg.solve(goal, p, q[motors][None], iterations=60).q[0]
            body.write_base(data, SE3((float(at[0]), float(at[1]), height), base.quat_wxyz))
            body.write_joints(data, q)
            mujoco.mj_kinematics(body.model, data)
            mujoco.mj_comPos(body.model, data)
            off = data.subtree_com[body.base_body][:2]
            if np.max(np.abs(off)) < 2e-4:
                break
            at[:2] -= off
        trunks: dict[Side, SE3] = {
            side: _body_pose(body, data, arm.chain.body) for side, arm in self.arms.items()
        }
        X_SB = SE3((float(at[0]), float(at[1]), height), base.quat_wxyz)
        return Standing(X_SB, q, trunks)

    def _reaching(self, side: Side) -> Array:
        """Joints of an arm with its hand out level in front, above the height of the elbow."""
        standing = self.standing(UPRIGHT)
        sign = 1.0 if side == "left" else -1.0
        ahead, aside, height = self.description.handy.reaching.raised_hand_m
        arm = self.arms[side]
        X_TG = standing.X_ST[side].inverse() @ SE3((ahead, sign * aside, height))
        q = self.nominal[arm.motors][None]
        return arm.chain.solve(X_TG.rotation()[None], np.array([X_TG.p]), q, iterations=60).q[0]


def _root(body: BodyModel, group: str) -> str:
    """The link that a leg or an arm hangs on."""
    first = body.description.motors[body.description.groups[group][0]].joint
    link = body.model.jnt_bodyid[body.joint_id(first)]
    return str(body.model.body(int(body.model.body_parentid[link])).name)


def _body_pose(body: BodyModel, data: Any, name: str) -> SE3:
    at = body.body_id(name)
    return SE3.from_rotation(data.xmat[at].reshape(3, 3), data.xpos[at])
