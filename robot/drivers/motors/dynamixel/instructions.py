"""What a Dynamixel is asked: instruction packets of Protocol 2.0, and how long answers get.

From the e-manual (protocol2, instruction details). Values are little-endian; negative ones are
two's complement, which `robot.drivers.motors.dynamixel.control_table` packs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from robot.drivers.motors.dynamixel.packets import BROADCAST, packet
from robot.errors import DriverError

PING, READ, WRITE, REBOOT = 0x01, 0x02, 0x03, 0x08
SYNC_READ, SYNC_WRITE, FAST_SYNC_READ = 0x82, 0x83, 0x8A
BULK_READ = 0x92

FAST_FRAME, FAST_EACH = 8, 4
"""Of a fast status packet: before the first servo's part, and around each servo's data."""


def ping(to: int = BROADCAST) -> bytes:
    """Who is there; answered with model number and firmware, 3 bytes, by everybody on broadcast."""
    return packet(to, PING)


def read(to: int, address: int, size: int) -> bytes:
    """Bytes of one servo's control table."""
    return packet(to, READ, _two(address) + _two(size))


def write(to: int, address: int, data: bytes) -> bytes:
    """Bytes into one servo's control table; broadcast: into everybody's, unanswered."""
    return packet(to, WRITE, _two(address) + data)


def reboot(to: int) -> bytes:
    """Switch off and on again: torque is off then, and a hardware error forgotten."""
    return packet(to, REBOOT)


def sync_read(ids: Sequence[int], address: int, size: int, *, is_fast: bool = False) -> bytes:
    """The same bytes of several servos; each answers, in this order, or all in one fast packet."""
    code = FAST_SYNC_READ if is_fast else SYNC_READ
    return packet(BROADCAST, code, _two(address) + _two(size) + bytes(_different(ids)))


def sync_write(address: int, data: Mapping[int, bytes]) -> bytes:
    """Bytes of their own into the same place of several servos, unanswered.

    Raises:
        DriverError: if they are not equally many.
    """
    sizes = {len(one) for one in data.values()}
    if len(sizes) != 1:
        raise DriverError(f"a sync write wants as many bytes for each, not {sorted(sizes)}")
    _different(data)
    parts = b"".join(bytes((number,)) + one for number, one in data.items())
    return packet(BROADCAST, SYNC_WRITE, _two(address) + _two(sizes.pop()) + parts)


def bulk_read(asked: Sequence[tuple[int, int, int]]) -> bytes:
    """Different bytes (id, address, size) of several servos; each answers, in this order."""
    _different([number for number, _, _ in asked])
    parts = b"".join(
        bytes((number,)) + _two(address) + _two(size) for number, address, size in asked
    )
    return packet(BROADCAST, BULK_READ, parts)


def fast_bytes(servos: int, size: int) -> int:
    """How long the answer to a fast sync read is."""
    return FAST_FRAME + servos * (FAST_EACH + size)


def _two(value: int) -> bytes:
    if not 0 <= value <= 0xFFFF:
        raise DriverError(f"{value} does not fit two bytes")
    return bytes((value & 0xFF, value >> 8))


def _different(ids: Iterable[int]) -> list[int]:
    numbers = list(ids)
    if not numbers or len(set(numbers)) != len(numbers):
        raise DriverError(f"servos are asked once each, not {numbers}")
    return numbers
