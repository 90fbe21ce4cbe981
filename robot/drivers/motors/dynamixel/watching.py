"""Looks at what servos tell, period by period, and sounds alarms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from robot.drivers.motors.alarms import Alarm, Alarms, Level
from robot.drivers.motors.dynamixel.control_table import hardware_errors
from robot.drivers.motors.dynamixel.joint_map import JointServo, ServoMap
from robot.drivers.motors.dynamixel.packets import Receiver
from robot.drivers.motors.dynamixel.reception import JUMPS_BELIEVED, Reception
from robot.drivers.motors.limiter import WARM_K
from robot.drivers.motors.speed_check import SpeedCheck
from robot.se3 import Array

SILENT_PERIODS = 3
SILENT_S = 0.020
NOISY_S, NOISY_ERRORS = 1.0, 5
"""So many spoilt packets of a port in so long."""


class Watch:
    """Of all servos of a map."""

    def __init__(self, joints: ServoMap, alarms: Alarms) -> None:
        """Sounds these alarms."""
        self._alarms, self._joints = alarms, joints
        self._names = tuple(joints.joints)
        self._servos = list(joints.joints.values())
        self._hot_c: Array = np.array([one.over_temperature_c for one in self._servos])
        self._periods = max(SILENT_PERIODS + 1, round(SILENT_S / joints.period_s))
        self._troubled: set[str] = set()
        self._errors: dict[str, int] = {}
        self._noisy_s = -np.inf
        self.speeds = SpeedCheck(len(self._names))

    def forget(self) -> None:
        """Begin to look anew."""
        self.speeds = SpeedCheck(len(self._names))

    def unplugged(self, port: str, why: str) -> None:
        """A port went away."""
        cure = "plug it in, and start again"
        self._alarms.sound(Alarm("unplugged", port, Level.SIT, why, cure, is_latched=True))

    def expired(self, since_s: float) -> None:
        """Servos had no word for longer than their watchdogs: they take no goals any more."""
        text = f"no word to the servos for {1000 * since_s:.0f} ms: their watchdogs have expired"
        cure = "why was the computer busy? start again"
        self._alarms.sound(
            Alarm("lost_communication", "servos", Level.SIT, text, cure, is_latched=True)
        )

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
            self.speeds.feel(now_s, q, qd)
        odd = (
            heard.misses.any()
            or self.speeds.wrong.any()
            or bool(np.fmax.reduce(heard.temperature_c - self._hot_c) > -WARM_K)
            or heard.jumps.any()
            or heard.alerts.any()
        )
        if odd or self._troubled:
            for index, name in enumerate(self._names):
                self._one(index, name, heard)
        if now_s - self._noisy_s >= NOISY_S:
            self._noisy_s = now_s
            for port, receiver in receivers.items():
                self._noise(port, receiver.crc_errors + receiver.broken)

    def _one(self, index: int, name: str, heard: Reception) -> None:
        one = self._servos[index]
        alarms = [
            *self._silence(int(heard.misses[index]), name, one),
            *_hardware(name, int(heard.errors[index]), is_alert=bool(heard.alerts[index])),
            *self._heat(float(heard.temperature_c[index]), name, one),
        ]
        if self.speeds.wrong[index]:
            text = f"its speed is {self.speeds.ratio[index]:.2f} times that of its positions"
            cure = "compare its gear with the map; is its belt slack?"
            alarms.append(Alarm("speed_mismatch", name, Level.HOLD, text, cure))
        if heard.jumps[index] >= JUMPS_BELIEVED:
            text = f"its position jumped, {heard.jumps[index]} times in a row"
            cure = "look at its encoder and its power"
            alarms.append(Alarm("encoder_jump", name, Level.SIT, text, cure, is_latched=True))
        for alarm in alarms:
            self._alarms.sound(alarm)
        sounding = {alarm.code for alarm in alarms}
        for alarm in self._alarms.on:
            if alarm.who == name and alarm.code not in sounding:
                self._alarms.quiet(alarm.code, name)
        (self._troubled.add if alarms else self._troubled.discard)(name)

    def _silence(self, misses: int, name: str, one: JointServo) -> list[Alarm]:
        if misses < SILENT_PERIODS:
            return []
        text = f"silent for {misses} periods (servo {one.id} on {one.port})"
        cure = "check its power, its cable, and the port for noise"
        if misses < self._periods:
            return [Alarm("silent", name, Level.HOLD, text, cure)]
        return [Alarm("silent", name, Level.SIT, text, cure, is_latched=True)]

    def _heat(self, celsius: float, name: str, one: JointServo) -> list[Alarm]:
        if not celsius > one.over_temperature_c - WARM_K:
            return []
        text = f"{celsius:.0f} °C of {one.over_temperature_c:g}: less torque"
        return [Alarm("warm", name, Level.DERATE, text, "let it rest")]

    def _noise(self, port: str, errors: int) -> None:
        more = errors - self._errors.get(port, 0)
        self._errors[port] = errors
        if more >= NOISY_ERRORS:
            text = f"{more} spoilt packets in {NOISY_S:g} s"
            cure = "look at cable and ground; do two servos have one id?"
            self._alarms.sound(Alarm("noisy", port, Level.WARN, text, cure))
        else:
            self._alarms.quiet("noisy", port)


def _hardware(name: str, bits: int, *, is_alert: bool) -> list[Alarm]:
    """A hardware error switches most servos off: only a reboot brings them back."""
    if not is_alert:
        return []
    cure = "find out why; then reboot it, or switch it off and on"
    if not bits:
        return [Alarm("alert", name, Level.HOLD, "it has a hardware error to tell", cure)]
    return [
        Alarm(error, name, Level.SIT, f"reports {error.replace('_', ' ')}", cure, is_latched=True)
        for error in hardware_errors(bits)
    ]
