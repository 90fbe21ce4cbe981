"""What becomes of a robot when something goes wrong, as tables for `docs/safety.md`.

Every figure is the constant that the code goes by; a row without one of them is not written here.
"""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from robot.bringup.motor_families import FAMILIES
from robot.control import imu_watch, limits, lowering, main, starting
from robot.control.loop import BUS_PERIOD_S
from robot.drivers.motors import motor_map, watching
from robot.drivers.motors.alarms import DOES, Kind, Level
from robot.drivers.motors.can import watching as can_watching
from robot.drivers.motors.dynamixel import watching as servo_watching
from robot.drivers.motors.ethernet import watching as board_watching
from robot.drivers.motors.pwm import watching as pulse_watching
from robot.fusion import base_state
from robot.owner import reactions

Rows: TypeAlias = list[list[str]]

KINDS: dict[str, tuple[Kind, ...]] = {
    "any": watching.KINDS,
    "CAN": can_watching.KINDS,
    "Dynamixel": servo_watching.KINDS,
    "Ethernet": board_watching.KINDS,
    "PWM": pulse_watching.KINDS,
}


def levels() -> Rows:
    """Levels of alarms: name, what the robot does."""
    return [[level.name, DOES[level]] for level in Level]


def alarms() -> Rows:
    """Alarms of motors, the mildest first: family, what happened, code, level, within."""
    rows = [(kind.level, family, kind) for family, kinds in KINDS.items() for kind in kinds]
    return [
        [
            family,
            kind.when,
            f"`{kind.code}`" if " " not in kind.code else kind.code,
            f"{level.name}, latched" if kind.is_latched else level.name,
            kind.within,
        ]
        for level, family, kind in sorted(rows, key=lambda row: row[0])
    ]


def owner() -> Rows:
    """What the owner of the buses does alone, the mildest first: when, code, level, how it ends."""
    return [
        [row.when, f"`{row.code}`", _level(row), _ends(row)]
        for row in sorted(reactions.ROWS, key=lambda row: row.level)
    ]


def _level(row: reactions.Row) -> str:
    return f"{row.level.name}, latched" if row.is_latched else row.level.name


def _ends(row: reactions.Row) -> str:
    """What ends it. No reset is taken while torque is given."""
    if not row.is_latched:
        return "by the next command"
    return "by a person's reset, once it is over" if row.refuses_reset else "by a person's reset"


def watchdogs() -> Rows:
    """Of motors' own firmware: family, a map's usual time, the least that a map may say."""
    return [
        [
            family.title,
            f"{1000 * usual_s:g} ms" if usual_s else "none: they go on with their last pulse",
            f"{motor_map.WATCHDOG_PERIODS} periods" if usual_s else "-",
        ]
        for family in FAMILIES
        for usual_s in (_usual(family.of.map, "watchdog_s"),)
    ]


def _usual(kind: type[motor_map.MotorMap], field: str) -> float:
    """What a map says that says nothing of a field."""
    return next(float(one.default) for one in msgspec.structs.fields(kind) if one.name == field)


def controller() -> Rows:
    """What the controller does by itself: what happened, what it does, within."""
    period_ms = 1000 * BUS_PERIOD_S
    overspeed_ms = period_ms * limits.OVERSPEED_CYCLES
    many = limits.REFUSALS_TO_DAMP
    return [
        [
            "an alarm of a motor at SIT",
            f"squats to {100 * lowering.LOW_SHARE:g} % of its height (from a walk, after the "
            "step), stays there, refuses orders to its legs; until it is started anew",
            f"{period_ms:g} ms",
        ],
        [
            f"no new reading of the IMU for {1000 * imu_watch.SILENT_S:g} ms; the same numbers for "
            f"{1000 * imu_watch.FROZEN_S:g} ms; {imu_watch.NO_NUMBERS} readings in a row that are "
            "no numbers",
            "the same (`imu_fault`): its legs alone tell how it turns; where no foot bears it for "
            f"{1000 * base_state.LOST_S:g} ms, it damps",
            f"{1000 * imu_watch.SILENT_S + period_ms:g}; {1000 * imu_watch.FROZEN_S + period_ms:g}"
            f"; {imu_watch.NO_NUMBERS * period_ms:g} ms",
        ],
        [
            "a command past a limit of position, speed or torque",
            "clamps it, and counts",
            f"{period_ms:g} ms",
        ],
        [
            "a command that is not finite",
            f"sends the last good one; damps at {many} in a row, latched",
            f"{period_ms:g} ms; {many * period_ms:g} ms",
        ],
        [
            f"a joint faster than {limits.OVERSPEED:g} times its limit, fingers excepted, "
            f"{limits.OVERSPEED_CYCLES} periods in a row",
            "damps, latched until it is told to stand",
            f"{overspeed_ms:g} ms",
        ],
        [
            f"the controller itself stood still for more than {main.PAUSE_S:g} s",
            "damps, latched until it is told to stand",
            "its first period",
        ],
        [
            "it takes over from a controller that died, "
            f"no more than {1000 * starting.TAKE_OVER_S:g} ms ago, feet on the floor",
            "holds the robot up where it is; later than that, or down, it damps",
            "its first period",
        ],
    ]
