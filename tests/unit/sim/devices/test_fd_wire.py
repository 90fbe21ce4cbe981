"""CAN FD on emulated wires: how long frames take, who carries them, who destroys them; as bytes."""

import math
import random

import can
import pytest

from robot.drivers.motors.can.frames import FD_SIZES, Frame, worst_fd_bits
from robot.drivers.motors.can.packed import BUS_OFF_FRAME, FD_SIZE, packed, unpacked, wide
from sim.devices import socket_frames
from sim.devices.wire import CanFrame, Wire

WORD = CanFrame(0x8001, bytes(range(32)), extended=True, fd=True)


@pytest.mark.parametrize("extended", [False, True])
@pytest.mark.parametrize("size", FD_SIZES)
def test_driver_and_wire_reckon_alike_and_no_less_than_the_published_bound(size: int, extended):
    """That of [Bordoloi2014], of identifiers of 11 bits, without the stuff count of ISO frames."""
    slow, fast = worst_fd_bits(size, is_extended=extended)
    assert CanFrame(1, bytes(size), extended, fd=True).fd_bits() == (slow, fast)
    if not extended:
        bound = 28 + 5 * math.ceil((size - 16) / 64) + 10 * size
        assert 32 <= slow <= 34
        assert bound <= fast <= bound + 13


def test_a_frame_takes_its_head_at_one_rate_and_its_data_at_the_other():
    wire, heard = Wire(data_bitrate_hz=5e6), list[float]()
    sender, _ = wire.attach(lambda *_: None), wire.attach(lambda _, at_s: heard.append(at_s))
    sender.send(WORD, 0.0)
    wire.advance(1.0)
    assert heard == [pytest.approx(57e-6 + 359 / 5e6)]


@pytest.mark.parametrize("why", ["a neighbour of CAN 2.0", "no rate for data"])
def test_an_fd_frame_is_destroyed_where_not_all_know_it(why: str):
    is_fd = why != "no rate for data"
    wire, heard = Wire(data_bitrate_hz=5e6 if is_fd else 0.0), list[CanFrame]()
    sender = wire.attach(lambda *_: None)
    other = wire.attach(lambda frame, _: heard.append(frame), knows_fd=not is_fd)
    sender.send(WORD, 0.0)
    wire.advance(1.0)
    assert not heard
    assert sender.is_off
    assert other.receive_errors > 0
    sender.restart()
    sender.send(WORD._replace(fd=False, data=bytes(8)), 1.0)
    wire.advance(2.0)
    assert len(heard) == 1


def test_fd_frames_come_back_out_of_their_bytes():
    draw = random.Random(2)
    for _ in range(500):
        extended = draw.random() < 0.5
        number, data = draw.randrange(1 << (29 if extended else 11)), draw.randbytes(
            draw.choice(FD_SIZES)
        )  # fmt: skip
        frame = Frame(number, data, extended, is_fd=True)
        assert unpacked(packed(frame)) == frame
        assert socket_frames.unpacked(packed(frame)) == CanFrame(*frame)
        assert socket_frames.packed(CanFrame(*frame)) == packed(frame)
        classic = Frame(number, data[:8], extended)
        assert unpacked(wide(packed(classic))) == classic
    assert unpacked(wide(BUS_OFF_FRAME)) is None
    assert len(wide(BUS_OFF_FRAME * 3)) == 3 * FD_SIZE


def test_bytes_are_those_that_python_cans_socketcan_makes():
    from can.interfaces.socketcan.socketcan import build_can_frame

    frame = Frame(0x8001, bytes(range(32)), is_extended=True, is_fd=True)
    message = can.Message(
        arbitration_id=0x8001, data=frame.data, is_extended_id=True, is_fd=True, bitrate_switch=True
    )
    theirs, ours = build_can_frame(message), packed(frame)
    assert (theirs[:7], theirs[8:40]) == (ours[:7], ours[8:40])  # one is reserved
