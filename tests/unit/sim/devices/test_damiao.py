"""The emulated motor against the words of its manual, byte by byte."""

import struct

import pytest

from sim.devices.can_motor import AMBIENT_C, FLAWS
from sim.devices.damiao import Damiao
from sim.devices.shaft import FreeShaft
from sim.devices.wire import CanFrame, Wire

ENABLE, DISABLE, CLEAR = (bytes.fromhex("fffffffffffffff" + digit) for digit in "cdb")


class Host:
    """A wire with one motor on it, and somebody who talks to it."""

    def __init__(self) -> None:
        self.wire = Wire()
        self.heard: list[CanFrame] = []
        self.node = self.wire.attach(lambda frame, _: self.heard.append(frame))
        self.shaft = FreeShaft(friction_nm_s=0.02)
        self.motor = Damiao(self.wire, self.shaft, 5, 0x15, 12.5, 30.0, 10.0)

    def say(self, data: bytes, number: int = 5, *, wait_s: float = 0.001) -> bytes | None:
        """The data of its answer, if any."""
        self.heard.clear()
        self.node.send(CanFrame(number, data), self.wire.now_s)
        self.wait(wait_s)
        assert all(frame.id == self.motor.registers[7] for frame in self.heard)
        return self.heard[-1].data if self.heard else None

    def wait(self, wait_s: float) -> None:
        until_s = self.wire.now_s + wait_s
        self.wire.advance(until_s)
        self.motor.live(until_s)

    def status(self) -> int:
        answer = self.say(bytes.fromhex("0500cc0000000000"), 0x7FF)
        assert answer is not None
        return answer[0] >> 4

    def read(self, number: int, layout: str = "<f") -> float:
        answer = self.say(bytes((5, 0, 0x33, number, 0, 0, 0, 0)), 0x7FF)
        assert answer is not None
        assert answer[:4] == bytes((5, 0, 0x33, number))
        return struct.unpack(layout, answer[4:])[0]

    def write(self, number: int, packed: bytes) -> None:
        assert self.say(bytes((5, 0, 0x55, number)) + packed, 0x7FF) is not None


@pytest.fixture
def host() -> Host:
    return Host()


def command(q: int = 0x8000, v: int = 0x800, kp: int = 0, kd: int = 0, t: int = 0x800) -> bytes:
    return bytes.fromhex(f"{q:04x}{v:03x}{kp:03x}{kd:03x}{t:03x}")


def test_it_is_disabled_when_it_gets_power_and_obeys_nothing(host: Host):
    answer = host.say(command(t=0xFFF), wait_s=0.05)
    assert answer is not None
    assert answer[0] == 0x05
    assert host.shaft.qd_rad_s == 0.0


def test_enabled_it_gives_the_torque_it_is_told(host: Host):
    assert (host.say(ENABLE) or b"")[0] == 0x15
    host.say(command(t=0xFFF))
    answer = host.say(bytes.fromhex("0500cc0000000000"), 0x7FF)
    assert answer is not None
    assert (answer[4] & 0xF) << 8 | answer[5] == 0xFFF
    assert host.motor.tau_nm == 10.0
    host.say(DISABLE)
    assert host.motor.tau_nm == 0.0


def test_it_goes_where_it_is_told(host: Host):
    host.say(ENABLE)
    host.say(command(q=0xA000, kp=0x300, kd=0x400), wait_s=1.0)
    assert host.shaft.q_rad == pytest.approx(-12.5 + 25.0 * 0xA000 / 0xFFFF, abs=0.01)


def test_its_torque_ends_where_its_range_ends(host: Host):
    host.say(ENABLE)
    host.say(command(q=0xFFFF, kp=0xFFF), wait_s=0.002)
    assert host.motor.tau_nm == 10.0


