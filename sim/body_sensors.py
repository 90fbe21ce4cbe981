"""The sensors inside the body: encoders, currents, IMU, forces at ankles and wrists."""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MotorState
from robot.errors import DescriptionError, Problem
from robot.model.body import SIDES
from robot.model.description import RobotDescription
from robot.se3 import Array, Quaternion, Vector3, quat_to_matrix
from sim.motors import Motors

# 1 sigma, where the description has no figure. Velocity: encoder difference over 20 ms, averaged.
VELOCITY_PER_ENCODER_S = 50.0
PINION_RADIUS_M = 0.01
TORQUE_SHARE = 0.005
FORCE_N = 0.3
TORQUE_NM = 0.01
NOISE_BLOCK = 256


class ImuFlaws(NamedTuple):
    """What is wrong with an IMU besides noise, in its own frame; `askew` turns what it feels."""

    gyro_rad_s: Vector3 = (0.0, 0.0, 0.0)
    accel_m_s2: Vector3 = (0.0, 0.0, 0.0)
    askew: Quaternion = (1.0, 0.0, 0.0, 0.0)


class BodySensors:
    """Reads one robot out of one simulation; all noise from one generator (None: no noise)."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        description: RobotDescription,
        *,
        motors: Motors,
        rng: np.random.Generator | None,
    ) -> None:
        """Find every sensor that the description names.

        Raises:
            DescriptionError: naming the sensors that the MJCF has not.
        """
        self._motors = motors
        self._rng = rng
        self._qpos, self._qvel = data.qpos, data.qvel
        self._force, self._sensordata = data.actuator_force, data.sensordata
        self._addresses = _addresses(model, description)
        self._wrists = [row for row, side in enumerate(SIDES) if side in description.hands]
        self._sigma = _sigma(model, description, motors)
        self._truth: Array = np.empty(len(self._sigma))
        n = motors.count
        self._q, self._qd = self._truth[:n], self._truth[n : 2 * n]
        self._tau, self._rest = self._truth[2 * n : 3 * n], self._truth[3 * n :]
        self._wrenches = self._rest[6:]
        self._at_once: Array = np.zeros(n)
        self._noise: Array = np.empty((0, len(self._sigma)))
        self._drawn = 0
        self._flaws: tuple[Array, Array] | None = None

    def spoil_imu(self, flaws: ImuFlaws) -> None:
        """From now on the IMU is off by that."""
        offset = np.array((*flaws.gyro_rad_s, *flaws.accel_m_s2))
        self._flaws = quat_to_matrix(flaws.askew).T, offset

    def measure(self, stamp_s: float) -> BodySample:
        """Measure everything; forces and accelerations are those of the last physics step."""
        truth, motors = self._truth, self._motors
        n = motors.count
        self._qpos.take(motors.q_index, out=self._q, mode="clip")
        self._qvel.take(motors.qd_index, out=self._qd, mode="clip")
        self._tau[:] = self._force
        self._sensordata.take(self._addresses, out=self._rest, mode="clip")
        np.negative(self._wrenches, out=self._wrenches)  # MuJoCo's wrench: parent on child
        values = truth.copy() if self._rng is None else truth + self._next_noise(self._rng)
        rest = values[3 * n :]
        wrists = np.zeros((2, 6))
        wrists[self._wrists] = rest[18:].reshape(-1, 6)
        state = MotorState(
            stamp_s=stamp_s,
            q=values[:n],
            qd=values[n : 2 * n],
            tau=values[2 * n : 3 * n],
            temperature_c=motors.temperature_c.copy(),
            age_s=self._at_once,
            watchdog=motors.watchdog,
            command_stamp_s=motors.command_stamp_s,
        )
        if self._flaws is not None:
            turn, offset = self._flaws
            rest[:3], rest[3:6] = turn @ rest[:3], turn @ rest[3:6]
            rest[:6] += offset
        imu = ImuReading(stamp_s, rest[:3], rest[3:6])
        force = ForceReading(stamp_s, rest[6:18].reshape(2, 6), wrists)
        return BodySample(state, imu, force)

    def _next_noise(self, rng: np.random.Generator) -> Array:
        """Noise of one measurement; drawn for many at once, which is cheaper."""
        self._drawn += 1
        if self._drawn >= len(self._noise):
            self._noise = rng.standard_normal((NOISE_BLOCK, len(self._sigma))) * self._sigma
            self._drawn = 0
        return self._noise[self._drawn]


def _addresses(model: mujoco.MjModel, description: RobotDescription) -> NDArray[np.int64]:
    """Indices into sensordata: gyro, accelerometer, wrenches of ankles, of wrists with hands."""
    imu = description.sensors.imu
    names = [imu.gyro, imu.accelerometer]
    hands = description.hands
    for side in SIDES:
        names += [description.feet[side].force_sensor, description.feet[side].torque_sensor]
    for hand in [hands[side] for side in SIDES if side in hands]:
        names += [hand.force_sensor, hand.torque_sensor]
    known = [model.sensor(index).name for index in range(model.nsensor)]
    problems = [
        Problem(f"sensor {name!r} is not in the MJCF", str(description.mjcf_path()))
        for name in names
        if name not in known
    ]
    if problems:
        raise DescriptionError(problems)
    starts = [int(model.sensor(name).adr[0]) for name in names]
    return np.concatenate([np.arange(start, start + 3, dtype=np.int64) for start in starts])


def _sigma(model: mujoco.MjModel, description: RobotDescription, motors: Motors) -> Array:
    """Standard deviation of every measured value, in the order of `measure`."""
    sensors = description.sensors
    joints = [model.joint(motor.joint) for motor in description.motors.values()]
    slide = np.array([joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE for joint in joints])
    encoder = np.where(slide, PINION_RADIUS_M, 1.0) * sensors.encoder_noise_rad
    wrench = [FORCE_N] * 3 + [TORQUE_NM] * 3
    return np.concatenate(
        [
            encoder,
            encoder * VELOCITY_PER_ENCODER_S,
            motors.limit_nm * TORQUE_SHARE,
            [sensors.imu.gyro_noise_rad_s] * 3,
            [sensors.imu.accel_noise_m_s2] * 3,
            wrench * (2 + len(description.hands)),
        ]
    )
