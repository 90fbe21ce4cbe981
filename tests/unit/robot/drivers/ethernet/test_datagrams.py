"""Datagrams of boards: the bytes that docs/hardware.md shows, and whatever else may come in."""

import struct
import warnings
from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motors.ethernet import datagrams
from robot.drivers.motors.ethernet.datagrams import (
    FEEDBACK,
    HEADER,
    LEAST,
    ORDER,
    Datagram,
    Kind,
    Reason,
)
from robot.drivers.motors.ethernet.reception import Reception
from sim.devices import ethernet_codec
from tests.fakes.ethernet_rig import limbs

EXAMPLE = bytes.fromhex(
    "48 4d 54 52 01 03 02 00 21 00 48 00 78 56 34 12 05 00 00 00 40 42 0f 00 00 00 00 00"
    "00 00 00 3f 00 00 00 00 00 00 20 42 00 00 00 40 00 00 80 bf"
    "00 00 00 be 00 00 80 3e 00 00 00 00 00 00 80 3f 00 00 00 00"
    "d4 51 e2 01"
)
"""A command of session 0x12345678, its fifth, to the joints in the slots 0 and 5 of board 2."""
SAID = Datagram(Kind.COMMAND, 2, 0b10_0001, 0x1234_5678, 5, 1_000_000, EXAMPLE[28:-4])


def test_the_example_of_the_page_is_what_goes_over_the_wire():
    assert datagrams.packed(SAID) == EXAMPLE
    assert datagrams.opened(EXAMPLE) == SAID
    assert [*datagrams.slots_of(SAID.joints)] == [0, 5]
    orders = np.frombuffer(SAID.body, ORDER)
    assert orders[0].tolist() == (0.5, 0.0, 40.0, 2.0, -1.0)
    assert orders[1].tolist() == (-0.125, 0.25, 0.0, 1.0, 0.0)


def test_the_emulated_board_which_was_written_apart_reads_the_same():
    asked = ethernet_codec.asked(EXAMPLE)
    assert asked is not None
    assert (asked.kind, asked.board, asked.mask) == (3, 2, 33)
    assert (asked.session, asked.sequence) == (0x1234_5678, 5)
    assert ethernet_codec.orders(asked.body, 2) == [
        (0.5, 0.0, 40.0, 2.0, -1.0),
        (-0.125, 0.25, 0.0, 1.0, 0.0),
    ]
    assert ethernet_codec.crc(b"123456789") == 0xCBF43926


bounded = st.floats(-1e6, 1e6, width=32)


@given(
    st.integers(0, 255), st.integers(0, 0xFFFF), st.integers(0, 0xFFFF_FFFF),
    st.integers(0, 0xFFFF_FFFF), st.integers(0, (1 << 64) - 1), st.binary(max_size=600),
)  # fmt: skip
def test_whatever_is_packed_is_opened_as_it_was(board, joints, session, sequence, time_us, body):
    said = Datagram(Kind.STATE, board, joints, session, sequence, time_us, body)
    data = datagrams.packed(said)
    assert datagrams.opened(data) == said
    asked = ethernet_codec.asked(data)
    assert asked == (Kind.STATE, board, joints, session, sequence, body)


@given(bounded, bounded, bounded, st.floats(-200.0, 300.0), st.integers(0, 0xFFFF))
def test_what_a_board_says_of_a_joint_is_what_is_read(q, qd, tau, celsius, faults):
    body = ethernet_codec.joint(q, qd, tau, celsius=celsius, faults=faults, state=1)
    (told,) = np.frombuffer(body, FEEDBACK)
    assert (told["q"], told["qd"], told["tau"]) == (q, qd, tau)
    assert 0.1 * told["decicelsius"] == pytest.approx(celsius, abs=0.1)
    assert (told["faults"], told["state"]) == (faults, 1)


def test_who_a_board_says_it_is_is_what_is_read():
    body = ethernet_codec.made(
        77, 0x0102, [("LEG-88", [14, 88, 500, 5, 120]), ("ARM", [1, 2, 3, 4, 5])]
    )
    who = datagrams.hello(Datagram(0x81, 1, 0b1001, 1, 1, 1, body))
    assert who is not None
    assert (who.serial, who.firmware) == (77, 0x0102)
    assert who.drives[0] == ("LEG-88", 14, 88, 500, 5, 120)
    assert who.drives[3].model == "ARM"
    assert datagrams.hello(Datagram(0x81, 1, 0b1011, 1, 1, 1, body)) is None
    bad = ethernet_codec.made(77, 1, [("LEG-88", [14, np.nan, 500, 5, 120])])
    assert datagrams.hello(Datagram(0x81, 1, 1, 1, 1, 1, bad)) is None


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda d: d[:20], "length"),
        (lambda d: d + b"\0", "length"),
        (lambda d: d[:-1], "length"),
        (lambda d: b"XMTR" + d[4:], "magic"),
        (lambda d: d[:4] + b"\2" + d[5:], "version"),
        (lambda d: d[:40] + bytes((d[40] ^ 4,)) + d[41:], "crc"),
        (lambda d: d[:-4] + b"\0\0\0\0", "crc"),
        (lambda d: b"", "length"),
        (lambda d: d * 40, "length"),
    ],
)
def test_what_is_not_whole_is_refused_with_its_reason(change, why):
    assert datagrams.opened(change(EXAMPLE)) == why


