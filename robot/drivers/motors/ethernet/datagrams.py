"""Datagrams to and from boards of motors: a layout of our own, byte by byte in docs/hardware.md.

Pure functions; nothing here knows a socket, a clock, or which joint is whose.

    28 bytes of header | a record for each joint that its mask names, by slot | CRC-32

all little endian. What cannot be told apart from noise is refused, each with its reason.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Iterator
from enum import IntEnum
from typing import Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

MAGIC, VERSION = b"HMTR", 1
MOST_SLOTS = 16
"""Joints of one board: as many as its mask has bits."""
HEADER = struct.Struct("<4sBBBxHHIIQ")
CRC = struct.Struct("<I")
LEAST = HEADER.size + CRC.size
MOST = 1472
"""Bytes that fit a frame of Ethernet behind IPv4 and UDP; none of ours is longer."""
ANSWER = 0x80

TURN = 1 << 32


class Kind(IntEnum):
    """What a datagram asks for; its answer has the same number with bit 7 set."""

    HELLO = 1
    STATE = 2
    COMMAND = 3
    WATCHDOG = 4
    ENABLE = 5
    DISABLE = 6
    CLEAR = 7
    ZERO = 8


class State(IntEnum):
    """What a joint's drive does."""

    DISABLED = 0
    ENABLED = 1
    BRAKING = 2
    """Its board had no command for its watchdog's time; until it is enabled again."""
    FAULT = 3


FAULTS = (
    "under_voltage", "over_voltage", "over_current", "winding_hot", "driver_hot", "encoder",
    "overload", "drive_silent",
)  # fmt: skip
"""By bit, from 0."""

Reason: TypeAlias = Literal[
    "length", "magic", "version", "crc", "kind", "board", "session", "late", "ahead", "duplicate",
    "stale", "joints", "not_a_number",
]  # fmt: skip
"""Why a datagram was refused.

length: it is not as long as it says, or as its kind is. late: it answers what was asked in an
earlier period. ahead: it answers what was never asked. duplicate: that was answered already. stale:
the board's time stands still. joints: it is about others than were asked for. not_a_number: of a
joint alone, the others are taken.
"""

FLAGS_EXPIRED, FLAGS_OTHERS = 1, 2
"""Of a board: its watchdog has expired; another session than the asker's commands it."""


class Datagram(NamedTuple):
    """One that is whole.

    Attributes:
        kind: as it stands there.
        board: whom it is for, or who answers.
        joints: mask of slots.
        session: drawn by the program that asks; a board repeats it.
        sequence: goes up with everything that program asks; a board repeats it.
        time_us: of who sent it.
        body: between header and CRC.
    """

    kind: int
    board: int
    joints: int
    session: int
    sequence: int
    time_us: int
    body: bytes


def packed(datagram: Datagram) -> bytes:
    """As it goes over the wire."""
    kind, board, joints, session, sequence, time_us, body = datagram
    length = LEAST + len(body)
    head = HEADER.pack(MAGIC, VERSION, kind, board, joints, length, session, sequence, time_us)
    whole = head + body
    return whole + CRC.pack(zlib.crc32(whole))


def opened(data: bytes) -> Datagram | Reason:
    """What it says, or why it is refused."""
    if not LEAST <= len(data) <= MOST:
        return "length"
    magic, version, kind, board, joints, length, session, sequence, time_us = HEADER.unpack_from(
        data
    )
    if magic != MAGIC:
        return "magic"
    if version != VERSION:
        return "version"
    if length != len(data):
        return "length"
    if CRC.unpack_from(data, length - CRC.size)[0] != zlib.crc32(data[: -CRC.size]):
        return "crc"
    body = data[HEADER.size : -CRC.size]
    return Datagram(kind, board, joints, session, sequence, time_us, body)


def is_before(sequence: int, other: int) -> bool:
    """Whether one goes before another; they begin anew after 2^32."""
    return sequence != other and (other - sequence) % TURN < TURN // 2


def mask_of(slots: Iterable[int]) -> int:
    """With a bit for each."""
    return sum(1 << slot for slot in set(slots))


def slots_of(mask: int) -> Iterator[int]:
    """Whose bit is set, the lowest first."""
    return (slot for slot in range(MOST_SLOTS) if mask >> slot & 1)


# --- bodies --------------------------------------------------------------------------------------

ORDER = np.dtype([(name, "<f4") for name in ("q", "qd", "kp", "kd", "tau")])
"""To a joint: rad, rad/s, N m/rad, N m s/rad, N m at its motor's output."""
FEEDBACK = np.dtype(
    [
        ("q", "<f4"), ("qd", "<f4"), ("tau", "<f4"), ("decicelsius", "<i2"), ("faults", "<u2"),
        ("state", "u1"), ("spare", "V3"),
    ]
)  # fmt: skip
"""From a joint, behind what the board says of itself."""
Records: TypeAlias = npt.NDArray[np.void]
BOARD = struct.Struct("<IHhHBx")
SOLD = struct.Struct("<16sfffff")
MADE = struct.Struct("<IHBx")
NUMBER = struct.Struct("<I")
FLOATS = "<f4"


class Told(NamedTuple):
    """What a board says of itself with every feedback.

    Attributes:
        obeyed: sequence of the last command of its commander.
        volts: of its supply.
        celsius: of its drives.
        refused: datagrams that it refused since it was switched on, the last 16 bits.
        flags: `FLAGS_EXPIRED`, `FLAGS_OTHERS`.
    """

    obeyed: int
    volts: float
    celsius: float
    refused: int
    flags: int


class Sold(NamedTuple):
    """What a joint's drive is, at its motor's output.

    Attributes:
        model: as its maker calls it.
        velocity_rad_s, torque_nm: the most that it does.
        kp, kd: the largest gains that it takes.
        trips_c: it lets go where its winding is as warm.
    """

    model: str
    velocity_rad_s: float
    torque_nm: float
    kp: float
    kd: float
    trips_c: float


class Hello(NamedTuple):
    """What a board says of itself when it is asked who it is."""

    serial: int
    firmware: int
    drives: dict[int, Sold]


def feedback_size(joints: int) -> int:
    """Bytes of the body that answers for so many joints."""
    return BOARD.size + joints * FEEDBACK.itemsize


def told(body: bytes) -> Told:
    """What a board says of itself, of a body that is long enough."""
    obeyed, decivolts, decicelsius, refused, flags = BOARD.unpack_from(body)
    return Told(obeyed, 0.01 * decivolts, 0.1 * decicelsius, refused, flags)


def hello(datagram: Datagram) -> Hello | None:
    """Who answers; None if its body is no such thing."""
    slots, body = [*slots_of(datagram.joints)], datagram.body
    if len(body) != MADE.size + len(slots) * SOLD.size:
        return None
    serial, firmware, _ = MADE.unpack_from(body)
    drives: dict[int, Sold] = {}
    for index, slot in enumerate(slots):
        name, *most = SOLD.unpack_from(body, MADE.size + index * SOLD.size)
        if not np.isfinite(most).all():
            return None
        drives[slot] = Sold(name.rstrip(b"\0").decode("ascii", "replace"), *most)
    return Hello(serial, firmware, drives)


def watchdog(timeout_s: float, damping_nm_s: Iterable[float]) -> bytes:
    """The body that sets one: after so long the joints brake with so much."""
    damping = np.array([*damping_nm_s], FLOATS)
    return NUMBER.pack(round(1e6 * timeout_s)) + damping.tobytes()


def number(body: bytes) -> int | None:
    """Of a body that is one; None if it is none."""
    return NUMBER.unpack(body)[0] if len(body) == NUMBER.size else None
