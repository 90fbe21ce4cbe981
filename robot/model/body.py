"""A robot's MJCF with the indices that its description gives meaning to.

The model holds the robot alone (no world); its free base and every joint that no motor drives but
an equality couples (the second finger of a hand) are filled in from the motors.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.errors import DescriptionError, Problem
from robot.messages import Side
from robot.model import measures, mjcf
from robot.model.description import RobotDescription
from robot.se3 import SE3, Array

Turn = Literal["roll", "pitch", "yaw"]
"""About which axis of its link a joint turns: x, y, z."""
SIDES: tuple[Side, Side] = ("left", "right")
TURNS: tuple[Turn, ...] = ("roll", "pitch", "yaw")


@dataclass(frozen=True, slots=True)
class Lean:
    """Who turns the trunk against the feet [rad]: waist, shape (its joints,), and base."""

    waist_rad: Array
    base_yaw_rad: float
    base_pitch_rad: float


class BodyModel:
    """MjModel and index arrays in motor order.

    Attributes:
        model: the compiled MjModel (`Any`: mujoco ships partial stubs).
        qpos_of: qpos address of each motor, shape (n,).
        dof_of: dof (qvel) address of each motor, shape (n,).
        lower_rad, upper_rad: joint range of each motor, shape (n,).
        torque_limit_nm, velocity_limit_rad_s: shape (n,).
        kp, kd: position gains of the description, shape (n,).
        bare_arms: sides of the arms that have no hand.
        waist_below: whether the legs hang on the waist: the base is then the trunk, not the pelvis.
    """

    def __init__(self, description: RobotDescription) -> None:
        """Compile the MJCF and look every name up.

        Raises:
            DescriptionError: if the MJCF lacks what the description names.
        """
        self.description = description
        self.model: Any = mjcf.compiled(description.source)
        self._check_names()
        model = self.model
        motors = description.motors.values()
        joints = [self.joint_id(motor.joint) for motor in motors]
        self.count = len(joints)
        self.qpos_of: NDArray[np.int64] = np.array([model.jnt_qposadr[j] for j in joints])
        self.dof_of: NDArray[np.int64] = np.array([model.jnt_dofadr[j] for j in joints])
        self.lower_rad: Array = np.array([model.jnt_range[j][0] for j in joints])
        self.upper_rad: Array = np.array([model.jnt_range[j][1] for j in joints])
        self.torque_limit_nm: Array = np.array([motor.torque_limit_nm for motor in motors])
        self.velocity_limit_rad_s: Array = np.array([m.velocity_limit_rad_s for m in motors])
        self.kp: Array = np.array([motor.kp for motor in motors])
        self.kd: Array = np.array([motor.kd for motor in motors])
        self.base_body: int = self.body_id(description.base_body)
        self.torso_body: int = self.body_id(description.torso_body)
        self.mass_kg = float(model.body_subtreemass[self.base_body])
        self.sole_site = {side: self.site_id(description.feet[side].sole_site) for side in SIDES}
        self.foot_body = {side: self.body_id(description.feet[side].body) for side in SIDES}
        self.grasp_site = {
            side: self.site_id(hand.grasp_site) for side, hand in description.hands.items()
        }
        self._check_postures()
        self._arm_ends: dict[Side, tuple[int, Array]] = {
            side: self._arm_end(side) for side in description.arm_sides
        }
        self.bare_arms: list[Side] = [
            side for side in self._arm_ends if side not in description.hands
        ]
        self._waist: list[int] = description.indices("waist")
        self._waist_turns = self.turns("waist")
        self.waist_below = self._is_waist_below()
        couplings = self._couplings()
        order = np.argsort(np.concatenate([self.qpos_of, couplings[0]]))
        self._joint_qpos = as_index(np.concatenate([self.qpos_of, couplings[0]])[order])
        self._joint_dof = as_index(np.concatenate([self.dof_of, couplings[1]])[order])
        self._joint_motor = np.concatenate([np.arange(self.count), couplings[2]])[order]
        self._joint_gain: Array = np.concatenate([np.ones(self.count), couplings[3]])[order]

    def _check_names(self) -> None:
        """Every name of the description must be in the MJCF."""
        description, model = self.description, self.model
        wanted: list[tuple[str, mujoco.mjtObj, str]] = []
        obj = mujoco.mjtObj
        wanted += [("joint", obj.mjOBJ_JOINT, motor.joint) for motor in description.motors.values()]
        wanted += [("body", obj.mjOBJ_BODY, description.base_body)]
        wanted += [("body", obj.mjOBJ_BODY, description.torso_body)]
        for foot in description.feet.values():
            wanted.append(("body", obj.mjOBJ_BODY, foot.body))
            wanted.append(("site", obj.mjOBJ_SITE, foot.sole_site))
        for hand in description.hands.values():
            wanted.append(("body", obj.mjOBJ_BODY, hand.body))
            wanted.append(("site", obj.mjOBJ_SITE, hand.grasp_site))
        wanted += [("site", obj.mjOBJ_SITE, description.sensors.imu.site)]
        problems = [
            Problem(
                f"{kind} {name!r} of the description is not in {description.mjcf}",
                str(description.mjcf_path()),
                suggestion=f"add the {kind} to the MJCF or correct the description",
            )
            for kind, code, name in wanted
            if mujoco.mj_name2id(model, code, name) < 0
        ]
        if problems:
            raise DescriptionError(problems)

    def _check_postures(self) -> None:
        """Every posture must be inside the joints' ranges."""
        description, problems = self.description, list[Problem]()
        for name in description.postures:
            for k, value in enumerate(description.posture(name)):
                low, high = float(self.lower_rad[k]), float(self.upper_rad[k])
                if not low <= value <= high:
                    motor = description.motor_names[k]
                    text = (
                        f"posture {name!r} puts {motor} to {value:g}, it goes {low:g} to {high:g}"
                    )
                    problems.append(Problem(text, description.folder or None))
        if problems:
            raise DescriptionError(problems)

    def turns(self, group: str) -> list[Turn]:
        """About which axis each joint of a group turns, in the group's order."""
        axes = [
            self.model.jnt_axis[self.model.dof_jntid[self.dof_of[i]]]
            for i in self.description.indices(group)
        ]
        return [TURNS[int(np.argmax(np.abs(axis)))] for axis in axes]

    def arm_end(self, data: Any, side: Side) -> Array:
        """Where the last link of an arm ends, in the frame of the base pose [m], shape (3,)."""
        link, p = self._arm_ends[side]
        return data.xmat[link].reshape(3, 3) @ p + data.xpos[link]

    def _arm_end(self, side: Side) -> tuple[int, Array]:
        description = self.description
        last = description.motors[description.groups[f"{side}_arm"][-1]].joint
        link = int(self.model.jnt_bodyid[self.joint_id(last)])
        return link, measures.far_end(self.model, link)

    def leaning(self, yaw_rad: float, pitch_rad: float) -> Lean:
        """How the trunk gets this yaw and pitch against the feet.

        By the waist's joints, inside their ranges. Where none of them bends forward, the whole base
        does, about the hips. A trunk that is the base itself turns as a whole, and the waist under
        it as far back: the pelvis stays where it is.
        """
        sign = -1.0 if self.waist_below else 1.0
        wanted = {"roll": 0.0, "pitch": sign * pitch_rad, "yaw": sign * yaw_rad}
        goal = np.array([wanted[turn] for turn in self._waist_turns])
        lower, upper = self.lower_rad[self._waist], self.upper_rad[self._waist]
        waist = np.minimum(np.maximum(goal, lower), upper)
        by_base = self.waist_below or "pitch" not in self._waist_turns
        turned_rad = -sum(
            float(value)
            for value, turn in zip(waist, self._waist_turns, strict=True)
            if turn == "yaw" and self.waist_below
        )
        return Lean(waist, turned_rad, pitch_rad if by_base else 0.0)

    def _is_waist_below(self) -> bool:
        motors, model = self.description.motors, self.model
        names = self.description.groups["waist"]
        waist = {int(model.jnt_bodyid[self.joint_id(motors[name].joint)]) for name in names}
        body = self.foot_body["left"]
        while body and body not in waist:
            body = int(model.body_parentid[body])
        return body in waist

    def _couplings(self) -> tuple[Any, Any, Any, Any]:
        """Joints tied to a motor's joint by a linear joint equality."""
        model = self.model
        motor_of = {int(dof): i for i, dof in enumerate(self.dof_of)}
        rows: list[tuple[int, int, int, float]] = []
        for e in range(model.neq):
            if model.eq_type[e] != mujoco.mjtEq.mjEQ_JOINT:
                continue
            first, second = int(model.eq_obj1id[e]), int(model.eq_obj2id[e])
            motor = motor_of.get(int(model.jnt_dofadr[second]))
            if motor is not None:
                gain = float(model.eq_data[e][1])
                rows.append(
                    (int(model.jnt_qposadr[first]), int(model.jnt_dofadr[first]), motor, gain)
                )
        columns = list(zip(*rows, strict=True)) or [(), (), (), ()]
        index = [np.array(column, dtype=np.int64) for column in columns[:3]]
        return index[0], index[1], index[2], np.array(columns[3], dtype=np.float64)

    def joint_id(self, name: str) -> int:
        """Id of a joint."""
        return int(mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT, name))

    def body_id(self, name: str) -> int:
        """Id of a body."""
        return int(mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, name))

    def site_id(self, name: str) -> int:
        """Id of a site."""
        return int(mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_SITE, name))

    def data(self) -> Any:
        """A fresh MjData."""
        return mujoco.MjData(self.model)

    def write_joints(self, data: Any, q: Array, qd: Array | None = None) -> None:
        """Put motor positions (and velocities), shape (n,), into a MjData, coupled joints too."""
        data.qpos[self._joint_qpos] = self._joint_gain * q[self._joint_motor]
        if qd is not None:
            data.qvel[self._joint_dof] = self._joint_gain * qd[self._joint_motor]

    def write_base(self, data: Any, X_NB: SE3) -> None:
        """Put the base pose into a MjData."""
        data.qpos[0:3] = X_NB.p
        data.qpos[3:7] = X_NB.quat_wxyz

    def site_pose(self, data: Any, site: int) -> SE3:
        """Pose of a site in the frame that the base pose was given in."""
        return SE3.from_rotation(data.site_xmat[site].reshape(3, 3), data.site_xpos[site])


def as_index(indices: NDArray[np.int64]) -> slice | NDArray[np.int64]:
    """A slice where the indices run on without a gap (views instead of copies), else themselves."""
    if not len(indices):
        return slice(0, 0)
    first, last = int(indices[0]), int(indices[-1])
    if np.array_equal(indices, np.arange(first, last + 1)):
        return slice(first, last + 1)
    return indices
