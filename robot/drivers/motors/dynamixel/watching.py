"""Looks at what servos tell, period by period, and sounds alarms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from robot.drivers.motors import watching
from robot.drivers.motors.alarms import Alarm, Alarms, Kind, Level
from robot.drivers.motors.dynamixel.control_table import hardware_errors
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.packets import Receiver
from robot.drivers.motors.dynamixel.reception import Reception
from robot.se3 import Array

NOISY_S, NOISY_ERRORS = 1.0, 5
"""So many spoilt packets of a port in so long."""

ALERT = Kind("alert", Level.HOLD, "a servo's alert bit: its error is asked for", "1 period")
ERROR = Kind(
    "its error",
    Level.SIT,
    "a servo reports a hardware error: voltage, heat, encoder, shock, overload",
    "2 periods",
    is_latched=True,
)
EXPIRED = Kind(
    "lost_communication",
    Level.SIT,
    "servos had no word for longer than their watchdog, and take no goals",
    "at once",
    is_latched=True,
)
NOISY = Kind(
    "noisy",
    Level.WARN,
    f"{NOISY_ERRORS} spoilt packets of a port in {NOISY_S:g} s",
    f"{NOISY_S:g} s",
)
KINDS = (ALERT, ERROR, EXPIRED, NOISY)
"""What only servos have."""


class Watch(watching.Watch[ServoMap, Reception]):
    """Of all servos of a map, and their ports."""

    unplugged_cure = "plug it in, and start again"

    def __init__(self, joints: ServoMap, alarms: Alarms, receivers: Mapping[str, Receiver]) -> None:
        """Sounds these alarms; `receivers`: of the ports, which count what was spoilt."""
        super().__init__(joints, alarms)
        self._servos, self._receivers = list(joints.joints.values()), receivers
        self._errors: dict[str, int] = {}
        self._noisy_s = -np.inf

    def expired(self, since_s: float) -> None:
        """Servos had no word for longer than their watchdogs: they take no goals any more."""
        text = f"no word to the servos for {1000 * since_s:.0f} ms: their watchdogs have expired"
        cure = "why was the computer busy? start again"
        self._alarms.sound(EXPIRED.alarm("servos", text, cure))

    def _feel(self, now_s: float, heard: Reception, q: Array, qd: Array) -> None:
        if not heard.misses.any() and np.isfinite(heard.heard_s).all():  # nothing is bridged
            super()._feel(now_s, heard, q, qd)

    def _is_odd(self, heard: Reception) -> bool:
        return bool(heard.alerts.any())

    def _of_lines(self, now_s: float, heard: Reception, *, is_armed: bool) -> None:  # noqa: ARG002
        if now_s - self._noisy_s >= NOISY_S:
            self._noisy_s = now_s
            for port, receiver in self._receivers.items():
                self._noise(port, receiver.crc_errors + receiver.broken)

    def _of_one(self, index: int, heard: Reception, *, is_armed: bool) -> list[Alarm]:  # noqa: ARG002
        one, name, looks = self._servos[index], self.joints.names[index], self.joints
        servo, cure = f"servo {one.id} on {one.port}", "check its power, its cable, and the port"
        belt = "compare its gear with the map; is its belt slack?"
        return [
            *looks.silence(index, int(heard.misses[index]), servo, f"{cure} for noise"),
            *_hardware(name, int(heard.errors[index]), is_alert=bool(heard.alerts[index])),
            *looks.heat(index, float(heard.temperature_c[index])),
            *looks.motion(index, int(heard.jumps[index]), belt),
        ]

    def _noise(self, port: str, errors: int) -> None:
        more = errors - self._errors.get(port, 0)
        self._errors[port] = errors
        if more >= NOISY_ERRORS:
            text = f"{more} spoilt packets in {NOISY_S:g} s"
            cure = "look at cable and ground; do two servos have one id?"
            self._alarms.sound(NOISY.alarm(port, text, cure))
        else:
            self._alarms.quiet("noisy", port)


def _hardware(name: str, bits: int, *, is_alert: bool) -> list[Alarm]:
    """A hardware error switches most servos off: only a reboot brings them back."""
    if not is_alert:
        return []
    cure = "find out why; then reboot it, or switch it off and on"
    if not bits:
        return [ALERT.alarm(name, "it has a hardware error to tell", cure)]
    return [
        ERROR.alarm(name, f"reports {error.replace('_', ' ')}", cure, code=error)
        for error in hardware_errors(bits)
    ]
