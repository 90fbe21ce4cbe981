"""How the body is, as its controller believes, and how well loops keep their time."""

from __future__ import annotations

from typing import Literal

import msgspec

from robot.failures import Failure
from robot.messages.basics import Channel, Message, Mode, Side
from robot.se3 import SE3, Vector3


class Activity(msgspec.Struct, frozen=True, kw_only=True):
    """What a channel does about the last command sent to it."""

    id: int
    status: Literal["running", "done", "failed"]
    detail: str = ""


class HandState(msgspec.Struct, frozen=True, kw_only=True):
    """One hand: grasp pose, measured opening [m] and opening speed [m/s], force at the wrist.

    `load_n` is the vertical force the hand bears beyond its own weight [N], low-pass filtered.
    `pulls` is how often it has gripped harder, because what it holds was about to slip.
    """

    X_NG: SE3
    opening_m: float
    opening_m_s: float
    load_n: float
    pulls: int = 0


class ImuBias(msgspec.Struct, frozen=True, kw_only=True):
    """What is known of an IMU, in its own frame: its offsets, and how sure they are (1 sigma)."""

    gyro_rad_s: Vector3
    accel_m_s2: Vector3
    gyro_sigma_rad_s: Vector3
    accel_sigma_m_s2: Vector3


IMU = "IMU"
"""Whom an alarm of it concerns."""


class MotorAlarm(msgspec.Struct, frozen=True):
    """One thing wrong with a motor or its bus, as its driver says, or with the IMU (`IMU`).

    `code` is for programs (`silent`), `who` the joint or the bus; `level` what is done, mild first:
    WARN, DERATE (less torque), HOLD (the last targets are kept), SIT (the robot is lowered, and it
    stays latched), DAMP and OFF (no stiffness, no torque: what the owner of the buses does alone).
    """

    code: str
    who: str
    level: Literal["WARN", "DERATE", "HOLD", "SIT", "DAMP", "OFF"]
    cause: str
    cure: str


class Landing(msgspec.Struct, frozen=True, kw_only=True):
    """Where a sole is to land: its middle and heading on the floor of N [m, rad]."""

    side: Side
    x_m: float
    y_m: float
    yaw_rad: float


class BodyState(Message, frozen=True, kw_only=True):
    """The body as the controller believes it to be; estimated, not true.

    `q_rad`, `qd_rad_s`, `tau_nm` are in motor order (the description's), fingers in m, m/s, N.
    `X_NS` is the stance: midpoint and mean heading of the soles. Points in N [m]. `since_s` is when
    this controller took the motors over: another value, another controller, with an N of its own;
    what it knows of the IMU goes over to that. `arm_ends_N` says where
    arms end that have no hand. `most_clamped` is the motor and the limit that most of
    the `clamped` values were beyond. `steps` are the landings that are planned, in order.
    """

    mode: Mode
    X_NB: SE3
    v_NB: Vector3
    w_NB: Vector3
    X_NL: SE3
    X_NR: SE3
    X_NS: SE3
    left_contact: bool
    right_contact: bool
    q_rad: tuple[float, ...]
    qd_rad_s: tuple[float, ...]
    tau_nm: tuple[float, ...]
    com_N: Vector3
    dcm_N: tuple[float, float]
    zmp_N: tuple[float, float]
    hands: dict[Side, HandState]
    activities: dict[Channel, Activity]
    clamped: int = 0
    most_clamped: str = ""
    refused: int = 0
    temperature_c: tuple[float, ...] = ()
    alarms: tuple[MotorAlarm, ...] = ()
    failure: Failure | None = None
    since_s: float = 0.0
    imu: ImuBias | None = None
    arm_ends_N: dict[Side, Vector3] = msgspec.field(default_factory=dict[Side, Vector3])
    steps: tuple[Landing, ...] = ()


class LoopTiming(Message, frozen=True, kw_only=True):
    """How well a periodic loop keeps its time, since it began.

    `late` of `count` periods began later than half a period after their time; percentiles of the
    lateness in seconds. `real_time_factor` is simulated time over wall time, 1 on hardware.
    `late_share` is of the periods since the last report. `waited_for` says whether the body's time
    waits for this loop, as a simulation's does; `missed` are the late periods that it did not wait
    for, all of them on hardware, and `missed_share` those since the last report. `pressed` asks
    whatever is not real-time to make room (`robot.bus.timing`). `pace` is simulated time over wall
    time of late.
    """

    process: str
    period_s: float
    count: int
    late: int
    p50_s: float
    p99_s: float
    p999_s: float
    max_s: float
    real_time_factor: float = 1.0
    late_share: float = 0.0
    pressed: bool = False
    waited_for: bool = False
    missed: int = 0
    missed_share: float = 0.0
    pace: float = 1.0