def test_every_flipped_bit_is_refused():
    for bit in range(8 * len(EXAMPLE)):
        spoilt = bytearray(EXAMPLE)
        spoilt[bit // 8] ^= 1 << bit % 8
        assert datagrams.opened(bytes(spoilt)) in get_args(Reason)
        assert ethernet_codec.asked(bytes(spoilt)) is None


@given(st.integers(0, 0xFFFF_FFFF), st.integers(1, 0x7FFF_FFFF))
def test_sequences_go_on_where_they_begin_anew(sequence, ahead):
    later = (sequence + ahead) % datagrams.TURN
    assert datagrams.is_before(sequence, later)
    assert not datagrams.is_before(later, sequence)
    assert not datagrams.is_before(sequence, sequence)


# --- noise ---------------------------------------------------------------------------------------


def noisy(draw: np.random.Generator, sound: list[bytes]) -> bytes:
    """Random bytes, or a sound datagram that was cut, filled, flipped, or given a right CRC."""
    how, data = int(draw.integers(6)), bytearray(sound[int(draw.integers(len(sound)))])
    if how == 0:
        return draw.integers(0, 256, int(draw.integers(0, 300))).astype(np.uint8).tobytes()
    for _ in range(int(draw.integers(1, 6))):
        data[int(draw.integers(len(data)))] = int(draw.integers(256))
    if how == 1:
        del data[int(draw.integers(len(data))) :]
    elif how == 2:
        data += bytes(int(draw.integers(1, 40)))
    if how >= 3 and len(data) >= LEAST:  # as one would that means harm
        struct.pack_into("<H", data, 10, len(data))
        data[:5] = b"HMTR\1"
        data[-4:] = ethernet_codec.crc(bytes(data[:-4])).to_bytes(4, "little")
    return bytes(data)


def test_noise_and_forgeries_raise_nothing_and_every_one_is_counted():
    """60,000 here; 1,000,000 were tried once (docs/hardware.md)."""
    joints = limbs(2, 3)
    heard = Reception(joints, session=7)
    draw = np.random.default_rng(5)
    slots = 0b111
    body = ethernet_codec.itself(obeyed=1, volts=48.0, celsius=30.0, refused=0, flags=0)
    body += ethernet_codec.joint(0.1, 0.0, 0.0, celsius=30.0, faults=0, state=1) * 3
    sound = [
        ethernet_codec.answer(
            ethernet_codec.Asked(kind, 0, slots, 7, 100, b""),
            board=board, mask=slots, time_us=5000, body=body,
        )
        for kind in (2, 3) for board in (0, 1)
    ]  # fmt: skip
    believed = 0
    for _ in range(60):
        heard.expect(Kind.STATE, 100)
        before = heard.refused.total()
        came = [(f"board{int(draw.integers(2))}", noisy(draw, sound)) for _ in range(1000)]
        heard.take(came, 1.0)
        answered = sum(board.is_answered for board in heard.boards.values())
        not_numbers = sum(board.refused["not_a_number"] for board in heard.boards.values())
        assert heard.refused.total() - before >= 1000 - answered
        believed += answered
        assert np.isfinite(heard.q).all()
        assert np.isfinite(heard.qd).all()
        assert not_numbers <= 3 * believed
        heard.end_period()
    assert set(heard.refused) <= set(get_args(Reason))
    assert {"length", "magic", "crc", "session", "late", "ahead", "kind", "board"} <= set(
        heard.refused
    )
    assert HEADER.size == 28


def test_a_signalling_nan_is_refused_without_a_word():
    """What a million forgeries found: numpy warned on standard error, in the middle of the loop."""
    joints = limbs(1, 1)
    heard = Reception(joints, session=7)
    heard.expect(Kind.STATE, 100)
    body = ethernet_codec.itself(obeyed=1, volts=48.0, celsius=30.0, refused=0, flags=0)
    joint = bytearray(ethernet_codec.joint(0.1, 0.0, 0.0, celsius=30.0, faults=0, state=1))
    joint[:4] = bytes.fromhex("0100a07f")
    number = next(iter(joints.boards.values())).number
    told = ethernet_codec.answer(
        ethernet_codec.Asked(2, 0, 1, 7, 100, b""),
        board=number, mask=1, time_us=5000, body=body + bytes(joint),
    )  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        heard.take([(next(iter(joints.boards)), told)], 1.0)
    assert heard.refused["not_a_number"] == 1
    assert np.isfinite(heard.q).all()
