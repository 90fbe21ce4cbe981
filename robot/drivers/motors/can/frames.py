"""CAN data frames, classic and FD, and how long they take on the wire."""

from __future__ import annotations

from typing import NamedTuple

MAX_DATA, MAX_FD_DATA = 8, 64
BITRATE_HZ = 1_000_000
"""What motors are shipped with."""
FD_SIZES = (*range(9), 12, 16, 20, 24, 32, 48, 64)
"""Bytes that an FD frame can carry (ISO 11898-1)."""
_ENDS = 13
"""Bits from the end of the CRC on, with the pause; they are not stuffed."""


class Frame(NamedTuple):
    """A data frame.

    Attributes:
        id: 11 bits, or 29 of an extended frame.
        data: up to 8 bytes; of an FD frame one of `FD_SIZES`.
        is_extended: whether its identifier has 29 bits.
        is_fd: whether it is one of CAN FD, whose data go at the faster bit rate.
    """

    id: int
    data: bytes
    is_extended: bool = False
    is_fd: bool = False


def worst_bits(data_bytes: int, *, is_extended: bool = False) -> int:
    """Bits of a frame with the most stuffing that there can be, and the pause behind it.

    Of the 34 (extended: 54) bits from the start to the CRC and the data, every fifth equal one is
    followed by another: at worst one in four after the first (ISO 11898-1, [Davis2007]). 13 bits of
    the end and the pause are not stuffed. 8 bytes: 135, extended 160.
    """
    stuffed = (54 if is_extended else 34) + 8 * data_bytes
    return stuffed + (stuffed - 1) // 4 + _ENDS


def worst_fd_bits(data_bytes: int, *, is_extended: bool = False) -> tuple[int, int]:
    """The same of an FD frame: bits at the bit rate, and bits at that of the data.

    From the start to the switch of the rate there are 17 (extended: 36) bits; then two that say how
    the sender fares and how much comes (5 bits), and the data; stuffed as above. Behind them count
    of stuff bits (4), CRC of 17 bits (21 of more than 16 bytes) and a fixed stuff bit before every
    four of these (ISO 11898-1:2015, 10.4.2). 32 bytes: 34 and 358, extended 57 and 359.
    """
    head, behind = 36 if is_extended else 17, 5 + 8 * data_bytes
    stuff_of_head = (head - 1) // 4
    stuff = (head + behind - 1) // 4 - stuff_of_head
    crc = 4 + (17 if data_bytes <= 16 else 21)
    return head + stuff_of_head + _ENDS, behind + stuff + crc + -(-crc // 4)
