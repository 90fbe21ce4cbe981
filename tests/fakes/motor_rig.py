"""What rigs of real motors have in common: a driver, emulated motors, and simulated time."""

import itertools
import os
from collections.abc import Mapping
from typing import Any

import msgspec
import numpy as np

from robot.clock import SimulatedClock
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MotorBus, MotorCommand, MotorState
from robot.drivers.motors.motor_map import MotorMap
from robot.se3 import Array
from tests.fakes.motors import motor_state

_numbers = itertools.count()


def lines_of_its_own(lines: Mapping[str, Any], key: str) -> dict[str, Any]:
    """A line is claimed on the whole machine, where other tests run at the same time."""
    prefix = f"rig-{os.getpid()}-{next(_numbers)}"
    return {
        name: msgspec.structs.replace(line, **{key: f"{prefix}-{getattr(line, key)}"})
        for name, line in lines.items()
    }


class MotorRig:
    """Commands a driver in periods; a rig of a family has its own motors and ports."""

    KP, KD = 20.0, 1.0
    joints: MotorMap
    clock: SimulatedClock
    driver: MotorBus

    def hold(self, q: float = 0.5, *, kp: float | None = None, kd: float | None = None):
        """A command to hold a posture."""
        n = len(self.joints.joints)
        return MotorCommand(
            self.clock.now_s(), np.full(n, q), np.zeros(n), np.zeros(n),
            np.full(n, self.KP if kp is None else kp), np.full(n, self.KD if kd is None else kd),
        )  # fmt: skip

    def cycle(self, count: int = 1, command: MotorCommand | None = None, **hold) -> MotorState:
        """Write and read, so many periods."""
        for _ in range(count):
            asked = command or self.hold(**hold)
            asked.stamp_s = self.clock.now_s()
            self.driver.write(asked)
            state = self.driver.read()
        return state


def felt(
    q: Array, qd: list[float], tau: list[float], *, now_s: float, let_go: bool, told_s: float
) -> BodySample:
    """What motors of a rig measure, as a plant tells it; nothing else is felt."""
    state = motor_state(q, stamp_s=now_s, qd=np.array(qd), tau=np.array(tau), watchdog=let_go)
    state.command_stamp_s = told_s
    zero, empty = np.zeros(3), np.zeros((2, 6))
    return BodySample(state, ImuReading(now_s, zero, zero), ForceReading(now_s, empty, empty))
