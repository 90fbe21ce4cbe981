"""How full a port of servos gets, and how many ports a rate wants.

A period is one sync write of currents, one fast sync read, and its answer. An adapter on USB holds
back what is shorter than its buffer until its latency timer ends: that comes on top of the wire.
"""

from __future__ import annotations

import math

from robot.drivers.motors.dynamixel import instructions
from robot.drivers.motors.dynamixel.control_table import (
    GOAL_CURRENT,
    PRESENT_CURRENT,
    PRESENT_POSITION,
    PRESENT_TEMPERATURE,
)

BITS_A_BYTE = 10
MOST_LOAD = 0.70
"""Of a port's time; stuffed bytes and a servo that takes its time are in what is left."""
ON_TIME = 0.90
"""Of a period, by when the last answer has to be with the computer."""
TURNS_ROUND_S = 1e-4
"""From the end of a question to an answer, return delay 0; assumed."""
SHORT = PRESENT_POSITION.end - PRESENT_CURRENT.address
LONG = PRESENT_TEMPERATURE.end - PRESENT_CURRENT.address
"""Bytes that are read of each servo: in every period, and now and then with volts and heat."""


def period_bytes(servos: int, size: int = LONG) -> int:
    """How many bytes go over the wire in a period."""
    if not servos:
        return 0
    ids = range(servos)
    told = instructions.sync_write(GOAL_CURRENT.address, dict.fromkeys(ids, b"\x00\x00"))
    asked = instructions.sync_read(ids, PRESENT_CURRENT.address, size, is_fast=True)
    return len(told) + len(asked) + instructions.fast_bytes(servos, size)


def busy_s(servos: int, baud_hz: float) -> float:
    """For how long a port is busy in a period."""
    if not servos:
        return 0.0
    return period_bytes(servos) * BITS_A_BYTE / baud_hz + TURNS_ROUND_S


def load(servos: int, rate_hz: float, baud_hz: float) -> float:
    """The share of its time that a port is busy with so many servos at a rate."""
    return busy_s(servos, baud_hz) * rate_hz


def is_enough(servos: int, rate_hz: float, baud_hz: float, latency_s: float) -> bool:
    """Whether a port with so many servos keeps a rate."""
    wire_s = busy_s(servos, baud_hz)
    return wire_s * rate_hz <= MOST_LOAD and (wire_s + latency_s) * rate_hz <= ON_TIME


def most_servos(rate_hz: float, baud_hz: float, latency_s: float) -> int:
    """How many servos one port serves at a rate."""
    count = 0
    while count < 250 and is_enough(count + 1, rate_hz, baud_hz, latency_s):
        count += 1
    return count


def ports_needed(servos: int, rate_hz: float, baud_hz: float, latency_s: float) -> int:
    """How many ports so many servos want; 0 if no number of them is enough."""
    most = most_servos(rate_hz, baud_hz, latency_s)
    return math.ceil(servos / most) if most else 0


def fastest_hz(servos: int, baud_hz: float, latency_s: float) -> int:
    """The highest rate that one port keeps with so many servos."""
    wire_s = busy_s(servos, baud_hz)
    return int(min(MOST_LOAD / wire_s, ON_TIME / (wire_s + latency_s)))
