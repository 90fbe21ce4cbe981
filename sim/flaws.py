"""What is wrong with one robot: drawn from a reality (`sim.realities`) by the run's seed."""

from __future__ import annotations

import math
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.model import identified
from robot.model.description import RobotDescription
from robot.se3 import SE3, Array, Quaternion, Vector3
from sim.realities import Body, Imu, Joints, Profile, Range

PINION_RADIUS_M = 0.01
"""Of the drive of a joint that slides: so far it goes for a radian of its motor."""
NO_END_RAD_S = 1e9
"""The speed at which no torque is left, of a motor that gives it at any."""
FLANK_SHARE = 0.01
"""Of the peak torque: from about this on a gear lies on one flank of its play."""


class ImuFlaws(NamedTuple):
    """What is wrong with an IMU besides noise, in its own frame; `askew` turns what it feels."""

    gyro_rad_s: Vector3 = (0.0, 0.0, 0.0)
    accel_m_s2: Vector3 = (0.0, 0.0, 0.0)
    askew: Quaternion = (1.0, 0.0, 0.0, 0.0)


class JointFlaws(NamedTuple):
    """What is wrong with motors and encoders, in the order of the motors, shape (n,) each.

    Attributes:
        offset: what an encoder says too much [rad, m].
        step: of an encoder [rad, m]; 0: none.
        play: between motor and joint [rad, m].
        flank_nm: the torque from which a gear lies on one side of it.
        lag_s: time constant of the velocities' filter.
        friction_nm: Coulomb friction.
        strength: torque given for torque asked.
        no_load_rad_s: the speed at which no torque is left.
        delay_s: from a measurement to its torque.
        viscous_nm_s: friction that grows with speed.
    """

    offset: Array
    step: Array
    play: Array
    flank_nm: Array
    lag_s: float
    friction_nm: Array
    strength: Array
    no_load_rad_s: Array
    delay_s: float
    viscous_nm_s: Array


class ForceFlaws(NamedTuple):
    """Offsets of all wrenches [N, N m], by sensor, and how they wander in a root second."""

    offset: Array
    drift_rts: Array


class Flaws(NamedTuple):
    """All that is wrong inside one robot."""

    imu: ImuFlaws
    joints: JointFlaws
    forces: ForceFlaws


def draw(
    profile: Profile, model: mujoco.MjModel, robot: RobotDescription, rng: np.random.Generator
) -> Flaws:
    """What is wrong with the senses and the motors of one robot.

    What was measured of a joint (`robot.model.identified`) is so, and is not drawn.

    Raises:
        ConfigError: what was measured says what cannot be meant.
    """
    sensors = 2 + len(robot.hands)
    sigma = np.array([profile.forces.offset_n] * 3 + [profile.forces.offset_nm] * 3)
    drift = np.array([profile.forces.drift_n_rts] * 3 + [0.0] * 3)
    return Flaws(
        imu=_imu(profile.imu, rng),
        joints=_joints(profile.joints, model, robot, rng),
        forces=ForceFlaws(
            np.tile(sigma, sensors) * rng.standard_normal(6 * sensors), np.tile(drift, sensors)
        ),
    )


def _imu(imu: Imu, rng: np.random.Generator) -> ImuFlaws:
    gyro = _anywhere(math.radians(imu.gyro_offset_deg_s), rng)
    accel = _anywhere(imu.accel_offset_m_s2, rng)
    roll, pitch, yaw = (math.radians(imu.askew_deg) * rng.uniform(-1.0, 1.0, 3)).tolist()
    return ImuFlaws(gyro, accel, SE3.from_rpy(roll, pitch, yaw, (0.0, 0.0, 0.0)).quat_wxyz)


def _anywhere(most: float, rng: np.random.Generator) -> Vector3:
    """A vector up to so long in any direction."""
    way = rng.standard_normal(3)
    x, y, z = (rng.uniform(0.0, most) / np.linalg.norm(way) * way).tolist()
    return x, y, z