def test_registers_are_read_written_and_mean_something(host: Host):
    assert [host.read(number) for number in (21, 22, 23)] == [12.5, 30.0, 10.0]
    assert host.read(8, "<I") == 5
    assert host.read(7, "<I") == 0x15
    host.write(21, struct.pack("<f", 6.25))
    host.say(ENABLE)
    host.say(command(q=0xC000, kp=0x300, kd=0x400), wait_s=1.0)
    assert host.shaft.q_rad == pytest.approx(3.125, abs=0.01)
    host.write(7, struct.pack("<I", 0x33))
    assert host.status() == 1
    host.write(8, struct.pack("<I", 6))
    assert host.say(command()) is None
    assert host.say(command(), 6) is not None


def test_the_watchdog_lets_go_and_stays_so_until_it_is_cleared(host: Host):
    host.write(9, struct.pack("<I", 400))  # 20 ms
    host.say(ENABLE)
    for _ in range(10):
        host.say(command(t=0x900), wait_s=0.01)
    assert host.status() == 1
    host.wait(0.015)
    assert host.status() == 0xD
    assert host.motor.tau_nm == 0.0
    host.say(ENABLE)
    assert host.status() == 0xD
    host.say(CLEAR)
    assert host.status() == 0
    host.say(ENABLE)
    assert host.status() == 1


def test_with_no_watchdog_it_goes_on_for_ever(host: Host):
    host.say(ENABLE)
    host.say(command(t=0x900), wait_s=2.0)
    assert host.status() == 1


def test_work_warms_it_until_it_lets_go_and_clearing_does_not_help_while_it_is_hot(host: Host):
    host.motor.heat_k_s = 100.0
    host.say(ENABLE)
    host.say(command(t=0xFFF), wait_s=1.5)
    assert host.status() == 0xC
    assert host.motor.winding_c > 2 * AMBIENT_C
    host.motor.winding_c = host.motor.registers[2] + 5.0
    host.say(CLEAR)
    assert host.status() == 0xC


@pytest.mark.parametrize(("volts", "status"), [(14.0, 9), (33.0, 8), (24.0, 0)])
def test_it_tells_of_its_supply(host: Host, volts: float, status: int):
    host.motor.volts = volts
    host.wait(0.01)
    assert host.status() == status


@pytest.mark.parametrize(
    ("flaw", "status"), [("hot", 0xC), ("low_volts", 9), ("over_current", 0xA)]
)
def test_flaws_that_it_tells_of(host: Host, flaw, status: int):
    host.motor.suffer(flaw)
    host.wait(0.01)
    host.say(ENABLE)
    assert host.status() == status


def test_flaws_that_it_does_not_tell_of(host: Host):
    host.shaft.qd_rad_s = 10.0
    host.motor.suffer("slow_speed")
    answer = host.say(bytes.fromhex("0500cc0000000000"), 0x7FF)
    assert answer is not None
    assert -30 + 60 * (answer[3] << 4 | answer[4] >> 4) / 4095 == pytest.approx(5.0, abs=0.1)
    host.motor.suffer("wrong_range")
    assert host.read(21) == 6.25
    host.motor.suffer("wrong_mode")
    host.say(ENABLE)
    assert host.status() == 0
    host.motor.suffer("short_frames")
    assert len(host.say(command()) or b"") == 6
    host.motor.trouble.short = False
    host.motor.trouble.loses = 2
    assert [host.say(command()) is None for _ in range(4)] == [True, True, False, False]
    host.motor.suffer("silent")
    assert host.say(command()) is None


def test_every_flaw_can_be_had(host: Host):
    for flaw in FLAWS:
        host.motor.suffer(flaw)


def test_noise_does_not_disturb_it(host: Host):
    import random

    draw = random.Random(4)
    for _ in range(3000):
        number = draw.choice((5, 5, 0x7FF, 0x15, draw.randrange(0x800)))
        host.node.send(CanFrame(number, draw.randbytes(draw.randrange(9))), host.wire.now_s)
        host.wait(0.0005)
    for frame in host.heard:
        assert len(frame.data) == 8
