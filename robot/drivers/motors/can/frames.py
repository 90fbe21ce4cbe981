"""CAN 2.0 data frames, and how long they take on the wire."""

from __future__ import annotations

from typing import NamedTuple

MAX_DATA = 8
BITRATE_HZ = 1_000_000
"""What motors are shipped with."""


class Frame(NamedTuple):
    """A data frame.

    Attributes:
        id: 11 bits, or 29 of an extended frame.
        data: up to 8 bytes.
        is_extended: whether its identifier has 29 bits.
    """

    id: int
    data: bytes
    is_extended: bool = False


def worst_bits(data_bytes: int, *, is_extended: bool = False) -> int:
    """Bits of a frame with the most stuffing that there can be, and the pause behind it.

    Of the 34 (extended: 54) bits from the start to the CRC and the data, every fifth equal one is
    followed by another: at worst one in four after the first (ISO 11898-1, [Davis2007]). 13 bits of
    the end and the pause are not stuffed. 8 bytes: 135, extended 160.
    """
    stuffed = (54 if is_extended else 34) + 8 * data_bytes
    return stuffed + (stuffed - 1) // 4 + 13
