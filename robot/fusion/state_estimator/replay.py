"""The state estimator over a recording, and leg odometry to hold it against."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from robot.fusion.state_estimator.contacts import Contacts
from robot.fusion.state_estimator.filter import ACCEL_BIAS, GYRO_BIAS, ContactFilter
from robot.fusion.state_estimator.legged_body import LeggedBody
from robot.fusion.state_estimator.legged_log import LeggedLog
from robot.fusion.state_estimator.parameters import DEG, Parameters
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, Array

REPORT_EVERY = 500
AT_START = 20
OF_STRANGERS = Parameters(slip_m_rts=0.03, roll_rad_rts=1.0 * DEG)
"""What is believed of a robot that nobody knows: legs that give, encoders that are off."""
LEAST_DT_S = 1e-5
MOST_DT_S = 0.5


@dataclass(frozen=True)
class Trajectory:
    """Where the base was, in the frame of its first pose's world.

    Attributes:
        rotations: shape (n, 3, 3).
        positions: [m], shape (n, 3).
        gyro_bias_rad_s, accel_bias_m_s2: in the end, in the IMU's frame, shape (3,).
        slips: how often the left and the right foot were found to have moved.
    """

    rotations: Array
    positions: Array
    gyro_bias_rad_s: Array
    accel_bias_m_s2: Array
    slips: tuple[int, int]

    @property
    def finite(self) -> bool:
        """Whether every number is one; else the filter had nothing to hold on to."""
        parts = (self.rotations, self.positions, self.gyro_bias_rad_s, self.accel_bias_m_s2)
        return all(bool(np.isfinite(part).all()) for part in parts)


def estimate(
    log: LeggedLog,
    body: LeggedBody,
    parameters: Parameters | None = None,
    *,
    causal: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Trajectory:
    """Run the filter over a recording.

    Args:
        log: what was recorded.
        body: where soles and IMU were.
        parameters: what to believe; `OF_STRANGERS` if None.
        causal: use of each moment only what was known then. Else a second pass begins with the
            biases that the first one found.
        progress: told the share that is done.
    """
    parameters = parameters or OF_STRANGERS
    state = _begin(log, body, parameters)
    if not causal:
        _pass(log, body, state, _told(progress, 0.0, 0.5))
        state = _begin_again(log, body, parameters, state)
    rotations, positions = _pass(log, body, state, _told(progress, 0.0 if causal else 0.5, 1.0))
    rotations_B, positions_B = _of_base(body, rotations, positions)
    return Trajectory(
        *_from_first(rotations_B, positions_B, log.X_WB),
        state.gyro_bias, state.accel_bias, (state.slips[0], state.slips[1]),
    )  # fmt: skip


def leg_odometry(log: LeggedLog, body: LeggedBody) -> Trajectory:
    """Where the base was if the foot that bears more never moves: joints and forces alone."""
    n = len(log)
    rotations, positions = np.zeros((n, 3, 3)), np.zeros((n, 3))
    rotation, position = _upright(log, body), np.zeros(3)
    side, turn, place = -1, np.eye(3), np.zeros(3)
    for k in range(n):
        heavier = int(log.force_n[k, 1] > log.force_n[k, 0])
        change = side < 0 or log.force_n[k, heavier] > 1.2 * log.force_n[k, side]
        if heavier != side and change:
            side, last = heavier, max(k - 1, 0)
            turn = rotation @ body.rotations[last, side]
            place = position + rotation @ body.positions[last, side]
        rotation = turn @ body.rotations[k, side].T
        position = place - rotation @ body.positions[k, side]
        rotations[k], positions[k] = rotation, position
    base = _of_base(body, rotations, positions)
    zero = np.zeros(3)
    return Trajectory(*_from_first(*base, log.X_WB), zero, zero, (0, 0))


def _begin(log: LeggedLog, body: LeggedBody, parameters: Parameters) -> ContactFilter:
    """Upright by what the accelerometer felt first, the lower sole on the floor."""
    rotation = _upright(log, body)
    soles = body.positions[0] @ rotation.T
    return ContactFilter(parameters, rotation, np.array((0.0, 0.0, -float(soles[:, 2].min()))))


def _begin_again(
    log: LeggedLog, body: LeggedBody, parameters: Parameters, first: ContactFilter
) -> ContactFilter:
    """The same start with the biases that a pass found, no surer than they wander."""
    felt = body.accel_sign * log.accel_m_s2[:AT_START].mean(axis=0) - first.accel_bias
    state = _begin(log, body, parameters)
    rotation = _with_up(felt, state.rotation)
    state.place(rotation, state.p)
    state.gyro_bias[:], state.accel_bias[:] = first.gyro_bias, first.accel_bias
    for biases in (GYRO_BIAS, ACCEL_BIAS):
        state.covariance[biases, biases] = first.covariance[biases, biases]
    return state


def _pass(
    log: LeggedLog, body: LeggedBody, state: ContactFilter, progress: Callable[[float], None]
) -> tuple[Array, Array]:
    """Once over all samples; returns orientations and positions of the IMU."""
    n = len(log)
    rotations, positions = np.zeros((n, 3, 3)), np.zeros((n, 3))
    contacts = Contacts(_weight_n(log, body))
    accel = body.accel_sign * log.accel_m_s2
    steps = np.diff(log.taken_s, prepend=log.taken_s[0]).clip(LEAST_DT_S, MOST_DT_S).tolist()
    for k, dt_s in enumerate(steps):
        state.predict(dt_s, log.gyro_rad_s[k], accel[k])
        if not log.blind[k]:
            left, right = contacts.update(log.force_n[k])
            state.correct(dt_s, body.positions[k], body.rotations[k], (left, right))
        rotations[k], positions[k] = state.rotation, state.p
        if k % REPORT_EVERY == 0:
            progress(k / n)
    return rotations, positions


def _weight_n(log: LeggedLog, body: LeggedBody) -> float:
    """What both feet bear, standing: by their forces, or by the mass where those are odd."""
    felt = float(np.median(log.force_n.sum(axis=1)))
    known = body.mass_kg * GRAVITY_M_S2
    return felt if felt > 0.3 * known and felt > 0.0 else max(known, 1.0)


def _upright(log: LeggedLog, body: LeggedBody) -> Array:
    """R_NI at the start: up by what is felt, heading as the base's x axis."""
    felt = body.accel_sign * log.accel_m_s2[:AT_START].mean(axis=0)
    return _with_up(felt, body.R_BI)


