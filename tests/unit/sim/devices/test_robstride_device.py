"""The emulated RobStride: its manual's words, and the maker's client, which drives it."""

import struct
from collections.abc import Iterator
from pathlib import Path

import pytest

from robot.clock import WallClock
from sim.devices.can_motor import FLAWS
from sim.devices.robstride import TRIPS_C, RobStride
from sim.devices.server import CanServer
from sim.devices.shaft import FreeShaft
from sim.devices.wire import CanFrame, Wire
from tests.fakes.served import Playing, until

PI4 = 12.566370614359172
can = pytest.importorskip("can")
client = pytest.importorskip("robstride_dynamics")


class Host:
    """A wire with one motor on it, and somebody who talks to it."""

    def __init__(self) -> None:
        self.wire = Wire()
        self.heard: list[CanFrame] = []
        self.node = self.wire.attach(lambda frame, _: self.heard.append(frame))
        self.shaft = FreeShaft(friction_nm_s=0.02)
        self.motor = RobStride(self.wire, self.shaft, 5, 0, PI4, 44.0, 17.0)

    def say(
        self, kind: int, data: bytes = bytes(8), beside: int = 0xFD, wait_s: float = 0.001
    ) -> CanFrame | None:
        """Its answer, if any."""
        self.heard.clear()
        self.node.send(CanFrame(kind << 24 | beside << 8 | 5, data, extended=True), self.wire.now_s)
        self.wait(wait_s)
        return self.heard[-1] if self.heard else None

    def wait(self, wait_s: float) -> None:
        until_s = self.wire.now_s + wait_s
        while self.wire.now_s < until_s - 1e-9:
            now_s = min(until_s, self.wire.now_s + 0.0005)
            self.wire.advance(now_s)
            self.motor.live(now_s)

    def torque(self, share: float) -> CanFrame:
        """Its answer to a command that is torque alone."""
        answer = self.say(1, bytes.fromhex("7fff7fff00000000"), beside=int((share + 1) * 32767.5))
        assert answer is not None
        return answer

    def bits(self) -> int:
        """Mode and faults, told without doing anything."""
        answer = self.say(0x12, struct.pack("<HHHH", 0x7026, 0, 1, 0))
        assert answer is not None
        assert answer.id & 0xFF00FFFF == 0x020005FD
        return answer.id >> 16 & 0xFF

    def read(self, number: int, layout: str = "<f") -> float:
        answer = self.say(0x11, struct.pack("<H6x", number))
        assert answer is not None
        assert answer.id == 0x110005FD
        return struct.unpack_from(layout, answer.data, 4)[0]

    def write(self, number: int, layout: str, value: float) -> None:
        assert (
            self.say(0x12, struct.pack("<HH", number, 0) + struct.pack(layout, value)) is not None
        )


@pytest.fixture
def host() -> Host:
    return Host()


def test_it_is_in_reset_when_it_gets_power_and_obeys_nothing(host: Host):
    assert host.torque(1.0).id == 0x020005FD
    host.wait(0.05)
    assert host.shaft.qd_rad_s == 0.0


def test_enabled_it_gives_the_torque_it_is_told_up_to_its_limit(host: Host):
    answer = host.say(3)
    assert answer is not None
    assert answer.id >> 16 & 0xFF == 0x80
    host.torque(1.0)
    assert host.motor.tau_nm == pytest.approx(17.0)
    host.write(0x700B, "<f", 4.0)
    host.wait(0.002)
    assert host.motor.tau_nm == pytest.approx(4.0)
    host.say(4)
    assert host.motor.tau_nm == 0.0


def test_it_goes_where_it_is_told(host: Host):
    host.say(3)
    for _ in range(300):
        host.say(1, struct.pack(">4H", int((1.0 / PI4 + 1) * 32767.5), 0x7FFF, 2600, 13000), 0x7FFF)
    assert host.shaft.q_rad == pytest.approx(1.0, abs=0.05)
    assert host.read(0x7019) == pytest.approx(host.shaft.q_rad, abs=0.01)


