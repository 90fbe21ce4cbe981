"""The sensors inside the body: encoders, currents, IMU, forces at ankles and wrists."""

from __future__ import annotations

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MotorState
from robot.errors import DescriptionError, Problem
from robot.model.body import SIDES
from robot.model.description import RobotDescription
from robot.reality.faults import ImuFault
from robot.se3 import Array, quat_to_matrix
from sim.flaws import PINION_RADIUS_M, Flaws, ImuFlaws, JointFlaws, slides
from sim.motors import Motors

# 1 sigma, where the description has no figure. Velocity: encoder difference over 20 ms, averaged.
VELOCITY_PER_ENCODER_S = 50.0
TORQUE_SHARE = 0.005
FORCE_N = 0.3
TORQUE_NM = 0.01
NOISE_BLOCK = 256


class BodySensors:
    """Reads one robot out of one simulation; all noise from one generator (None: no noise).

    Attributes:
        turns: how fast the floor turns, in W [rad/s]; None: it does not.
        imu_broken: how the IMU is; None: it is not.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        description: RobotDescription,
        *,
        motors: Motors,
        rng: np.random.Generator | None,
        flaws: Flaws | None = None,
        wander: np.random.Generator | None = None,
    ) -> None:
        """Find every sensor that the description names.

        Args:
            model: of the scene.
            data: of the scene.
            description: of the robot.
            motors: of the robot.
            rng: of the noise.
            flaws: what is wrong besides noise.
            wander: of what drifts.

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
        self._own = ImuFlaws() if flaws is None else flaws.imu
        self._imu: tuple[Array, Array] | None = None
        self._joints = None if flaws is None else _Encoders(flaws.joints)
        self._forces = None if flaws is None else flaws.forces
        self._wander = wander
        self._drift: Array = np.zeros(len(self._sigma) - 3 * n - 6)
        self._last_s = 0.0
        self.turns: tuple[float, float, float] | None = None
        self.imu_broken: ImuFault | None = None
        self._last_felt: ImuReading | None = None
        self._imu_rotation = data.site_xmat[model.site(description.sensors.imu.site).id]
        if flaws is not None:
            self.spoil_imu(ImuFlaws())

    def spoil_imu(self, flaws: ImuFlaws) -> None:
        """From now on the IMU is off by that, besides what it is off by itself."""
        own = self._own
        turn = quat_to_matrix(flaws.askew).T @ quat_to_matrix(own.askew).T
        offsets = [
            np.array((*one.gyro_rad_s, *one.accel_m_s2), dtype=np.float64) for one in (flaws, own)
        ]
        self._imu = turn, offsets[0] + offsets[1]

    def _spoil(self, values: Array, stamp_s: float) -> None:
        """What is wrong with the senses besides noise, done to a measurement."""
        n = self._motors.count
        dt_s, self._last_s = max(0.0, stamp_s - self._last_s), stamp_s
        if self._joints is not None:
            self._joints.spoil(values[:n], values[n : 2 * n], self._tau, dt_s)
        if self._forces is not None and self._wander is not None:
            step = math.sqrt(dt_s) * self._forces.drift_rts
            self._drift += step * self._wander.standard_normal(len(step))
            values[3 * n + 6 :] += self._forces.offset + self._drift
        if self._imu is not None:
            turn, offset = self._imu
            gyro, accel = values[3 * n : 3 * n + 3], values[3 * n + 3 : 3 * n + 6]
            gyro[:], accel[:] = turn @ gyro, turn @ accel
            values[3 * n : 3 * n + 6] += offset

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
        if self.turns is not None:
            values[3 * n : 3 * n + 3] += self.turns @ self._imu_rotation.reshape(3, 3)
        if self._imu is not None:
            self._spoil(values, stamp_s)
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
        imu = self._felt(ImuReading(stamp_s, rest[:3], rest[3:6]))
        force = ForceReading(stamp_s, rest[6:18].reshape(2, 6), wrists)
        return BodySample(state, imu, force)

    def _felt(self, imu: ImuReading) -> ImuReading:
        """What a broken IMU makes of a reading."""
        last = self._last_felt
        if self.imu_broken is None or last is None:
            self._last_felt = imu
            return imu
        if self.imu_broken == "silent":
            return last
        if self.imu_broken == "frozen":
            return ImuReading(imu.stamp_s, last.gyro_rad_s, last.accel_m_s2)
        nothing = np.full(3, math.nan)
        return ImuReading(imu.stamp_s, nothing, nothing)

    def _next_noise(self, rng: np.random.Generator) -> Array:
        """Noise of one measurement; drawn for many at once, which is cheaper."""
        self._drawn += 1
        if self._drawn >= len(self._noise):
            self._noise = rng.standard_normal((NOISE_BLOCK, len(self._sigma))) * self._sigma
            self._drawn = 0
        return self._noise[self._drawn]


class _Encoders:
    """What encoders make of joints: offsets, steps, play, and velocities that lag."""

    def __init__(self, flaws: JointFlaws) -> None:
        self._flaws = flaws
        self._speed: Array = np.zeros_like(flaws.offset)

    def spoil(self, q: Array, qd: Array, tau: Array, dt_s: float) -> None:
        """Change positions and velocities in place.

        An encoder sits on the motor's side of the gear: pushing, the motor is ahead of the joint by
        half the play.
        """
        flaws, speed = self._flaws, self._speed
        q += flaws.offset
        q += 0.5 * flaws.play * np.tanh(tau / flaws.flank_nm)
        steps = flaws.step > 0.0
        q[steps] = np.round(q[steps] / flaws.step[steps]) * flaws.step[steps]
        speed += dt_s / (flaws.lag_s + dt_s) * (qd - speed) if dt_s > 0.0 else 0.0
        qd[:] = speed


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
    encoder = np.where(slides(model, description), PINION_RADIUS_M, 1.0) * sensors.encoder_noise_rad
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
