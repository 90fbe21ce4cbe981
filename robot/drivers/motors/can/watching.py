"""Looks at what motors tell, period by period, and sounds alarms."""

from __future__ import annotations

from collections.abc import Mapping

from robot.drivers.motors import watching
from robot.drivers.motors.alarms import BY_STATUS, Alarm, Alarms, Kind, Level
from robot.drivers.motors.can.joint_map import JointMap, JointMotor
from robot.drivers.motors.can.reception import Reception
from robot.drivers.motors.can.sending import TransmitQueue
from robot.drivers.motors.can.values import DISABLED, ENABLED
from robot.drivers.motors.watching import IMPOSSIBLE

FULL_S = 0.010
DOUBLE_PERIODS = 3
LOST = "lost_communication"
"""Which a motor tells after its controller was killed, until it is armed again."""

STRAINED = Kind(
    "its status",
    Level.HOLD,
    f"a motor reports {', '.join(BY_STATUS).replace('_', '-')}",
    "1 period",
)
FAULT = Kind(
    "its status",
    Level.SIT,
    "a motor reports another fault, an unknown status, or that somebody disabled it",
    "1 period",
    is_latched=True,
)
BUS_OFF = Kind("bus_off", Level.SIT, "a bus is off; the others go on", "at once", is_latched=True)
TWIN = Kind(
    "duplicate_id",
    Level.HOLD,
    f"two replies a period to one identifier, {DOUBLE_PERIODS} periods in a row",
    f"{DOUBLE_PERIODS} periods",
)
QUEUE_FULL = Kind(
    "queue_full",
    Level.WARN,
    "an interface takes nothing; what waits is replaced by what is newer, and never queued",
    f"{1000 * FULL_S:g} ms",
)
KINDS = (STRAINED, FAULT, BUS_OFF, TWIN, IMPOSSIBLE, QUEUE_FULL)
"""What only motors on CAN have."""


class Watch(watching.Watch[JointMap, Reception]):
    """Of all motors of a map, and their buses."""

    unplugged_cure = "plug it in, see that it is up (ip link show), and start again"

    def __init__(
        self, joints: JointMap, alarms: Alarms, queues: Mapping[str, TransmitQueue]
    ) -> None:
        """Sounds these alarms; `queues`: of the buses."""
        super().__init__(joints, alarms)
        self._motors, self._queues = list(joints.joints.values()), queues

    def bus_off(self, bus: str) -> None:
        """A controller took itself off its bus."""
        cure = "look for a loose or swapped wire; ip link set CHANNEL type can restart-ms 100"
        self._alarms.sound(BUS_OFF.alarm(bus, "the bus is off", cure))

    def _is_odd(self, heard: Reception) -> bool:
        return bool(heard.doubles.any()) or bool((heard.status != ENABLED).any())

    def _of_one(self, index: int, heard: Reception, *, is_armed: bool) -> list[Alarm]:
        one, name, looks = self._motors[index], self.joints.names[index], self.joints
        alarms: list[Alarm] = []
        if is_armed or one.family.asking is not None:  # else it answers to commands only
            motor, cure = f"motor {one.id} on {one.bus}", "check its power, its cable, and its bus"
            misses = int(heard.misses[index])
            alarms += looks.silence(index, misses, motor, f"{cure} for errors")
        alarms += self._status(int(heard.status[index]), name, one, is_armed=is_armed)
        alarms += looks.heat(index, float(heard.temperature_c[index]))
        cure = "compare its velocity range (a Damiao's register 22) and gear with the map"
        alarms += looks.motion(index, int(heard.jumps[index]), cure)
        if is_armed and heard.doubles[index] >= DOUBLE_PERIODS:  # else others may have commanded
            text = f"more than one motor answers as {one.answers_as} on {one.bus}"
            alarms.append(TWIN.alarm(name, text, "give each its own id"))
        return alarms

    def _status(self, code: int, name: str, one: JointMotor, *, is_armed: bool) -> list[Alarm]:
        status = one.family.status(code)
        usual = code == DISABLED or status.code == LOST
        if code == ENABLED or (usual and not is_armed):
            return []
        kind = STRAINED if status.code in BY_STATUS else FAULT
        cure = status.cure or "somebody else disabled it"
        text = f"reports {status.code.replace('_', ' ')}"
        return [kind.alarm(name, text, cure, code=status.code)]

    def _of_lines(self, now_s: float, heard: Reception, *, is_armed: bool) -> None:  # noqa: ARG002
        for queue in self._queues.values():
            self._queue(queue, now_s)

    def _queue(self, queue: TransmitQueue, now_s: float) -> None:
        if queue.full_since_s is not None and now_s - queue.full_since_s >= FULL_S:
            text = f"its queue takes nothing, {queue.replaced} old commands were dropped"
            cure = "are its motors powered? is it terminated?"
            self._alarms.sound(QUEUE_FULL.alarm(queue.bus, text, cure))
        elif queue.full_since_s is None:
            self._alarms.quiet("queue_full", queue.bus)
