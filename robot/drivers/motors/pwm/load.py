"""How full a bus of I2C gets with the pulses of its chips."""

from __future__ import annotations

from collections.abc import Sequence

from robot.drivers.motors.pwm.pca9685 import BYTES, MOST_BLOCK

MOST_LOAD = 0.70
BITS_A_BYTE = 9
"""Eight, and whether it was taken."""
HEAD_BYTES = 2
"""Address and register, of each block."""
FRAME_BITS = 2
"""Start and stop."""


def span(channels: Sequence[int]) -> int:
    """Outputs that are written together: from the first to the last of these."""
    return max(channels) - min(channels) + 1 if channels else 0


def write_bits(channels: Sequence[int]) -> int:
    """On the wire for one frame of a chip."""
    count = span(channels)
    if not count:
        return 0
    blocks = -(-count * BYTES // MOST_BLOCK)
    return BITS_A_BYTE * (count * BYTES + blocks * HEAD_BYTES) + blocks * FRAME_BITS


def load(chips: Sequence[Sequence[int]], frame_hz: float, bus_hz: float) -> float:
    """The share of its time that a bus is busy with chips whose outputs these are."""
    return frame_hz * sum(map(write_bits, chips)) / bus_hz
