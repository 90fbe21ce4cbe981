"""The board's side of its datagrams, from the table of docs/hardware.md alone, like firmware in C.

Apart from the driver's codec: fields by their offsets, one after the other.
"""

from __future__ import annotations

import binascii
import struct
from collections.abc import Sequence
from typing import NamedTuple

HELLO, STATE, COMMAND, WATCHDOG, ENABLE, DISABLE, CLEAR, ZERO = range(1, 9)
HEAD, TAIL = 28, 4
ANYBODY = 255


def crc(data: bytes) -> int:
    """CRC-32 as IEEE 802.3 has it: of "123456789" it is 0xCBF43926."""
    return binascii.crc32(data)


class Asked(NamedTuple):
    """What a board was asked."""

    kind: int
    board: int
    mask: int
    session: int
    sequence: int
    body: bytes


def asked(data: bytes) -> Asked | None:
    """What a datagram asks; None of one that is no datagram of ours."""
    if len(data) < HEAD + TAIL or data[0:4] != b"HMTR" or data[4] != 1:
        return None
    if data[10] | data[11] << 8 != len(data):
        return None
    if int.from_bytes(data[-4:], "little") != crc(data[:-4]):
        return None
    return Asked(
        kind=data[5],
        board=data[6],
        mask=data[8] | data[9] << 8,
        session=int.from_bytes(data[12:16], "little"),
        sequence=int.from_bytes(data[16:20], "little"),
        body=data[28:-4],
    )


def answer(question: Asked, *, board: int, mask: int, time_us: int, body: bytes) -> bytes:
    """What goes back."""
    length = HEAD + len(body) + TAIL
    head = bytearray(b"HMTR")
    head += bytes((1, question.kind | 0x80, board, 0, mask & 0xFF, mask >> 8))
    head += bytes((length & 0xFF, length >> 8))
    head += question.session.to_bytes(4, "little") + question.sequence.to_bytes(4, "little")
    head += (time_us % (1 << 64)).to_bytes(8, "little")
    whole = bytes(head) + body
    return whole + crc(whole).to_bytes(4, "little")


def orders(body: bytes, count: int) -> list[tuple[float, float, float, float, float]] | None:
    """Position, velocity, kp, kd, torque of so many joints; None if it is no such thing."""
    if len(body) != 20 * count:
        return None
    found: list[tuple[float, float, float, float, float]] = []
    for index in range(count):
        q, qd, kp, kd, tau = struct.unpack_from("<5f", body, 20 * index)
        found.append((q, qd, kp, kd, tau))
    return found


def joint(
    q_rad: float, qd_rad_s: float, tau_nm: float, *, celsius: float, faults: int, state: int
) -> bytes:
    """20 bytes of one joint."""
    heat = max(-32768, min(32767, int(10.0 * celsius)))
    return struct.pack("<fffhHB", q_rad, qd_rad_s, tau_nm, heat, faults, state) + b"\0\0\0"


def itself(*, obeyed: int, volts: float, celsius: float, refused: int, flags: int) -> bytes:
    """12 bytes of the board itself."""
    supply = max(0, min(65535, int(100.0 * volts)))
    return (
        struct.pack("<IHhHB", obeyed, supply, int(10.0 * celsius), refused & 0xFFFF, flags) + b"\0"
    )


def made(serial: int, firmware: int, drives: Sequence[tuple[str, Sequence[float]]]) -> bytes:
    """Who the board is: 8 bytes, and 36 for each drive: model, speed, torque, kp, kd, °C."""
    body = struct.pack("<IHBB", serial, firmware, len(drives), 0)
    for model, most in drives:
        body += model.encode("ascii")[:16].ljust(16, b"\0") + struct.pack("<5f", *most)
    return body


def floats(body: bytes) -> tuple[float, ...]:
    """Numbers of 4 bytes each."""
    return struct.unpack(f"<{len(body) // 4}f", body)


def packed_floats(values: Sequence[float]) -> bytes:
    """Numbers of 4 bytes each."""
    return struct.pack(f"<{len(values)}f", *values)
