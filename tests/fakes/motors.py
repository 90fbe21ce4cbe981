"""A plant with motors but no physics: joints go where they are told in one step."""

import numpy as np

from robot.bus.topics import Topic
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.errors import DriverError
from robot.physics import GRAVITY_M_S2


def motor_state(q, **fields) -> MotorState:
    """A state with these joint positions; motors at rest and cool, but for what `fields` say."""
    zero = np.zeros(len(q))
    at_rest = {
        "stamp_s": 0.0, "q": q, "qd": zero, "tau": zero, "temperature_c": zero + 25.0,
        "age_s": zero, "watchdog": False, "command_stamp_s": 0.0,
    }  # fmt: skip
    return MotorState(**{**at_rest, **fields})


class FakePlant:
    """`count` motors; remembers every command. Diverges at `diverge_at_s`."""

    def __init__(self, count: int = 3, *, diverge_at_s: float = float("inf")) -> None:
        self.count = count
        self.time_ms = 0
        self.commander: object | None = None
        self.opened = 0
        self.commands: list[MotorCommand] = []
        self.due: list[tuple[Topic, object]] = []
        self.calls: list[str] = []
        self.suffered: list[object] = []
        self.heard: list[str] = []
        self.q = np.zeros(count)
        self._diverge_at_s = diverge_at_s
        self.sample = self.read()

    def open(self) -> None:
        self.opened += 1

    def close(self) -> None:
        self.opened -= 1

    def claim(self, driver: object) -> bool:
        self.commander = self.commander or driver
        return self.commander is driver

    def release(self, driver: object) -> None:
        if self.commander is driver:
            self.commander = None

    def read(self) -> BodySample:
        n = self.count
        stamp_s = self.time_ms / 1000.0
        state = motor_state(
            self.q.copy(), stamp_s=stamp_s, qd=np.arange(n) + 0.5, tau=np.arange(n) - 0.5,
            watchdog=not self.commands,
            command_stamp_s=self.commands[-1].stamp_s if self.commands else -np.inf,
        )  # fmt: skip
        imu = ImuReading(stamp_s, np.array([0.1, 0.2, 0.3]), np.array([0.0, 0.0, GRAVITY_M_S2]))
        wrenches = np.arange(24.0).reshape(2, 2, 6)
        self.sample = BodySample(state, imu, ForceReading(stamp_s, *wrenches))
        return self.sample

    def write(self, command: MotorCommand) -> MotorCommand:
        for field in (command.q_des, command.qd_des, command.tau_ff, command.kp, command.kd):
            if field.shape != (self.count,) or not np.isfinite(field).all():
                raise DriverError("bad command")
        self.commands.append(command)
        self.calls.append("write")
        return command

    def step(self, count: int = 1) -> None:
        self.time_ms += count
        self.calls.append(f"step {count}")
        if self.commands and self.commands[-1].kp.any():
            self.q = self.commands[-1].q_des.copy()
        if self.time_ms / 1000.0 >= self._diverge_at_s:
            raise DriverError("the simulated physics diverged")

    def suffer(self, fault: object) -> None:
        self.suffered.append(fault)

    def hear(self, text: str) -> None:
        self.heard.append(text)

    def sense(self, now_s: float) -> list[tuple[Topic, object]]:
        self.calls.append("sense")
        due, self.due = self.due, []
        return due


def hold(count: int, stamp_s: float, q: float = 0.0) -> MotorCommand:
    """Hold every joint at `q`."""
    return MotorCommand(
        stamp_s, np.full(count, q), np.zeros(count), np.zeros(count), np.full(count, 100.0),
        np.full(count, 2.0),
    )  # fmt: skip
