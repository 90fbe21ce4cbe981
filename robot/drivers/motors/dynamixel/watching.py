"""Looks at what servos tell, period by period, and sounds alarms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from robot.drivers.motors.alarms import Alarm, Alarms, Kind, Level
from robot.drivers.motors.dynamixel.control_table import hardware_errors
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.packets import Receiver
from robot.drivers.motors.dynamixel.reception import Reception
from robot.drivers.motors.watching import UNPLUGGED, JointAlarms
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


class Watch:
    """Of all servos of a map.

    Attributes:
        joints: what every family looks at.
    """

    def __init__(self, joints: ServoMap, alarms: Alarms) -> None:
        """Sounds these alarms."""
        self._alarms = alarms
        self._servos = list(joints.joints.values())
        self.joints = JointAlarms(joints, alarms)
        self._errors: dict[str, int] = {}
        self._noisy_s = -np.inf

    def forget(self) -> None:
        """Begin to look anew."""
        self.joints.forget()

    def unplugged(self, port: str, why: str) -> None:
        """A port went away."""
        self._alarms.sound(UNPLUGGED.alarm(port, why, "plug it in, and start again"))

    def expired(self, since_s: float) -> None:
        """Servos had no word for longer than their watchdogs: they take no goals any more."""
        text = f"no word to the servos for {1000 * since_s:.0f} ms: their watchdogs have expired"
        cure = "why was the computer busy? start again"
        self._alarms.sound(EXPIRED.alarm("servos", text, cure))

    def look(
        self, now_s: float, heard: Reception, q: Array, qd: Array, *,
        receivers: Mapping[str, Receiver],
    ) -> None:  # fmt: skip
        """A period ended.

        Args:
            now_s: when.
            heard: what servos told.
            q: angles of the joints, shape (n,).
            qd: their speeds, shape (n,).
            receivers: of the ports, which count what was spoilt.
        """
        if not heard.misses.any() and np.isfinite(heard.heard_s).all():  # nothing is bridged
            self.joints.feel(now_s, q, qd, heard.misses, heard.heard_s)
        if self.joints.are_due(
            misses=heard.misses,
            jumps=heard.jumps,
            temperature_c=heard.temperature_c,
            is_odd=bool(heard.alerts.any()),
        ):
            for index in range(len(self._servos)):
                self.joints.sound(index, self._of_one(index, heard))
        if now_s - self._noisy_s >= NOISY_S:
            self._noisy_s = now_s
            for port, receiver in receivers.items():
                self._noise(port, receiver.crc_errors + receiver.broken)

    def _of_one(self, index: int, heard: Reception) -> list[Alarm]:
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
