"""The controlled sit: a motion that is worked out before it is needed, and played without feedback.

Whoever owns the buses has no balance and no estimate of the body. It moves the joints of the legs
along a squat whose centre of mass stays over the middle of the feet, with the torques that bear the
body there. By what the posture differs from the squat when the motion begins, it does to the end.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.drivers.motor_bus import MotorCommand
from robot.errors import DescriptionError
from robot.kinematics.dynamics import Dynamics
from robot.model.body import SIDES, BodyModel
from robot.se3 import SE3, Array

LOW_SHARE = 0.58
"""Of the standing height: lower than the controller squats (`robot.control.lowering`), for here the
motors let go afterwards. Juno's pelvis is at 0.33 m then."""
STEPS = 33
"""Postures from the highest to the lowest; between them everything is linear."""
LASTS_S = 2.5
"""From standing; from lower down it is shorter in proportion."""
ITERATIONS, GAIN, FOUND = 60, 0.7, 1e-6


class Squat(NamedTuple):
    """Postures of a squat, from the highest to the lowest, k of them.

    Attributes:
        legs: indices of the legs' motors, shape (m,).
        height_m: of the base above the soles, shape (k,).
        q_rad: of the legs' motors, shape (k, m).
        tau_nm: that bear the body there at rest, shape (k, m).
    """

    legs: list[int]
    height_m: Array
    q_rad: Array
    tau_nm: Array

    def place(self, q: Array) -> tuple[int, float]:
        """Which posture all motors' positions q, shape (n,), are nearest to, and how far [rad]."""
        apart = np.abs(self.q_rad - q[self.legs]).max(axis=1)
        nearest = int(np.argmin(apart))
        return nearest, float(apart[nearest])


def plan(body: BodyModel) -> Squat:
    """Work a robot's squat out, as deep as its legs reach inside their limits.

    Raises:
        DescriptionError: if they do not reach below its standing height.
    """
    description = body.description
    legs = [*description.indices("left_leg"), *description.indices("right_leg")]
    highest_m = description.balance.highest_base_m
    heights_m = np.linspace(highest_m, LOW_SHARE * description.walking.base_height_m, STEPS)
    dynamics, data = Dynamics(body), body.data()
    q = np.array(description.posture("nominal"))
    rows: list[tuple[float, Array, Array]] = []
    for height_m in heights_m.tolist():
        found = _posture(body, data, legs, q, height_m)
        if found is None:
            break
        q = found
        rows.append((height_m, q[legs], _bearing(dynamics, data)[legs]))
    if not rows or rows[-1][0] > description.walking.base_height_m:
        raise DescriptionError(
            f"{description.name}'s legs do not squat over the middle of its feet"
        )
    heights, postures, torques = zip(*rows, strict=True)
    return Squat(legs, np.array(heights), np.array(postures), np.array(torques))


def _posture(
    body: BodyModel, data: Any, legs: list[int], q: Array, height_m: float
) -> Array | None:
    """Motors' positions with the base upright at a height over flat soles, shape (n,).

    None if there are none inside the limits. Gauss-Newton from `q` on, over the legs' joints and
    where the base is over the floor.
    """
    q, base_xy, error = q.copy(), np.zeros(2), np.ones(1)
    dofs = np.concatenate((np.arange(2), body.dof_of[legs]))
    for _ in range(ITERATIONS):
        body.write_base(data, SE3((float(base_xy[0]), float(base_xy[1]), height_m)))
        body.write_joints(data, q)
        error, slope = _misfit(body, data, dofs)
        if np.abs(error).max() < FOUND:
            break
        step = GAIN * np.linalg.lstsq(slope, error, rcond=1e-6)[0]
        base_xy += step[:2]
        q[legs] += step[2:]
    is_inside = (q >= body.lower_rad - FOUND).all() and (q <= body.upper_rad + FOUND).all()
    return q if np.abs(error).max() < FOUND and is_inside else None


def _misfit(body: BodyModel, data: Any, dofs: NDArray[np.int64]) -> tuple[Array, Array]:
    """What soles and centre of mass are off by [m, rad], shape (14,), and how the dofs mend it."""
    model, half_m = body.model, 0.5 * body.description.walking.stance_width_m
    jac_p, jac_r = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    errors: list[Array] = []
    rows: list[Array] = []
    for side, aside_m in zip(SIDES, (half_m, -half_m), strict=True):
        site = body.sole_site[side]
        mujoco.mj_jacSite(model, data, jac_p, jac_r, site)
        axes = data.site_xmat[site].reshape(3, 3).T
        turn = 0.5 * np.cross(axes, np.eye(3)).sum(axis=0)  # that makes the sole flat
        errors += [np.array((0.0, aside_m, 0.0)) - data.site_xpos[site], turn]
        rows += [jac_p[:, dofs].copy(), jac_r[:, dofs].copy()]
    mujoco.mj_jacSubtreeCom(model, data, jac_p, body.base_body)
    errors.append(-data.subtree_com[body.base_body][:2])
    rows.append(jac_p[:2, dofs].copy())
    return np.concatenate(errors), np.vstack(rows)


