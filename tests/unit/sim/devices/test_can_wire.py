"""The bus model: who is first, how long it takes, what happens when nobody listens or all fails."""

import pytest

from sim.devices.wire import OFF_AT, PASSIVE_AT, CanFrame, Wire

BIT_S = 1e-6


class Ear:
    def __init__(self, wire: Wire, **options) -> None:
        self.heard: list[tuple[int, float]] = []
        self.offs = 0
        self.node = wire.attach(self.hear, on_off=self.off, **options)

    def hear(self, frame: CanFrame, at_s: float) -> None:
        self.heard.append((frame.id, round(at_s / BIT_S)))

    def off(self) -> None:
        self.offs += 1


@pytest.fixture
def wire() -> Wire:
    return Wire(bitrate_hz=1e6)


@pytest.fixture
def ears(wire: Wire) -> tuple[Ear, Ear, Ear]:
    return Ear(wire), Ear(wire), Ear(wire, room=3)


@pytest.mark.parametrize(("extended", "bits"), [(False, 135), (True, 160)])
def test_a_frame_takes_as_long_as_with_the_most_stuffing(wire, ears, extended: bool, bits: int):
    ears[0].node.send(CanFrame(1, bytes(8), extended), 0.0)
    wire.advance(1e-3)
    assert ears[1].heard == ears[2].heard == [(1, bits)]
    assert ears[0].heard == []
    assert wire.busy_s == pytest.approx(bits * BIT_S)


def test_the_lowest_identifier_goes_first_and_none_is_lost(wire, ears):
    for node, number in ((0, 0x300), (1, 0x100), (0, 0x001)):
        ears[node].node.send(CanFrame(number, bytes(8)), 0.0)
    wire.advance(1e-3)
    assert ears[2].heard == [(0x100, 135), (0x300, 270), (0x001, 405)]


def test_a_short_identifier_wins_over_a_long_one_that_begins_alike(wire, ears):
    ears[0].node.send(CanFrame(0x100 << 18, bytes(8), True), 0.0)
    ears[1].node.send(CanFrame(0x100, bytes(8)), 0.0)
    wire.advance(1e-3)
    assert [number for number, _ in ears[2].heard] == [0x100, 0x100 << 18]


def test_what_comes_while_the_wire_is_busy_waits(wire, ears):
    ears[0].node.send(CanFrame(0x300, bytes(8)), 0.0)
    ears[1].node.send(CanFrame(0x001, bytes(8)), 50e-6)
    wire.advance(1e-3)
    assert ears[2].heard == [(0x300, 135), (0x001, 270)]


def test_a_full_queue_takes_nothing(wire, ears):
    node = ears[2].node
    assert [node.send(CanFrame(i, b""), 0.0) for i in range(5)] == [True] * 3 + [False] * 2
    assert (node.dropped, node.has_room) == (2, False)
    wire.advance(1e-3)
    assert node.has_room


def test_alone_on_the_wire_a_frame_is_sent_over_and_over_and_its_sender_gets_passive():
    wire = Wire()
    lonely = Ear(wire, room=2)
    lonely.node.send(CanFrame(1, bytes(8)), 0.0)
    wire.advance(0.1)
    assert (lonely.node.transmit_errors, lonely.node.is_off) == (PASSIVE_AT, False)
    assert lonely.node.ready_s == 0.0
    late = Ear(wire)
    wire.advance(0.2)
    assert [number for number, _ in late.heard] == [1]


def test_a_controller_that_garbles_its_frames_takes_itself_off_the_bus(wire, ears):
    ears[0].node.garbles = 1000
    ears[0].node.send(CanFrame(1, bytes(8)), 0.0)
    ears[1].node.send(CanFrame(2, bytes(8)), 0.0)
    wire.advance(0.1)
    assert (ears[0].node.is_off, ears[0].offs) == (True, 1)
    assert ears[0].node.transmit_errors == OFF_AT
    assert [number for number, _ in ears[2].heard] == [2]
    assert not ears[0].node.send(CanFrame(1, bytes(8)), 0.1)
    ears[0].node.garbles = 0
    ears[0].node.restart()
    assert ears[0].node.send(CanFrame(1, bytes(8)), 0.1)
    wire.advance(0.2)
    assert ears[2].heard[-1][0] == 1


def test_a_few_bad_frames_are_sent_again(wire, ears):
    ears[0].node.garbles = 2
    ears[0].node.send(CanFrame(1, bytes(8)), 0.0)
    wire.advance(0.1)
    assert ears[1].heard == [(1, 3 * 135 + 2 * 23)]
    assert 0 < ears[0].node.transmit_errors < PASSIVE_AT


def test_two_that_say_different_things_under_one_identifier_destroy_each_other(wire, ears):
    ears[0].node.send(CanFrame(7, b"\x01" * 8), 0.0)
    ears[1].node.send(CanFrame(7, b"\x02" * 8), 0.0)
    wire.advance(0.1)
    assert ears[2].heard == []
    assert ears[0].node.is_off
    assert ears[1].node.is_off


def test_two_that_say_the_same_thing_are_one(wire, ears):
    for ear in ears[:2]:
        ear.node.send(CanFrame(7, b"\x01" * 8), 0.0)
    wire.advance(0.1)
    assert ears[2].heard == [(7, 135)]


def test_nothing_comes_of_a_frame_whose_sender_is_unplugged(wire, ears):
    ears[0].node.send(CanFrame(7, bytes(8)), 0.0)
    wire.advance(50e-6)
    wire.detach(ears[0].node)
    ears[1].node.send(CanFrame(8, bytes(8)), 60e-6)
    wire.advance(0.1)
    assert [number for number, _ in ears[2].heard] == [8]


def test_played_in_small_steps_it_is_the_same(wire, ears):
    other = Wire()
    others = [Ear(other) for _ in range(3)]
    for k in range(20):
        for group in (ears, others):
            group[k % 2].node.send(CanFrame((7 * k) % 23 + 1, bytes(k % 9)), k * 37e-6)
    wire.advance(0.01)
    for step in range(1, 1001):
        other.advance(step * 1e-5)
    assert ears[2].heard == others[2].heard
    assert len(ears[2].heard) == 20
