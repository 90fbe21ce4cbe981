"""What a simulated robot's own senses say while it is led through a world, as arrays.

The arrays are those that commands on recordings read (docs/localisation.md,
docs/state_estimation.md, docs/perception.md), so that whoever has no robot can try these, and knows
how far off they are: the truth is recorded beside them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from executive.meaning.request import Setting
from executive.runs.lidar_maps import led_walk
from robot.bringup.body_log import BodyLog
from robot.bringup.fast import FastRuntime
from robot.bus.bus import LocalBus
from robot.errors import ConfigError, Problem
from robot.files.archives import Plain
from robot.messages import LidarScan
from robot.se3 import Array

CM_PER_M = 100.0
NO_RETURN_CM = 8190.0
"""Readers take 8100 and more for no return (docs/localisation.md)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedWalk:
    """One walk; the rows of `legs` and `truth` are of the same instants.

    Attributes:
        legs: joints, IMU and forces under the feet, a row a period of the controller.
        lidar: scans, with odometry at each.
        truth: t [s], x, y, z [m], qw, qx, qy, qz of the base, shape (n, 8).
    """

    legs: dict[str, Plain]
    lidar: dict[str, Plain]
    truth: Array


def record(
    there: Setting, *, seed: int, longest_s: float, tell: Callable[[str], None]
) -> RecordedWalk:
    """Lead a robot through its world, and write down what it feels and sees on the way.

    Args:
        there: robot, world and reality.
        seed: of everything random.
        longest_s: of robot time; it finishes the way to the place that it is on.
        tell: hears how it gets on.

    Raises:
        ConfigError: the robot cannot be used there, or has no lidar that saw anything.
    """
    bus = LocalBus()
    log, felt = led_walk.Log(there, bus), BodyLog()
    with FastRuntime(
        there.world, there.robot_name, seed=seed, bus=bus, on_sample=felt.take
    ) as runtime:
        led_walk.lead(runtime, there, seed=seed, longest_s=longest_s, on_tick=log.take, tell=tell)
    if not log.scans or not felt.stamps_s:
        raise ConfigError([Problem("the robot's lidar saw nothing to record")])
    odometry = np.stack([sweep.odometry for sweep in log.sweeps])
    return RecordedWalk(
        legs=felt.arrays([motor.joint for motor in there.description.motors.values()]),
        lidar=_lidar(log.scans, odometry),
        truth=felt.truth(),
    )


def _lidar(scans: list[LidarScan], odometry: Array) -> dict[str, Plain]:
    """The fields of `robot.fusion.slam.recording`; people are looked for in the same."""
    ranges_cm = CM_PER_M * np.array([scan.ranges_m for scan in scans])
    ranges_cm[~(ranges_cm < NO_RETURN_CM)] = NO_RETURN_CM
    return {
        "t": np.array([scan.stamp_s for scan in scans]),
        "odom": odometry,
        "ranges_cm": np.round(ranges_cm, 1),
        "angle_min": np.array(scans[0].angle_min_rad),
        "angle_inc": np.array(scans[0].angle_step_rad),
    }
