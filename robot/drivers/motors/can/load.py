"""How full a bus gets, and how many buses a rate wants."""

from __future__ import annotations

import math

from robot.drivers.motors.can.frames import MAX_DATA, worst_bits

MOST_LOAD = 0.70
"""Of a bus: above it, a frame that has to be sent again makes the last replies of a period late."""


def pair_s(*, is_extended: bool, bitrate_hz: float) -> float:
    """How long a command and its reply hold a bus, with the most stuffing that there can be."""
    return 2 * worst_bits(MAX_DATA, is_extended=is_extended) / bitrate_hz


def load(joints: int, rate_hz: float, *, is_extended: bool, bitrate_hz: float) -> float:
    """The share of its time that a bus is busy with so many joints, each commanded at a rate."""
    return joints * rate_hz * pair_s(is_extended=is_extended, bitrate_hz=bitrate_hz)


def most_joints(rate_hz: float, *, is_extended: bool, bitrate_hz: float) -> int:
    """How many joints one bus serves at a rate."""
    each = load(1, rate_hz, is_extended=is_extended, bitrate_hz=bitrate_hz)
    return int(MOST_LOAD / each + 1e-9)


def buses_needed(joints: int, rate_hz: float, *, is_extended: bool, bitrate_hz: float) -> int:
    """How many buses so many joints want at a rate; 0 if no number of them is enough."""
    most = most_joints(rate_hz, is_extended=is_extended, bitrate_hz=bitrate_hz)
    return math.ceil(joints / most) if most else 0
