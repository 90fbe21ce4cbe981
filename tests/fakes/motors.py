"""A plant with motors but no physics: joints go where they are told in one step."""

import numpy as np

from robot.drivers.motors import MotorCommand, MotorState
from robot.errors import DriverError
from robot.physics import GRAVITY_M_S2


class FakePlant:
    """`count` motors; remembers every command. Diverges at `diverge_at_s`."""

    def __init__(self, count: int = 3, *, diverge_at_s: float = float("inf")) -> None:
        self.count = count
        self.time_ms = 0
        self.commands: list[MotorCommand] = []
        self.due: list[tuple[str, object]] = []
        self.calls: list[str] = []
        self.suffered: list[object] = []
        self.q = np.zeros(count)
        self._diverge_at_s = diverge_at_s

    def read(self) -> MotorState:
        n = self.count
        stamp_s = self.time_ms / 1000.0
        return MotorState(
            stamp_s=stamp_s,
            q=self.q.copy(),
            qd=np.arange(n) + 0.5,
            tau=np.arange(n) - 0.5,
            temperature_c=np.full(n, 25.0),
            gyro_rad_s=np.array([0.1, 0.2, 0.3]),
            accel_m_s2=np.array([0.0, 0.0, GRAVITY_M_S2]),
            ankle_wrench=np.arange(12.0).reshape(2, 6),
            wrist_wrench=np.arange(12.0, 24.0).reshape(2, 6),
            watchdog=not self.commands,
            command_stamp_s=self.commands[-1].stamp_s if self.commands else -np.inf,
        )

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

    def sense(self, now_s: float) -> list[tuple[str, object]]:
        self.calls.append("sense")
        due, self.due = self.due, []
        return due


def hold(count: int, stamp_s: float, q: float = 0.0) -> MotorCommand:
    """Hold every joint at `q`."""
    return MotorCommand(
        stamp_s, np.full(count, q), np.zeros(count), np.zeros(count), np.full(count, 100.0),
        np.full(count, 2.0),
    )  # fmt: skip