def _joints(
    joints: Joints, model: mujoco.MjModel, robot: RobotDescription, rng: np.random.Generator
) -> JointFlaws:
    motors = robot.motors.values()
    n = len(motors)
    lever = np.where(slides(model, robot), PINION_RADIUS_M, 1.0)
    peak_nm = np.array([motor.torque_limit_nm for motor in motors])
    fastest = np.array([motor.velocity_limit_rad_s for motor in motors])
    step_rad = 2.0 * math.pi / 2.0**joints.encoder_bits if joints.encoder_bits else 0.0
    share = joints.no_load_speed_share
    found = JointFlaws(
        offset=lever * joints.encoder_offset_rad * rng.standard_normal(n),
        step=lever * step_rad,
        play=lever * np.radians(_each(joints.backlash_deg, n, rng)),
        flank_nm=FLANK_SHARE * peak_nm,
        lag_s=joints.velocity_lag_s,
        friction_nm=peak_nm * _each(joints.friction_share, n, rng),
        strength=_each(joints.strength, n, rng),
        no_load_rad_s=fastest * share if share else np.full(n, NO_END_RAD_S),
        delay_s=float(rng.uniform(*joints.delay_ms)) / 1000.0,
        viscous_nm_s=np.zeros(n),
    )
    return _as_measured(found, robot)


def _as_measured(drawn: JointFlaws, robot: RobotDescription) -> JointFlaws:
    """What was measured in the place of what was drawn; the delay is one for all: their mean."""
    measured = identified.beside(robot)
    rows = [(k, measured[name]) for k, name in enumerate(robot.motor_names) if name in measured]
    if not rows:
        return drawn
    for k, joint in rows:
        drawn.friction_nm[k], drawn.viscous_nm_s[k] = joint.friction_nm, joint.viscous_nm_s
        drawn.play[k] = joint.backlash_rad
    return drawn._replace(delay_s=float(np.mean([joint.delay_s for _, joint in rows])))


def slides(model: mujoco.MjModel, robot: RobotDescription) -> NDArray[np.bool_]:
    """Which motors move a joint that slides, shape (motors,)."""
    joints = [model.joint(motor.joint) for motor in robot.motors.values()]
    return np.array([joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE for joint in joints])


def _each(span: Range, count: int, rng: np.random.Generator) -> Array:
    return rng.uniform(span[0], span[1], count)


def weigh(
    model: mujoco.MjModel, body: Body, robot: RobotDescription, rng: np.random.Generator
) -> None:
    """Let links weigh other than described, and the floor be another one."""
    own = np.flatnonzero(model.body_rootid == model.body(robot.base_body).id)
    factors = rng.uniform(*body.link_mass, size=len(own))
    torso = int(model.body(robot.torso_body).id)
    more_kg = body.torso_kg * rng.uniform(-1.0, 1.0)
    shift_m = body.torso_com_m * rng.uniform(-1.0, 1.0, 3)
    friction = body.floor_friction
    if friction is not None:
        soles = [model.body(foot.body).id for foot in robot.feet.values()]
        geoms = [*np.flatnonzero(np.isin(model.geom_bodyid, soles)), model.geom("floor").id]
        model.geom_friction[geoms, 0] = rng.uniform(*friction)
    scale_mass(model, as_bodies(own), factors)
    load(model, torso, more_kg)
    model.body_ipos[torso] += shift_m
    settle(model)


def as_bodies(ids: NDArray[np.intp]) -> list[int]:
    """Body ids as plain numbers."""
    return [int(index) for index in ids]


def scale_mass(model: mujoco.MjModel, bodies: list[int], factors: Array) -> None:
    """Let bodies weigh so many times as much, their shape being the same."""
    model.body_mass[bodies] *= factors
    model.body_inertia[bodies] *= factors[:, None]


def load(model: mujoco.MjModel, body: int, more_kg: float) -> None:
    """Let one body weigh more, in proportion everywhere."""
    mass_kg = float(model.body_mass[body])
    scale_mass(model, [body], np.array([max(0.1, (mass_kg + more_kg) / mass_kg)]))


def settle(model: mujoco.MjModel) -> None:
    """Let MuJoCo compute anew what follows from masses."""
    mujoco.mj_setConst(model, mujoco.MjData(model))
