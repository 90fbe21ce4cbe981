"""The other end of Dynamixel Protocol 2.0: instructions out of bytes, status packets into them.

Written from the e-manual (protocol2, crc), byte by byte like a servo's firmware, apart from the
driver.
"""

from __future__ import annotations

from typing import NamedTuple

INSTRUCTION_AT = 7
MOST_LENGTH = 1024


class Instruction(NamedTuple):
    """What was asked: of whom, what, with which parameters; `end`: index behind its last byte."""

    to: int
    code: int
    parameters: bytes
    end: int


def crc(data: bytes, before: int = 0) -> int:
    """CRC-16, x16 + x15 + x2 + 1, bit by bit."""
    value = before
    for byte in data:
        value = _ROWS[(value >> 8) ^ byte] ^ ((value & 0xFF) << 8)
    return value


def _row(byte: int) -> int:
    value = byte << 8
    for _ in range(8):
        carry = value & 0x8000
        value = (value << 1) & 0xFFFF
        if carry:
            value ^= 0x8005
    return value


_ROWS = [_row(byte) for byte in range(256)]


def status(number: int, error: int, data: bytes) -> bytes:
    """A status packet."""
    body = bytearray((0x55,))
    ones = 0  # how many FF stand in front
    for byte in (error, *data):
        body.append(byte)
        if byte == 0xFD and ones >= 2:
            body.append(0xFD)
        ones = ones + 1 if byte == 0xFF else 0
    length = len(body) + 2
    whole = bytes((0xFF, 0xFF, 0xFD, 0x00, number, length & 0xFF, length >> 8)) + bytes(body)
    check = crc(whole)
    return whole + bytes((check & 0xFF, check >> 8))


def fast_head(count: int, size: int) -> bytes:
    """What the first servo sends before its part of a fast status packet."""
    length = 1 + count * (size + 4)
    return bytes((0xFF, 0xFF, 0xFD, 0x00, 0xFE, length & 0xFF, length >> 8, 0x55))


def fast_part(before: int, number: int, error: int, data: bytes) -> bytes:
    """One servo's part of a fast status packet; `before`: CRC of all the bytes before it."""
    part = bytes((error, number)) + data
    check = crc(part, before)
    return part + bytes((check & 0xFF, check >> 8))


class Ear:
    """Hears a line byte by byte, as every servo on it does.

    Attributes:
        crc_errors: instructions whose CRC was wrong; nobody answers them.
    """

    def __init__(self) -> None:
        """Nothing was heard."""
        self.crc_errors = 0
        self._heard = bytearray()

    def hear(self, data: bytes) -> list[Instruction]:
        """Bytes came; the instructions that end in them, `end` counted from their first."""
        found: list[Instruction] = []
        for index, byte in enumerate(data):
            if (one := self._byte(byte, index + 1)) is not None:
                found.append(one)
        return found

    def _byte(self, byte: int, end: int) -> Instruction | None:
        heard = self._heard
        count = len(heard)
        if count < 4 and byte != (0xFF, 0xFF, 0xFD, 0x00)[count]:
            if not (count == 2 and byte == 0xFF):  # FF FF FF: the last two may begin one
                heard.clear()
                if byte == 0xFF:
                    heard.append(byte)
            return None
        heard.append(byte)
        if len(heard) < INSTRUCTION_AT:
            return None
        length = heard[5] | heard[6] << 8
        if not 3 <= length <= MOST_LENGTH:
            heard.clear()
            return None
        if len(heard) < INSTRUCTION_AT + length:
            return None
        whole = bytes(heard)
        heard.clear()
        if crc(whole[:-2]) != whole[-2] | whole[-1] << 8:
            self.crc_errors += 1
            return None
        body = _unstuffed(whole[INSTRUCTION_AT:-2])
        return None if body[0] == 0x55 else Instruction(whole[4], body[0], body[1:], end)


def _unstuffed(body: bytes) -> bytes:
    plain = bytearray()
    skip = False
    for byte in body:
        if skip and byte == 0xFD:
            skip = False
            continue
        plain.append(byte)
        skip = plain.endswith(b"\xff\xff\xfd")
    return bytes(plain)
