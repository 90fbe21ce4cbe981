"""Looks at what motors tell, period by period, and sounds alarms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from robot.drivers.motors.alarms import BY_STATUS, Alarm, Alarms, Level
from robot.drivers.motors.can.joint_map import JointMap, JointMotor
from robot.drivers.motors.can.mit11 import DISABLED, ENABLED
from robot.drivers.motors.can.reception import JUMPS_BELIEVED, Reception
from robot.drivers.motors.can.sending import TransmitQueue
from robot.drivers.motors.limiter import WARM_K
from robot.drivers.motors.speed_check import SpeedCheck
from robot.se3 import Array

SILENT_PERIODS = 3
SILENT_S = 0.020
FULL_S = 0.010
DOUBLE_PERIODS = 3
LOST = "lost_communication"
"""Which a motor tells after its controller was killed, until it is armed again."""


class Watch:
    """Of all motors of a map."""

    def __init__(self, joints: JointMap, alarms: Alarms) -> None:
        """Sounds these alarms."""
        self._alarms = alarms
        self._names = tuple(joints.joints)
        self._motors = list(joints.joints.values())
        self._hot_c: Array = np.array([one.over_temperature_c for one in self._motors])
        self._periods = max(SILENT_PERIODS + 1, round(SILENT_S / joints.period_s))
        self._troubled: set[str] = set()
        self._count = len(self._names)
        self.speeds = SpeedCheck(self._count)

    def forget(self) -> None:
        """Begin to look anew."""
        self.speeds = SpeedCheck(self._count)

    def bus_off(self, bus: str) -> None:
        """A controller took itself off its bus."""
        cure = "look for a loose or swapped wire; ip link set CHANNEL type can restart-ms 100"
        self._alarms.sound(
            Alarm("bus_off", bus, Level.SIT, "the bus is off", cure, is_latched=True)
        )

    def unplugged(self, bus: str, why: str) -> None:
        """The interface of a bus went away."""
        cure = "plug it in, see that it is up (ip link show), and start again"
        self._alarms.sound(Alarm("unplugged", bus, Level.SIT, why, cure, is_latched=True))

    def look(
        self,
        now_s: float,
        heard: Reception,
        q: Array,
        qd: Array,
        queues: Mapping[str, TransmitQueue],
        *,
        is_armed: bool,
    ) -> None:
        """A period ended.

        Args:
            now_s: when.
            heard: what motors told.
            q: angles of the joints, shape (n,).
            qd: their speeds, shape (n,).
            queues: of the buses.
            is_armed: whether the motors were enabled from here.
        """
        self.speeds.feel(now_s, q, qd)
        late = heard.misses.any()
        odd = (
            late
            or self.speeds.wrong.any()
            or bool(np.fmax.reduce(heard.temperature_c - self._hot_c) > -WARM_K)
            or heard.jumps.any()
            or heard.doubles.any()
            or (heard.status != ENABLED).any()
        )
        if odd or self._troubled:
            for index, name in enumerate(self._names):
                self._one(index, name, heard, is_armed=is_armed)
        for queue in queues.values():
            self._queue(queue, now_s)

    def _one(self, index: int, name: str, heard: Reception, *, is_armed: bool) -> None:
        one = self._motors[index]
        alarms = [
            *self._silence(index, name, one, heard, is_armed=is_armed),
            *self._status(int(heard.status[index]), name, one, is_armed=is_armed),
            *self._heat(float(heard.temperature_c[index]), name, one),
        ]
        if self.speeds.wrong[index]:
            text = f"its speed is {self.speeds.ratio[index]:.2f} times that of its positions"
            cure = "compare its velocity range (register 22) and gear with the map"
            alarms.append(Alarm("speed_mismatch", name, Level.HOLD, text, cure))
        if heard.jumps[index] >= JUMPS_BELIEVED:
            text = f"its position jumped, {heard.jumps[index]} times in a row"
            cure = "look at its encoder and its power"
            alarms.append(Alarm("encoder_jump", name, Level.SIT, text, cure, is_latched=True))
        if is_armed and heard.doubles[index] >= DOUBLE_PERIODS:  # else others may have commanded
            text = f"more than one motor answers as {one.answers_as} on {one.bus}"
            alarms.append(Alarm("duplicate_id", name, Level.HOLD, text, "give each its own id"))
        for alarm in alarms:
            self._alarms.sound(alarm)
        sounding = {alarm.code for alarm in alarms}
        for alarm in self._alarms.on:
            if alarm.who == name and alarm.code not in sounding:
                self._alarms.quiet(alarm.code, name)
        if alarms:
            self._troubled.add(name)
        else:
            self._troubled.discard(name)

    def _silence(
        self, index: int, name: str, one: JointMotor, heard: Reception, *, is_armed: bool
    ) -> list[Alarm]:
        misses = int(heard.misses[index])
        waits = not is_armed and one.family.asking is None  # it answers to commands only
        if misses < SILENT_PERIODS or waits:
            return []
        text = f"silent for {misses} periods (motor {one.id} on {one.bus})"
        cure = "check its power, its cable, and its bus for errors"
        if misses < self._periods:
            return [Alarm("silent", name, Level.HOLD, text, cure)]
        return [Alarm("silent", name, Level.SIT, text, cure, is_latched=True)]

    def _status(self, code: int, name: str, one: JointMotor, *, is_armed: bool) -> list[Alarm]:
        status = one.family.status(code)
        usual = code == DISABLED or status.code == LOST
        if code == ENABLED or (usual and not is_armed):
            return []
        level = BY_STATUS.get(status.code, Level.SIT)
        cure = status.cure or "somebody else disabled it"
        text = f"reports {status.code.replace('_', ' ')}"
        return [Alarm(status.code, name, level, text, cure, is_latched=level >= Level.SIT)]

    def _heat(self, celsius: float, name: str, one: JointMotor) -> list[Alarm]:
        if not celsius > one.over_temperature_c - WARM_K:
            return []
        text = f"{celsius:.0f} °C of {one.over_temperature_c:g}: less torque"
        return [Alarm("warm", name, Level.DERATE, text, "let it rest")]

    def _queue(self, queue: TransmitQueue, now_s: float) -> None:
        if queue.full_since_s is not None and now_s - queue.full_since_s >= FULL_S:
            text = f"its queue takes nothing, {queue.replaced} old commands were dropped"
            cure = "are its motors powered? is it terminated?"
            self._alarms.sound(Alarm("queue_full", queue.bus, Level.WARN, text, cure))
        elif queue.full_since_s is None:
            self._alarms.quiet("queue_full", queue.bus)