def _with_up(up: Array, rotation: Array) -> Array:
    """The rotation nearest to another one that takes `up` to the vertical."""
    z: Array = up / np.linalg.norm(up)
    y = _cross(z, rotation[0])
    if np.linalg.norm(y) < 1e-6:
        y = _cross(z, rotation[1])
    y /= np.linalg.norm(y)
    return np.stack((_cross(y, z), y, z))


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(np.cross(a, b), dtype=np.float64)


def _of_base(body: LeggedBody, rotations: Array, positions: Array) -> tuple[Array, Array]:
    """Poses of the base from those of the IMU."""
    of_base = rotations @ body.R_BI.T
    return of_base, positions - of_base @ body.p_BI


def _from_first(rotations: Array, positions: Array, X_WB: SE3 | None) -> tuple[Array, Array]:
    """The same motion from a known first pose; without one, from the own upright frame."""
    if X_WB is None:
        return rotations, positions - positions[0] * (1.0, 1.0, 0.0)
    turn = X_WB.rotation() @ rotations[0].T
    return turn @ rotations, (positions - positions[0]) @ turn.T + X_WB.p


def _told(
    progress: Callable[[float], None] | None, begin: float, end: float
) -> Callable[[float], None]:
    """Progress of a part of the whole."""
    if progress is None:
        return lambda _share: None
    return lambda share: progress(begin + math.copysign(end - begin, 1.0) * share)
