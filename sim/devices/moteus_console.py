"""The console of an emulated moteus: settings, asked for and set by lines of text."""

from __future__ import annotations

import math
from collections.abc import Callable

DELIVERED: dict[str, float] = {
    "id.id": 1, "servo.pid_position.kp": 4.0, "servo.pid_position.ki": 1.0,
    "servo.pid_position.kd": 0.05, "servo.pid_position.ilimit": 0.0, "servo.max_velocity": 500.0,
    "servo.default_timeout_s": 0.1, "servo.timeout_mode": 12, "servo.timeout_max_torque_Nm": 5.0,
    "servo.fault_temperature": 75.0, "servo.motor_fault_temperature": math.nan,
    "servo.enable_motor_temperature": 0, "servopos.position_min": math.nan,
    "servopos.position_max": math.nan, "motor_position.rotor_to_output_ratio": 1.0,
    "motor_position.output.offset": 0.0,
}  # fmt: skip
"""Settings as a motor has them that somebody calibrated, and whose gains nobody touched."""


class MotorConsole:
    """Lines in, lines out.

    Attributes:
        settings: by name; lost without power, but for what was written.
        written: those that were kept.
    """

    def __init__(self, position_turns: Callable[[], float]) -> None:
        """Of a motor at a position."""
        self.settings = dict(DELIVERED)
        self.settings |= {
            "servo.enable_motor_temperature": 1, "servo.motor_fault_temperature": 100.0,
        }  # fmt: skip
        self.written = dict(self.settings)
        self._position_turns = position_turns
        self._in, self._out = b"", b""

    def __getitem__(self, name: str) -> float:
        """A setting."""
        return self.settings[name]

    def hear(self, data: bytes) -> None:
        """Take bytes; what is a line is done."""
        self._in += data
        while b"\n" in self._in:
            line, self._in = self._in.split(b"\n", 1)
            words = line.decode("latin1").split()
            if words:
                self._out += (self._do(words) + "\r\n").encode("latin1")

    def say(self, most: int) -> bytes:
        """What it has to say, so many bytes at most."""
        said, self._out = self._out[: max(0, most)], self._out[max(0, most) :]
        return said

    def _do(self, words: list[str]) -> str:
        match words:
            case ["conf", "get", name]:
                if name not in self.settings:
                    return "ERR error reading"
                value = self.settings[name]
                whole = isinstance(value, int)
                return str(value) if whole else f"{value:f}"
            case ["conf", "set", name, value]:
                return self._set(name, value)
            case ["conf", "write"]:
                self.written = dict(self.settings)
                return "OK"
            case ["conf", "load"]:
                self.settings = dict(self.written)
                return "OK"
            case ["d", "cfg-set-output", value]:
                ahead = self._position_turns() - float(value)
                self.settings["motor_position.output.offset"] -= ahead
                return "OK"
            case _:
                return "unknown command"

    def _set(self, name: str, value: str) -> str:
        if name not in self.settings:
            return "ERR error setting"
        try:
            self.settings[name] = float(value)
        except ValueError:
            return "ERR error setting"
        return "OK"
