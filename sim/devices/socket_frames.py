"""CAN frames on a UNIX SEQPACKET socket: 16 bytes each, as socketcan's `struct can_frame`."""

from __future__ import annotations

import struct

from sim.devices.wire import CanFrame

SIZE = 16
OFF_THE_BUS = 0x2000_0000 | 0x40
"""An error frame that says bus-off, as linux/can/error.h has it."""
_EXTENDED, _NO_DATA_FRAME = 0x8000_0000, 0x6000_0000
_LAYOUT = struct.Struct("=IB3x8s")


def packed(frame: CanFrame) -> bytes:
    """A frame as bytes."""
    flags = _EXTENDED if frame.extended else 0
    return _LAYOUT.pack(frame.id | flags, len(frame.data), frame.data)


def unpacked(data: bytes) -> CanFrame | None:
    """A frame out of bytes; None if they are no data frame."""
    if len(data) != SIZE:
        return None
    number, length, payload = _LAYOUT.unpack(data)
    if number & _NO_DATA_FRAME or length > 8:
        return None
    extended = bool(number & _EXTENDED)
    number &= 0x1FFF_FFFF if extended else 0x7FF
    return CanFrame(number, payload[:length], extended)


OFF_FRAME = _LAYOUT.pack(OFF_THE_BUS, 8, bytes(8))
"""What a program is told when its controller goes off the bus."""
