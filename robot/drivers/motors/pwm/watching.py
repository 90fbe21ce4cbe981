"""Looks at how chips take what they are told, and sounds alarms. Of servos nothing is known."""

from __future__ import annotations

from robot.drivers.motors.alarms import Alarms, Kind, Level
from robot.drivers.motors.pwm.chips import Health
from robot.drivers.motors.pwm.joint_map import PulseMap

HOLD_FAILURES, DEAD_FAILURES = 3, 10
STUCK_FRAMES = 3

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
STUCK = Kind(
    "i2c_stuck",
    Level.SIT,
    f"a write has not ended for {STUCK_FRAMES} frames: somebody holds the bus",
    f"{STUCK_FRAMES} frames",
    is_latched=True,
)
RESTARTED = Kind(
    "restarted",
    Level.SIT,
    "a chip was found asleep: it was without power, and gives no pulses",
    "10 frames",
    is_latched=True,
)
KINDS = (REFUSED, DEAD, STUCK, RESTARTED)
"""What only hobby servos have, and all that they have: they measure nothing."""


class Watch:
    """Of all chips of a map."""

    def __init__(self, joints: PulseMap, alarms: Alarms) -> None:
        """Sounds these alarms."""
        self._alarms, self._map = alarms, joints

    def look(self, chip: str, health: Health) -> None:
        """A period ended."""
        alarms, where = self._alarms, self._map.chips[chip]
        cure = f"look at power and wires: i2cdetect -y {where.bus} shows who is there"
        if health.failures >= HOLD_FAILURES:
            kind = DEAD if health.failures >= DEAD_FAILURES else REFUSED
            text = f"{health.failures} writes in a row were not taken: {health.why}"
            alarms.sound(kind.alarm(chip, text, cure))
        else:
            alarms.quiet("i2c_refused", chip)
        if health.waits_s >= STUCK_FRAMES * where.frame_s:
            text = f"a write has not ended for {1000 * health.waits_s:.0f} ms"
            alarms.sound(STUCK.alarm(chip, text, "switch off what holds SDA or SCL down"))
        if health.has_restarted:
            text = "it was without power, and gives no pulses"
            alarms.sound(RESTARTED.alarm(chip, text, "look at its supply: servos draw amperes"))