def _bearing(dynamics: Dynamics, data: Any) -> Array:
    """Torques of all motors that bear the body at rest, shape (n,); data: at that posture.

    What no motor holds, the base's six rows, the soles bear: of all pairs of wrenches that do, the
    smallest, which of two soles side by side is half of the weight each.
    """
    body, here = dynamics.body, dynamics.data
    here.qpos[:] = data.qpos
    here.qvel[:] = 0.0
    dynamics.kinematics()
    mujoco.mj_rne(body.model, here, 0, dynamics.h)
    wrenches = np.linalg.lstsq(dynamics.jac[:, :6].T, dynamics.h[:6], rcond=None)[0]
    tau = dynamics.h - dynamics.jac.T @ wrenches
    return np.asarray(tau[body.dof_of])


class Sitting:
    """One descent, from where the motors are when it begins."""

    def __init__(
        self, body: BodyModel, squat: Squat, last: MotorCommand, q: Array, *, now_s: float
    ) -> None:
        """Begin now.

        Args:
            body: the robot.
            squat: as `plan` found it.
            last: what the motors were told last.
            q: where they are, shape (n,).
            now_s: by the motors' stamps.
        """
        self._begun_s = now_s
        self._squat, (place, _) = squat, squat.place(q)
        legs, stop = squat.legs, len(squat.height_m) - 1
        self._places = np.arange(stop + 1)
        self._from, self._to = float(place), float(stop)
        self._takes_s = LASTS_S * (1.0 - place / stop)
        held = np.where(last.kp > 0.0, last.q_des, q)
        self._apart_rad = q[legs] - squat.q_rad[place]
        self._apart_nm = last.tau_ff[legs] - squat.tau_nm[place]
        self._start = MotorCommand(
            0.0, held, np.zeros_like(q), last.tau_ff.copy(),
            np.where(last.kp > 0.0, last.kp, body.kp), np.where(last.kp > 0.0, last.kd, body.kd),
        )  # fmt: skip
        self._start.kp[legs], self._start.kd[legs] = body.kp[legs], body.kd[legs]
        self._limits_rad = body.lower_rad[legs], body.upper_rad[legs]

    def at(self, now_s: float) -> MotorCommand:
        """What to send now."""
        share, rate_1_s = _smooth(now_s - self._begun_s, self._takes_s)
        place = self._from + share * (self._to - self._from)
        legs, squat = self._squat.legs, self._squat
        q_rad, tau_nm = self._between(place, squat.q_rad), self._between(place, squat.tau_nm)
        step = max(min(1.0, self._to - place), 1e-9)
        slope = (self._between(place + step, squat.q_rad) - q_rad) / step
        start = self._start
        q_des, qd_des, tau_ff = start.q_des.copy(), start.qd_des.copy(), start.tau_ff.copy()
        q_des[legs] = np.clip(q_rad + self._apart_rad, *self._limits_rad)
        qd_des[legs] = slope * rate_1_s * (self._to - self._from)
        tau_ff[legs] = tau_nm + (1.0 - share) * self._apart_nm
        return MotorCommand(now_s, q_des, qd_des, tau_ff, start.kp, start.kd)

    def is_over(self, now_s: float) -> bool:
        """Whether the motion has ended."""
        return now_s - self._begun_s >= self._takes_s

    def _between(self, place: float, rows: Array) -> Array:
        low = min(int(place), len(rows) - 1)
        high = min(low + 1, len(rows) - 1)
        return rows[low] + (place - low) * (rows[high] - rows[low])


def _smooth(time_s: float, takes_s: float) -> tuple[float, float]:
    """Share of the way and its rate [1/s] of a minimum-jerk motion [FlashHogan1985]."""
    if takes_s <= 0.0 or time_s >= takes_s:
        return 1.0, 0.0
    x = max(0.0, time_s / takes_s)
    return x**3 * (10.0 - 15.0 * x + 6.0 * x * x), 30.0 * x * x * (1.0 - x) ** 2 / takes_s
