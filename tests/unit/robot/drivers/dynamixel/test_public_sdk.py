"""Differences and agreement with `dynamixel-sdk`, which nobody here wrote.

Where its 4.1.0 is wrong the e-manual (protocol2, processing order) decides: stuff first, then
length and CRC over what is sent.
"""

import random

import pytest

from robot.drivers.motors.dynamixel import instructions as ask
from robot.drivers.motors.dynamixel.packets import HEADER, Receiver, crc16, packet

sdk = pytest.importorskip("dynamixel_sdk")
HANDLER = sdk.PacketHandler(2.0)


class Tap:
    """A port of the SDK's that keeps what is written to it, and gives back what it is told to."""

    def __init__(self, answer: bytes = b"") -> None:
        self.is_using, self.sent, self._answer = False, b"", answer

    def clearPort(self) -> None:
        pass

    def writePort(self, data) -> int:
        self.sent = bytes(data)
        return len(data)

    def readPort(self, count: int) -> list[int]:
        now, self._answer = self._answer[:count], self._answer[count:]
        return list(now)

    def setPacketTimeout(self, count: int) -> None:
        pass

    def isPacketTimeout(self) -> bool:
        return True


def sent_by_sdk(number: int, code: int, parameters: bytes) -> bytes:
    tap = Tap()
    length = len(parameters) + 3
    raw = [0, 0, 0, 0, number, length & 0xFF, length >> 8, code, *parameters, 0, 0]
    assert HANDLER.txPacket(tap, raw) == sdk.COMM_SUCCESS
    return tap.sent


def test_all_that_needs_no_stuffing_is_the_same_byte_for_byte():
    chance = random.Random(2)
    compared = 0
    for _ in range(3000):
        number, code = chance.randrange(253), chance.choice((1, 2, 3, 0x82, 0x83, 0x92))
        parameters = chance.randbytes(chance.randrange(40))
        if HEADER[:3] in bytes((code,)) + parameters:
            continue
        compared += 1
        assert packet(number, code, parameters) == sent_by_sdk(number, code, parameters)
    assert compared > 2900


def test_what_needs_stuffing_the_sdk_sends_unstuffed_and_a_header_is_then_in_the_packet():
    """Its txPacket throws away what its addStuffing returns."""
    data = bytes.fromhex("FFFFFD00")
    theirs = sent_by_sdk(1, ask.WRITE, b"\x74\x00" + data)
    ours = ask.write(1, 0x74, data)
    assert theirs.count(HEADER) == 2
    assert ours.count(HEADER) == 1
    assert len(ours) == len(theirs) + 1
    assert crc16(ours[:-2]) == int.from_bytes(ours[-2:], "little")


def test_what_servos_answer_is_read_alike_unless_the_sdk_spoils_it():
    """Its removeStuffing compares with bytes that it has moved already."""
    chance = random.Random(3)
    spoilt = 0
    for turn in range(3000):
        plain = chance.randbytes(chance.randrange(1, 30))
        nasty = bytes(chance.choices((0xFF, 0xFF, 0xFD, 0), k=chance.randrange(1, 30)))
        data = nasty if turn % 2 else plain
        line = packet(7, 0x55, b"\x00" + data)
        (ours,) = Receiver().take(line)
        assert ours.data == data
        theirs, result = HANDLER.rxPacket(Tap(line), False)
        assert result == sdk.COMM_SUCCESS
        length = theirs[5] | theirs[6] << 8
        same = bytes(theirs[9 : 9 + length - 4]) == data
        assert same or HEADER[:3] in data
        spoilt += not same
    assert spoilt > 0  # when this fails, a new version is right: then demand that it always agrees
