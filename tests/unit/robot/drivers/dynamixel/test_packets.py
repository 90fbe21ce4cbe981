"""Packets of Protocol 2.0: the e-manual's examples, properties, and what a line does to them."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motors.dynamixel import instructions as ask
from robot.drivers.motors.dynamixel.packets import (
    BROADCAST,
    HEADER,
    Receiver,
    Status,
    crc16,
    packet,
)
from robot.errors import DriverError

IDS = st.integers(0, 252)
NASTY = st.lists(st.sampled_from([0xFF, 0xFD, 0x00, 0x55, 0xFE, 0x01]), max_size=60).map(bytes)
DATA = st.one_of(st.binary(max_size=60), NASTY)


def hexed(text: str) -> bytes:
    return bytes.fromhex(text)


def status(number: int, data: bytes, error: int = 0) -> bytes:
    """A status packet, which has the frame of an instruction."""
    return packet(number, 0x55, bytes((error,)) + data)


def fast(parts: list[tuple[int, int, bytes]]) -> bytes:
    """A fast status packet of parts (error, id, data)."""
    length = 1 + sum(4 + len(data) for _, _, data in parts)
    whole = HEADER + bytes((BROADCAST, length & 0xFF, length >> 8, 0x55))
    for error, number, data in parts:
        whole += bytes((error, number)) + data
        crc = crc16(whole)
        whole += bytes((crc & 0xFF, crc >> 8))
    return whole


# e-manual, docs/en/dxl/protocol2: what is sent in its examples
SENT = {
    "FF FF FD 00 01 03 00 01 19 4E": ask.ping(1),
    "FF FF FD 00 FE 03 00 01 31 42": ask.ping(),
    "FF FF FD 00 01 07 00 02 84 00 04 00 1D 15": ask.read(1, 132, 4),
    "FF FF FD 00 01 09 00 03 74 00 00 02 00 00 CA 89": ask.write(1, 116, hexed("00020000")),
    "FF FF FD 00 01 03 00 08 2F 4E": ask.reboot(1),
    "FF FF FD 00 FE 09 00 82 84 00 04 00 01 02 CE FA": ask.sync_read([1, 2], 132, 4),
    "FF FF FD 00 FE 11 00 83 74 00 04 00 01 96 00 00 00 02 AA 00 00 00 82 87": ask.sync_write(
        116, {1: hexed("96000000"), 2: hexed("AA000000")}
    ),
    "FF FF FD 00 FE 0D 00 92 01 90 00 02 00 02 92 00 01 00 1A 05": ask.bulk_read(
        [(1, 144, 2), (2, 146, 1)]
    ),
}
ANSWERED = {
    "FF FF FD 00 01 07 00 55 00 06 04 26 65 5D": Status(1, 0, False, hexed("060426")),
    "FF FF FD 00 02 07 00 55 00 06 04 26 6F 6D": Status(2, 0, False, hexed("060426")),
    "FF FF FD 00 01 08 00 55 00 A6 00 00 00 8C C0": Status(1, 0, False, hexed("A6000000")),
    "FF FF FD 00 02 08 00 55 00 1F 08 00 00 BA BE": Status(2, 0, False, hexed("1F080000")),
    "FF FF FD 00 01 04 00 55 00 A1 0C": Status(1, 0, False, b""),
    "FF FF FD 00 01 06 00 55 00 77 00 C3 69": Status(1, 0, False, hexed("7700")),
    "FF FF FD 00 02 05 00 55 00 24 8B A9": Status(2, 0, False, hexed("24")),
}


@pytest.mark.parametrize(("text", "sent"), SENT.items())
def test_instructions_are_those_of_the_manual(text: str, sent: bytes):
    assert sent == hexed(text)


@pytest.mark.parametrize(("text", "meant"), ANSWERED.items())
def test_answers_of_the_manual_are_read(text: str, meant: Status):
    assert Receiver().take(hexed(text)) == [meant]


def test_a_header_in_the_data_is_stuffed_and_the_crc_is_over_what_is_sent():
    sent = ask.write(1, 116, hexed("FFFFFD00"))
    assert sent[7:-2] == hexed("03 7400 FFFFFDFD00")
    assert sent[5] | sent[6] << 8 == len(sent) - 7
    assert crc16(sent[:-2]) == sent[-2] | sent[-1] << 8
    assert sent.count(HEADER[:3] + b"\x00") == 1


@given(IDS, DATA, st.integers(0, 7), st.booleans())
def test_what_was_put_in_comes_out(number: int, data: bytes, error: int, is_alert: bool):
    sent = status(number, data, error | 0x80 * is_alert)
    assert Receiver().take(sent) == [Status(number, error, is_alert, data)]


@given(st.lists(st.tuples(IDS, DATA), max_size=5), st.integers(1, 40))
def test_it_does_not_matter_in_which_pieces_it_comes(packets: list, piece: int):
    line = b"".join(status(number, data) for number, data in packets)
    receiver, found = Receiver(), []
    for at in range(0, len(line), piece):
        found += receiver.take(line[at : at + piece])
    assert [(one.id, one.data) for one in found] == packets
    assert (receiver.noise, receiver.crc_errors, receiver.broken) == (0, 0, 0)


@given(DATA.filter(lambda noise: HEADER not in noise), IDS, st.binary(max_size=20))
def test_noise_before_a_packet_costs_nothing(noise: bytes, number: int, data: bytes):
    if not noise.endswith((b"\xff", b"\xff\xff\xfd")):
        assert Receiver().take(noise + status(number, data)) == [Status(number, 0, False, data)]


@given(IDS, st.binary(max_size=20), st.data())
def test_a_flipped_bit_is_never_believed(number: int, data: bytes, choose):
    sent = bytearray(status(number, data))
    bit = choose.draw(st.integers(0, 8 * len(sent) - 1))
    sent[bit // 8] ^= 1 << bit % 8
    receiver = Receiver()
    assert receiver.take(bytes(sent)) + receiver.give_up() == []


@given(IDS, st.binary(max_size=20), st.integers(1, 10), st.binary(max_size=8))
def test_half_a_packet_does_not_take_the_next_with_it(number, data, cut, other):
    first, second = status(1, b"12345678"), status(number, data)
    receiver = Receiver()
    found = receiver.take(first[:-cut] + second) + receiver.give_up()
    assert found[-1:] == [Status(number, 0, False, data)]


def test_our_own_words_heard_again_are_no_answer():
    receiver = Receiver()
    line = ask.sync_read([1, 2], 126, 10) + status(1, b"0123456789")
    assert receiver.take(line) == [Status(1, 0, False, b"0123456789")]


@given(st.lists(st.tuples(st.sampled_from([0, 0x80]), IDS, st.binary(min_size=6, max_size=6)),
                min_size=1, max_size=8), st.data())  # fmt: skip
def test_of_a_fast_packet_that_ends_early_the_whole_parts_are_believed(parts: list, choose):
    """Those whose own CRC came: a servo that is missing takes away those behind it only."""
    sent = fast(parts)
    receiver = Receiver()
    receiver.expect(6)
    keep = choose.draw(st.integers(0, len(sent)))
    found = receiver.take(sent[:keep]) + receiver.give_up()
    came = max(0, keep - 8) // 10
    assert found == [Status(n, e & 0x7F, bool(e), d) for e, n, d in parts[:came]]


def test_a_fast_packet_nobody_asked_for_is_noise():
    receiver = Receiver()
    assert receiver.take(fast([(0, 1, b"abcd")])) + receiver.give_up() == []


def test_random_bytes_never_raise_and_never_pile_up():
    chance = random.Random(18)
    alphabet = bytes((0xFF, 0xFF, 0xFD, 0x00, 0x55, 0xFE, 1, 8))
    receiver = Receiver()
    for turn in range(20_000):
        receiver.expect(chance.choice((None, 0, 10)))
        junk = bytes(chance.choices(alphabet, k=8)) if turn % 2 else chance.randbytes(12)
        for one in receiver.take(junk):
            assert one.id <= 255
        assert len(receiver._bytes) < 1100
        if turn % 50 == 0:
            receiver.give_up()
            assert not receiver._bytes


@pytest.mark.parametrize(
    "ask_it",
    [
        lambda: packet(253, 1),
        lambda: packet(-1, 1),
        lambda: ask.write(1, 0, bytes(1100)),
        lambda: ask.sync_write(100, {1: b"a", 2: b"ab"}),
        lambda: ask.sync_write(100, {}),
        lambda: ask.sync_read([1, 1], 100, 2),
        lambda: ask.sync_read([], 100, 2),
        lambda: ask.read(1, 70_000, 2),
    ],
)
def test_what_cannot_be_asked_is_refused(ask_it):
    with pytest.raises(DriverError):
        ask_it()
