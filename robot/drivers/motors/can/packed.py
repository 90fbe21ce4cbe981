"""Frames as bytes, many at once, as socketcan has them: 16 bytes each, 72 on a bus of CAN FD.

`struct can_frame` and `struct canfd_frame` begin alike, so that a classic frame on a bus of FD is
the same bytes with zeros behind.
"""

from __future__ import annotations

import struct
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.frames import MAX_DATA, MAX_FD_DATA, Frame

SIZE, FD_SIZE = 16, 72
_BEGINS = [("id", "=u4"), ("length", "u1"), ("flags", "u1"), ("pad", "u1", (2,))]
RECORD = np.dtype([*_BEGINS, ("data", "u1", (MAX_DATA,))])
FD_RECORD = np.dtype([*_BEGINS, ("data", "u1", (MAX_FD_DATA,))])
EXTENDED, REMOTE, ERROR = 0x8000_0000, 0x4000_0000, 0x2000_0000
SWITCHES_RATE, IS_FD = 0x01, 0x04
"""Among the flags (linux/can.h): data at the faster rate; that it is an FD frame."""
FD_FLAGS = SWITCHES_RATE | IS_FD
SHORT_IDS = 0x800
"""Identifiers of 11 bits without any flag are below this."""
BUS_OFF = 0x40
"""In the identifier of an error frame (linux/can/error.h)."""

Bytes: TypeAlias = npt.NDArray[np.uint8]
Records: TypeAlias = npt.NDArray[np.void]
"""Of type `RECORD`, or `FD_RECORD`."""
_LAYOUT, _FD_LAYOUT = struct.Struct("=IB3x8s"), struct.Struct("=IBB2x64s")
BUS_OFF_FRAME = _LAYOUT.pack(ERROR | BUS_OFF, MAX_DATA, bytes(MAX_DATA))


def size_on(*, is_fd: bool) -> int:
    """Bytes of every packed frame of a bus."""
    return FD_SIZE if is_fd else SIZE


def packed(frame: Frame) -> bytes:
    """A data frame as bytes."""
    number = frame.id | (EXTENDED if frame.is_extended else 0)
    if frame.is_fd:
        return _FD_LAYOUT.pack(number, len(frame.data), FD_FLAGS, frame.data)
    return _LAYOUT.pack(number, len(frame.data), frame.data)


def unpacked(data: bytes) -> Frame | None:
    """The data frame in 16 or 72 bytes; None if they are none."""
    is_fd = False
    if len(data) == FD_SIZE:
        number, length, flags, payload = _FD_LAYOUT.unpack(data)
        is_fd = bool(flags & IS_FD)
    else:
        number, length, payload = _LAYOUT.unpack(data)
    if number & (REMOTE | ERROR) or length > (MAX_FD_DATA if is_fd else MAX_DATA):
        return None
    is_extended = bool(number & EXTENDED)
    return Frame(number & ~EXTENDED, payload[:length], is_extended, is_fd)


def wide(data: bytes) -> bytes:
    """Packed frames of a classic bus as on one of FD."""
    records = np.zeros(len(data) // SIZE, FD_RECORD)
    records.view(np.uint8).reshape(-1, FD_SIZE)[:, :SIZE] = np.frombuffer(data, np.uint8).reshape(
        -1, SIZE
    )
    return records.tobytes()
