"""Frames as bytes, many at once: 16 bytes each, as socketcan's `struct can_frame` has them."""

from __future__ import annotations

import struct
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.frames import MAX_DATA, Frame

SIZE = 16
RECORD = np.dtype([("id", "=u4"), ("length", "u1"), ("pad", "u1", (3,)), ("data", "u1", (8,))])
EXTENDED, REMOTE, ERROR = 0x8000_0000, 0x4000_0000, 0x2000_0000
SHORT_IDS = 0x800
"""Identifiers of 11 bits without any flag are below this."""
BUS_OFF = 0x40
"""In the identifier of an error frame (linux/can/error.h)."""

Bytes: TypeAlias = npt.NDArray[np.uint8]
Records: TypeAlias = npt.NDArray[np.void]
"""Of type `RECORD`."""
_LAYOUT = struct.Struct("=IB3x8s")
BUS_OFF_FRAME = _LAYOUT.pack(ERROR | BUS_OFF, MAX_DATA, bytes(MAX_DATA))


def packed(frame: Frame) -> bytes:
    """A data frame as bytes."""
    number = frame.id | (EXTENDED if frame.is_extended else 0)
    return _LAYOUT.pack(number, len(frame.data), frame.data)


def unpacked(data: bytes) -> Frame | None:
    """The data frame in 16 bytes; None if they are none."""
    number, length, payload = _LAYOUT.unpack(data)
    if number & (REMOTE | ERROR) or length > MAX_DATA:
        return None
    is_extended = bool(number & EXTENDED)
    return Frame(number & ~EXTENDED, payload[:length], is_extended)
