"""Settings of a moteus: which are looked at before it is enabled, what they may be, which are set.

They are no registers: the motor's console says them, a line of text each (`conf get`, `conf set`).
What is set here is in force until the motor loses its power; nothing is written for ever.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Final

from robot.drivers.motors.can import moteus
from robot.drivers.motors.can.console import Needs
from robot.drivers.motors.can.moteus import TURN_RAD
from robot.drivers.motors.can.values import Ranges
from robot.drivers.motors.findings import Said

LOWEST, HIGHEST, FASTEST = "servopos.position_min", "servopos.position_max", "servo.max_velocity"
KP, KD, KI, MOST_INTEGRAL = (f"servo.pid_position.{one}" for one in ("kp", "kd", "ki", "ilimit"))
RATIO: Final = "motor_position.rotor_to_output_ratio"
AFTER_TIMEOUT: Final = "servo.timeout_mode"
TRIPS_C, BOARD_TRIPS_C = "servo.motor_fault_temperature", "servo.fault_temperature"
LOOKED_AT: Final = (
    LOWEST, HIGHEST, FASTEST, KI, MOST_INTEGRAL, RATIO, AFTER_TIMEOUT, TRIPS_C, BOARD_TRIPS_C,
)  # fmt: skip
BRAKES: Final = (12, 15)
"""What it may do after a timeout: hold its velocity at zero, or short its windings."""
RELATIVE, ROTOR = 0, 1
"""What its position is measured from, in the register "home state": nothing, or its rotor."""


def gains(ranges: Ranges) -> dict[str, float]:
    """What is set before it is enabled: what a share of 1 stands for, per revolution."""
    return {KP: ranges.kp * TURN_RAD, KD: ranges.kd * TURN_RAD}


def objections(
    registers: Mapping[int, float], settings: Mapping[str, float], needs: Needs
) -> Iterator[Said]:
    """What disagrees with what its joint needs."""
    if unread := [name for name in LOOKED_AT if name not in settings]:
        text = f"its settings {', '.join(unread)} could not be read"
        yield "settings_unread", text, "look at the bus for lost frames, update the firmware", True
        return
    low, high = settings[LOWEST], settings[HIGHEST]
    wanted = (needs.lower_rad / TURN_RAD, needs.upper_rad / TURN_RAD)
    if low > wanted[0] or high < wanted[1]:  # NaN: no bound
        text = f"its own bounds are {low:g} to {high:g} revolutions, its joint goes from"
        cure = f"conf set {LOWEST} nan, and {HIGHEST}, or mend the map's limits"
        yield "wrong_range", f"{text} {wanted[0]:.3f} to {wanted[1]:.3f}", cure, True
    if settings[FASTEST] * TURN_RAD < needs.velocity_rad_s:
        text = f"it gives less beyond {settings[FASTEST]:g} revolutions a second ({FASTEST})"
        cure = f"set that to {needs.velocity_rad_s / TURN_RAD:.2f}, or lower velocity_limit_rad_s"
        yield "wrong_range", text, cure, True
    if needs.ratio is not None and not math.isclose(settings[RATIO], needs.ratio, rel_tol=1e-3):
        text = f"its output turns {settings[RATIO]:g} times for one of its rotor, its model says"
        yield (
            "wrong_range",
            f"{text} {needs.ratio:g}",
            f"set {RATIO}, or mend the map's model",
            True,
        )
    if settings[KI] * settings[MOST_INTEGRAL] != 0.0:
        cure = f"conf set {MOST_INTEGRAL} 0"
        yield "integrates", "it adds an integral that nobody commands", cure, True
    yield from _homed(registers.get(moteus.HOMED), settings[RATIO])
    if int(settings[AFTER_TIMEOUT]) not in BRAKES:
        text = f"after a timeout it lets go ({AFTER_TIMEOUT} is {settings[AFTER_TIMEOUT]:g})"
        yield "lets_go", text, f"conf set {AFTER_TIMEOUT} 12: it then brakes", False
    hot_c = settings[TRIPS_C]
    if hot_c < needs.over_temperature_c:  # NaN: it has no thermistor
        text = f"it lets go at {hot_c:g} °C, before the map's {needs.over_temperature_c:g}"
        yield "trips_early", text, f"set over_temperature_c under {hot_c:g} in the map", False


def _homed(state: float | None, ratio: float) -> Iterator[Said]:
    """Whether it knows where its output is."""
    if state == RELATIVE:
        cure = "turn it over its index, or give it an encoder at its output"
        yield "unknown_position", "it does not know where it is: nothing is its zero", cure, True
    elif state == ROTOR and abs(ratio) < 1.0:
        turn_rad = TURN_RAD * abs(ratio)
        text = f"after power-up it knows where it is within {turn_rad:.2f} rad of its output only"
        cure = "start it in the same part of its way each time, or give its output an encoder"
        yield "within_a_turn", text, cure, False
