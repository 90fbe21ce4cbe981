"""Frames between programs and emulated wires: 16 bytes each, as socketcan's `struct can_frame`.

FD frames have 72, as `struct canfd_frame`.
"""

from __future__ import annotations

import struct

from sim.devices.wire import CanFrame

SIZE, FD_SIZE = 16, 72
OFF_THE_BUS = 0x2000_0000 | 0x40
"""An error frame that says bus-off, as linux/can/error.h has it."""
_EXTENDED, _NO_DATA_FRAME = 0x8000_0000, 0x6000_0000
_LAYOUT, _FD_LAYOUT = struct.Struct("=IB3x8s"), struct.Struct("=IBBxx64s")
_BRS_AND_FDF = 0x05


def packed(frame: CanFrame) -> bytes:
    """A frame as bytes."""
    flags = _EXTENDED if frame.extended else 0
    if frame.fd:
        return _FD_LAYOUT.pack(frame.id | flags, len(frame.data), _BRS_AND_FDF, frame.data)
    return _LAYOUT.pack(frame.id | flags, len(frame.data), frame.data)


def unpacked(data: bytes) -> CanFrame | None:
    """A frame out of bytes; None if they are no data frame."""
    if len(data) == SIZE:
        number, length, payload = _LAYOUT.unpack(data)
        most, fd = 8, False
    elif len(data) == FD_SIZE:
        number, length, flags, payload = _FD_LAYOUT.unpack(data)
        fd = bool(flags & 0x04)
        most = 64 if fd else 8
    else:
        return None
    if number & _NO_DATA_FRAME or length > most:
        return None
    extended = bool(number & _EXTENDED)
    number &= 0x1FFF_FFFF if extended else 0x7FF
    return CanFrame(number, payload[:length], extended, fd)


OFF_FRAME = _LAYOUT.pack(OFF_THE_BUS, 8, bytes(8))
"""What a program is told when its controller goes off the bus."""
