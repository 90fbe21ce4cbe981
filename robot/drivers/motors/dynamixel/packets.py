"""Packets of Dynamixel Protocol 2.0: framing, byte stuffing, CRC; from the e-manual, protocol2.

    FF FF FD 00 | id | length (2) | instruction | parameters ... | CRC (2)

Length counts what follows it. Wherever FF FF FD comes about from the instruction on, another FD is
put behind it, so that no header is inside a packet; length and CRC are those of the packet as sent.
"""

from __future__ import annotations

from typing import NamedTuple

from robot.errors import DriverError

HEADER = b"\xff\xff\xfd\x00"
BROADCAST = 0xFE
MOST_ID = 252
STATUS = 0x55
ALERT = 0x80
MOST_BYTES = 1024
"""Of a packet; whatever says that it is longer is none."""

_PATTERN, _STUFFED = b"\xff\xff\xfd", b"\xff\xff\xfd\xfd"
_BEFORE_LENGTH_ENDS = 7
_LEAST_LENGTH = 4
"""Of a status packet: instruction, error, CRC."""
_PART_FRAME = 4
"""Of one servo in a fast status packet: error, id, CRC."""


def _table() -> tuple[int, ...]:
    rows: list[int] = []
    for value in range(256):
        crc = value << 8
        for _ in range(8):
            crc = (crc << 1) ^ (0x8005 if crc & 0x8000 else 0)
        rows.append(crc & 0xFFFF)
    return tuple(rows)


_CRC = _table()


def crc16(data: bytes | memoryview, crc: int = 0) -> int:
    """CRC-16 of the polynomial 0x8005, not reflected; `crc` goes on from bytes before."""
    table = _CRC
    for byte in data:
        crc = (crc << 8 & 0xFF00) ^ table[crc >> 8 ^ byte]
    return crc


class Status(NamedTuple):
    """What a servo answered.

    Attributes:
        id: of the servo.
        error: what it made of the instruction, as the e-manual numbers them; 0: all is well.
        is_alert: whether it has a hardware error to tell.
        data: what it was asked for.
    """

    id: int
    error: int
    is_alert: bool
    data: bytes


def packet(to: int, instruction: int, parameters: bytes = b"") -> bytes:
    """An instruction as it goes over the wire.

    Raises:
        DriverError: there is no such identifier, or it gets too long.
    """
    if not (0 <= to <= MOST_ID or to == BROADCAST):
        raise DriverError(f"a Dynamixel's identifier is 0 to {MOST_ID}, not {to}")
    body = (bytes((instruction,)) + parameters).replace(_PATTERN, _STUFFED)
    length = len(body) + 2
    if length + _BEFORE_LENGTH_ENDS > MOST_BYTES:
        raise DriverError(f"a packet of {length + _BEFORE_LENGTH_ENDS} bytes is too long")
    whole = HEADER + bytes((to, length & 0xFF, length >> 8)) + body
    crc = crc16(whole)
    return whole + bytes((crc & 0xFF, crc >> 8))


class Receiver:
    """Bytes of one port into status packets, whatever else is among them.

    Attributes:
        crc_errors: packets whose CRC was not theirs.
        broken: packets that had begun and did not end.
        noise: bytes that belonged to no packet.
    """

    def __init__(self) -> None:
        """Nothing came yet."""
        self.crc_errors = self.broken = self.noise = 0
        self._bytes = bytearray()
        self._size: int | None = None

    def expect(self, fast_size: int | None) -> None:
        """What a fast status packet holds of each servo: so many bytes, None if none is awaited."""
        self._size = fast_size

    def take(self, data: bytes) -> list[Status]:
        """What came in; the packets that it completes."""
        self._bytes += data
        found: list[Status] = []
        while self._next(found, is_over=False):
            pass
        return found

    def give_up(self) -> list[Status]:
        """No more is coming: what has begun is broken, and what is behind it or whole in it."""
        found: list[Status] = []
        while self._bytes:
            if not self._next(found, is_over=True):
                break
        self.noise += len(self._bytes)
        self._bytes.clear()
        return found

    def _next(self, found: list[Status], *, is_over: bool) -> bool:
        """Look at what is in front; False if more is wanted first."""
        data = self._bytes
        begin = data.find(HEADER)
        if begin < 0:
            keep = 0 if is_over else len(HEADER) - 1  # a header may have come in part
            self._drop(max(0, len(data) - keep))
            return False
        self._drop(begin)
        if len(data) < _BEFORE_LENGTH_ENDS:
            return self._skip() if is_over else False
        length = data[5] | data[6] << 8
        end = _BEFORE_LENGTH_ENDS + length
        is_fast = data[4] == BROADCAST and self._size is not None
        if not _LEAST_LENGTH <= length <= MOST_BYTES or not (data[4] <= MOST_ID or is_fast):
            return self._skip()
        if len(data) > _BEFORE_LENGTH_ENDS and data[_BEFORE_LENGTH_ENDS] != STATUS:
            return self._skip()  # an instruction: our own, on an adapter that hears itself
        if len(data) < end:
            if not is_over:
                return False
            self.broken += 1
            if is_fast and (parts := self._parts(bytes(data), is_whole=False)):
                found += parts
            return self._skip()
        self._whole(bytes(data[:end]), found, is_fast=is_fast)
        return True

    def _whole(self, raw: bytes, found: list[Status], *, is_fast: bool) -> None:
        if crc16(memoryview(raw)[:-2]) != raw[-2] | raw[-1] << 8:
            self.crc_errors += 1
            found += self._parts(raw, is_whole=False) if is_fast else []
            del self._bytes[
                : len(HEADER)
            ]  # behind it another one may begin: its length may be wrong
            return
        del self._bytes[: len(raw)]
        if is_fast:
            found += self._parts(raw, is_whole=True)
            return
        body = raw[_BEFORE_LENGTH_ENDS + 1 : -2].replace(_STUFFED, _PATTERN)
        found.append(Status(raw[4], body[0] & ~ALERT, bool(body[0] & ALERT), body[1:]))

    def _parts(self, raw: bytes, *, is_whole: bool) -> list[Status]:
        """Servos of a fast status packet; of a broken one those whose own CRC is right.

        A part is error, id, data, CRC; that CRC is over all bytes of the packet before it. Where a
        part is spoilt, the CRC that stands behind it is where that of the next one goes on from.
        Nothing is stuffed: the length is said before anybody knows what the others will say.
        """
        step, at = (self._size or 0) + _PART_FRAME, _BEFORE_LENGTH_ENDS + 1
        if ((raw[5] | raw[6] << 8) - 1) % step:
            return []
        parts: list[Status] = []
        crc = 0 if is_whole else crc16(raw[:at])
        while at + step <= len(raw):
            end = at + step - 2
            told = raw[end] | raw[end + 1] << 8
            if is_whole or crc16(raw[at:end], crc) == told:
                error = raw[at]
                one = Status(raw[at + 1], error & ~ALERT, bool(error & ALERT), raw[at + 2 : end])
                parts.append(one)
            crc = 0 if is_whole else crc16(raw[end : end + 2], told)
            at += step
        return parts

    def _skip(self) -> bool:
        """What looked like a packet is none."""
        self._drop(len(HEADER))
        return True

    def _drop(self, count: int) -> None:
        self.noise += count
        del self._bytes[:count]
