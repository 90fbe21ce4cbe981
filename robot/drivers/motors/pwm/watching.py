"""Looks at how chips take what they are told, and sounds alarms. Of servos nothing is known."""

from __future__ import annotations

from robot.drivers.motors import watching
from robot.drivers.motors.alarms import Alarm, Alarms, Kind, Level
from robot.drivers.motors.heard import Heard
from robot.drivers.motors.pwm.chips import Chips, Health
from robot.drivers.motors.pwm.joint_map import PulseMap

HOLD_FAILURES, DEAD_FAILURES = 3, 10
SLOW_FRAMES, STUCK_S = 3, 0.5
"""A busy computer lets a thread wait for some frames; Linux gives a held bus up after 1 s."""

REFUSED = Kind(
    "i2c_refused",
    Level.HOLD,
    f"a chip did not take {HOLD_FAILURES} writes in a row",
    f"{HOLD_FAILURES} frames",
)
DEAD = Kind(
    "i2c_refused",
    Level.SIT,
    f"a chip did not take {DEAD_FAILURES} writes in a row: its servos pulse as they were told last",
    f"{DEAD_FAILURES} frames",
    is_latched=True,
)
SLOW = Kind(
    "i2c_stuck",
    Level.HOLD,
    f"a write has not ended for {SLOW_FRAMES} frames",
    f"{SLOW_FRAMES} frames",
)
STUCK = Kind(
    "i2c_stuck",
    Level.SIT,
    f"a write has not ended for {STUCK_S:g} s: somebody holds the bus",
    f"{STUCK_S:g} s",
    is_latched=True,
)
RESTARTED = Kind(
    "restarted",
    Level.SIT,
    "a chip was found asleep: it was without power, and gives no pulses",
    "10 frames",
    is_latched=True,
)
KINDS = (REFUSED, DEAD, SLOW, STUCK, RESTARTED)
"""What only hobby servos have, and all that they have: they measure nothing."""


class Watch(watching.Watch[PulseMap, Heard]):
    """Of all chips of a map."""

    def __init__(self, joints: PulseMap, alarms: Alarms, chips: Chips) -> None:
        """Sounds these alarms; `chips` say how they are."""
        super().__init__(joints, alarms)
        self._chips = chips
        self._ours = [chip for chip in joints.chips if joints.on(chip)]

    def _is_odd(self, heard: Heard) -> bool:  # noqa: ARG002
        return False

    def _of_one(self, index: int, heard: Heard, *, is_armed: bool) -> list[Alarm]:  # noqa: ARG002
        return []

    def _of_lines(self, now_s: float, heard: Heard, *, is_armed: bool) -> None:  # noqa: ARG002
        for chip in self._ours:
            self._look(chip, self._chips.health(chip))

    def _look(self, chip: str, health: Health) -> None:
        alarms, where = self._alarms, self._map.chips[chip]
        cure = f"look at power and wires: i2cdetect -y {where.bus} shows who is there"
        if health.failures >= HOLD_FAILURES:
            kind = DEAD if health.failures >= DEAD_FAILURES else REFUSED
            text = f"{health.failures} writes in a row were not taken: {health.why}"
            alarms.sound(kind.alarm(chip, text, cure))
        else:
            alarms.quiet("i2c_refused", chip)
        if health.waits_s >= SLOW_FRAMES * where.frame_s:
            kind = STUCK if health.waits_s >= STUCK_S else SLOW
            text = f"a write has not ended for {1000 * health.waits_s:.0f} ms"
            alarms.sound(kind.alarm(chip, text, "switch off what holds SDA or SCL down"))
        else:
            alarms.quiet("i2c_stuck", chip)
        if health.has_restarted:
            text = "it was without power, and gives no pulses"
            alarms.sound(RESTARTED.alarm(chip, text, "look at its supply: servos draw amperes"))