def test_its_watchdog_is_off_as_it_is_sold_and_stops_it_once_it_is_set(host: Host):
    host.say(3)
    host.wait(1.0)
    assert host.bits() == 0x80
    host.write(0x7028, "<I", 400)  # 20 ms
    host.torque(0.1)
    host.wait(0.015)
    assert host.motor.is_on
    host.wait(0.01)
    assert not host.motor.is_on
    assert host.motor.tau_nm == 0.0


def test_a_fault_is_told_by_itself_and_kept_until_it_is_cleared(host: Host):
    host.say(3)
    host.heard.clear()
    host.motor.winding_c = TRIPS_C + 5.0
    host.wait(0.002)
    assert [frame.id >> 24 for frame in host.heard] == [0x15]
    assert host.bits() == 0x04
    host.motor.winding_c = 30.0
    assert host.say(3) is not None
    assert host.bits() == 0x04
    host.say(4, b"\x01" + bytes(7))
    host.say(3)
    assert host.bits() == 0x80


def test_it_reports_every_10_ms_if_it_is_told_to(host: Host):
    host.say(0x18, bytes((1, 2, 3, 4, 5, 6, 1, 0)))
    host.heard.clear()
    host.wait(0.1)
    assert 9 <= sum(frame.id >> 24 == 0x18 for frame in host.heard) <= 11
    host.say(0x18, bytes((1, 2, 3, 4, 5, 6, 0, 0)))
    host.heard.clear()
    host.wait(0.05)
    assert not host.heard


def test_a_parameter_that_it_does_not_have_is_said_to_fail(host: Host):
    answer = host.say(0x11, struct.pack("<H6x", 0x7777))
    assert answer is not None
    assert answer.id >> 16 == 0x1101


def test_a_mode_is_not_changed_while_it_runs(host: Host):
    host.say(3)
    host.write(0x7005, "<I", 1)
    assert host.read(0x7005, "<B") == 0


@pytest.mark.parametrize("flaw", FLAWS)
def test_every_flaw_is_another_motor(flaw):
    fine, broken = Host(), Host()
    for one in (fine, broken):
        one.shaft.q_rad, one.shaft.qd_rad_s = 1.0, 1.0
    broken.motor.suffer(flaw)
    for one in (fine, broken):
        one.wait(0.001)

    def seen(one: Host) -> list[object]:
        words = [one.say(3), one.say(0x11, struct.pack("<H6x", 0x7005))]
        one.say(0x12, struct.pack("<HHI", 0x7028, 0, 400))
        return [*words, one.say(0x11, struct.pack("<H6x", 0x7028))]

    assert (seen(fine) != seen(broken)) == (flaw != "twin")


# --- the maker's client ------------------------------------------------------------------------


class Served(Playing):
    """Two motors on a wire behind a socket, played by a thread."""

    def __init__(self, folder: Path) -> None:
        clock = WallClock()
        self.wire = Wire(now_s=clock.now_s())
        self.motors = [
            RobStride(self.wire, FreeShaft(friction_nm_s=0.02), i, 0, PI4, 44.0, 17.0)
            for i in (1, 2)
        ]
        self.path = folder / "can0"
        super().__init__(CanServer([(self.path, self.wire)], self.motors, clock))


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served(tmp_path)
    yield made
    made.close()


def test_the_makers_client_enables_moves_and_asks_it(served: Served):
    bus = client.RobstrideBus("can0", {"knee": client.Motor(1, "rs-02")})
    bus.channel_handler = can.Bus(interface="humanoid", channel=str(served.path))
    try:
        assert bus.read_id("knee")[0] & 0xFF == 1
        assert bus.read("knee", client.ParameterType.TORQUE_LIMIT) == 17.0
        bus.write("knee", client.ParameterType.CAN_TIMEOUT, 1_200_000)
        until(lambda: served.motors[0].parameters[0x7028] == 1_200_000)
        bus.enable("knee")
        assert served.motors[0].is_on
        assert not served.motors[1].is_on

        def goes_to(angle_rad: float) -> bool:
            bus.write_operation_frame("knee", angle_rad, 20.0, 1.0)
            return bus.read_operation_frame("knee")[0] == pytest.approx(angle_rad, abs=0.02)

        until(lambda: goes_to(1.5))
        until(lambda: goes_to(-0.5))
        assert served.motors[1].shaft.q_rad == 0.0
    finally:
        bus.disconnect()
    until(lambda: not served.motors[0].is_on)
