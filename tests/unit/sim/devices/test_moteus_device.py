"""The emulated moteus: its reference's words, and the maker's client, which drives it."""

import asyncio
import math
import struct
from collections.abc import Iterator
from pathlib import Path

import pytest

from robot.clock import WallClock
from sim.devices.can_motor import FLAWS
from sim.devices.moteus import CURRENT, DRIVER_FAULT, FAULT, POSITION, STOPPED, TIMEOUT, Moteus
from sim.devices.server import CanServer
from sim.devices.shaft import FreeShaft
from sim.devices.wire import CanFrame, Wire
from tests.fakes.served import PATIENCE_S, Playing, until

can = pytest.importorskip("can")
client = pytest.importorskip("moteus")

TURN = 2.0 * math.pi


class Host:
    """A wire of CAN FD with one motor on it, and somebody who talks to it."""

    def __init__(self) -> None:
        self.wire = Wire(data_bitrate_hz=5e6)
        self.heard: list[CanFrame] = []
        self.node = self.wire.attach(lambda frame, _: self.heard.append(frame))
        self.shaft = FreeShaft(friction_nm_s=0.02)
        self.motor = Moteus(self.wire, self.shaft, 5, 0, 20.0, 50.0, 17.0)

    def say(self, data: str, *, ident: int = 0x8005, wait_s: float = 0.002) -> str:
        """Its answer in hexadecimal digits, if any."""
        self.heard.clear()
        self.node.send(CanFrame(ident, bytes.fromhex(data), ident > 0x7FF, True), self.wire.now_s)
        self.wait(wait_s)
        return self.heard[-1].data.hex() if self.heard else ""

    def wait(self, wait_s: float) -> None:
        until_s = self.wire.now_s + wait_s
        while self.wire.now_s < until_s - 1e-9:
            now_s = min(until_s, self.wire.now_s + 0.0005)
            self.wire.advance(now_s)
            self.motor.live(now_s)

    def position(self, *values: float, wait_s: float = 0.002) -> None:
        """A command in the mode "position": registers 0x020 and up, as floats."""
        data = struct.pack(f"<BBB BBB {len(values)}f", 1, 0, 10, 0x0C, len(values), 0x20, *values)
        self.say(data.hex(), wait_s=wait_s)

    def console(self, line: str) -> str:
        text = line.encode() + b"\n"
        self.say((bytes((0x40, 1, len(text))) + text).hex(), ident=5)
        answer = bytes.fromhex(self.say("420130"))
        assert answer[:2] == b"\x41\x01"
        return answer[3 : 3 + answer[2]].decode()


@pytest.fixture
def host() -> Host:
    return Host()


def test_the_example_of_the_reference_means_what_is_written_beside_it(host: Host):
    """`01000a07206000200150ff140400130d`: position 3.456 deg, 25.92 deg/s, -1.76 N m."""
    host.motor.console.settings["servo.pid_position.kp"] = 0.0
    host.motor.console.settings["servo.pid_position.kd"] = 0.0
    answer = host.say("01000a07206000200150ff140400130d")
    assert (host.heard[0].id, host.heard[0].extended, host.heard[0].fd) == (0x500, False, True)
    assert host.motor._ordered.q_rad == pytest.approx(math.radians(3.456))
    assert host.motor._ordered.qd_rad_s == pytest.approx(math.radians(25.92))
    assert host.motor.tau_nm == pytest.approx(-1.76)
    assert answer.startswith("240400")  # four integers of 16 bits from register 0 on
    assert answer[22:26] == "230d"  # three of 8 bits from 0x00d on
    assert int(answer[26:28], 16) == 48  # 24 V


def test_nobody_is_answered_who_does_not_ask_for_it(host: Host):
    assert host.say("140400", ident=0x0005) == ""
    assert host.say("140400", ident=0x8006) == ""
    assert host.say("140400", ident=0x8705) != ""
    assert host.heard[0].id == 0x507


def test_one_with_a_high_identifier_answers_under_29_bits():
    host = Host()
    host.motor.motor_id = 9
    assert host.say("140400", ident=0x8009) != ""
    assert (host.heard[0].id, host.heard[0].extended) == (0x900, True)


def test_a_command_makes_it_start_and_then_go_there(host: Host):
    host.motor.console.settings |= {"servo.pid_position.kp": 60.0, "servo.pid_position.kd": 6.0}
    host.position(0.25, 0.0, wait_s=0.0002)
    assert host.motor.mode not in (STOPPED, POSITION)
    for _ in range(300):
        host.position(0.25, 0.0)
    assert host.motor.mode == POSITION
    assert host.shaft.q_rad == pytest.approx(0.25 * TURN, abs=0.05)
    host.say("010000")
    assert host.motor.mode == STOPPED
    assert host.motor.tau_nm == 0.0


def test_its_target_moves_on_at_the_velocity_of_the_command(host: Host):
    host.motor.console.settings |= {"servo.pid_position.kp": 200.0, "servo.pid_position.kd": 20.0}
    host.position(0.0, 0.5, 0.0, 1.0, 1.0, math.nan, math.nan, math.nan, wait_s=0.4)
    assert host.shaft.q_rad == pytest.approx(0.2 * TURN, abs=0.1)


def test_gains_are_shares_of_its_settings_and_torque_ends_at_the_most(host: Host):
    host.motor.console.settings |= {"servo.pid_position.kp": TURN, "servo.pid_position.kd": 0.0}
    host.position(1.0, 0.0, 0.0, 0.5, 0.0)
    host.position(host.shaft.q_rad / TURN + 1.0, 0.0, 0.0, 0.5, 0.0, wait_s=0.0004)
    assert host.motor._ordered.kp == pytest.approx(0.5)
    host.position(1.0, 0.0, 0.0, 1.0, 0.0, 0.25)
    assert host.motor.tau_nm == pytest.approx(0.25)


def test_after_its_timeout_it_brakes_until_it_is_stopped(host: Host):
    """With the damping of its last command."""
    host.motor.console.settings |= {"servo.pid_position.kp": 0.0, "servo.pid_position.kd": 6.0}
    for _ in range(20):
        host.position(0.0, 0.0, 1.0, 1.0, 0.2, math.nan, math.nan, 0.02)
    assert host.motor.is_on
    host.wait(0.019)
    assert host.motor.mode == TIMEOUT
    speed = host.shaft.qd_rad_s
    assert speed > 0.1
    host.wait(0.2)
    assert abs(host.shaft.qd_rad_s) < 0.1 * speed
    host.position(0.0)
    assert host.motor.mode == TIMEOUT
    host.say("010000")
    host.position(0.0)
    assert host.motor.mode == POSITION


def test_a_command_without_a_timeout_counts_as_long_as_the_setting_says(host: Host):
    host.position(0.0)
    host.wait(0.09)
    assert host.motor.mode == POSITION
    host.wait(0.02)
    assert host.motor.mode == TIMEOUT


def test_a_fault_stays_until_it_is_stopped(host: Host):
    host.position(0.0)
    host.motor.trouble.status = DRIVER_FAULT
    host.wait(0.002)
    assert host.say("1100110f") == "210001210f21"  # mode 1, fault 33
    host.motor.trouble.status = None
    host.position(0.0)
    assert host.motor.mode == FAULT
    host.say("010000")
    assert host.say("1100110f") == "210000210f00"


def test_registers_it_does_not_have_or_does_not_take_are_refused_by_number(host: Host):
    assert host.say("11b003") == "31b00301"
    assert host.say("010105") == "300102"
    assert host.say("01000f" + "010010") == "300003"
    assert host.say("118202") == "31820201"  # only as 32 bits
    assert host.say("198202") == "2982020500" + "0000"


@pytest.mark.parametrize("cut", range(1, 16))
def test_frames_that_are_cut_short_do_no_harm(host: Host, cut: int):
    host.say("01000a07206000200150ff140400130d"[: 2 * cut])
    host.say("01000a0720600020"[: 2 * cut])


def test_its_console_says_and_takes_settings(host: Host):
    assert host.console("conf get servo.default_timeout_s") == "0.100000\r\n"
    assert host.console("conf set servo.pid_position.kp 314.159") == "OK\r\n"
    assert host.console("conf get servo.pid_position.kp") == "314.159000\r\n"
    assert host.console("conf get servo.nothing").startswith("ERR")
    assert host.say("420130") == "410100"
    host.motor.reboot()
    assert host.motor.console["servo.pid_position.kp"] == 4.0


def test_it_calls_its_position_zero_and_keeps_that(host: Host):
    host.shaft.q_rad = 1.0
    assert host.console("d cfg-set-output 0") == "OK\r\n"
    assert host.console("conf write") == "OK\r\n"
    host.motor.reboot()
    assert host.say("1d01") == "2d0100000000"


@pytest.mark.parametrize("flaw", FLAWS)
def test_every_flaw_makes_another_motor(flaw):
    fine, broken = Host(), Host()
    for one in (fine, broken):
        one.shaft.q_rad, one.shaft.qd_rad_s = 1.0, 1.0
    broken.motor.suffer(flaw)
    for one in (fine, broken):
        one.wait(0.001)

    def seen(one: Host) -> list[object]:
        words = [one.say("14040014030d"), one.say("0d2700000040" + "1d27")]
        line = b"conf get servopos.position_max\n"
        one.say((bytes((0x40, 1, len(line))) + line).hex(), ident=5)
        return [*words, one.say("420130")]

    assert (seen(fine) != seen(broken)) == (flaw != "twin")


# --- the maker's client ------------------------------------------------------------------------


class Served(Playing):
    """Two motors on a wire behind a socket, played by a thread."""

    def __init__(self, folder: Path) -> None:
        clock = WallClock()
        self.wire = Wire(data_bitrate_hz=5e6, now_s=clock.now_s())
        self.motors = [
            Moteus(self.wire, FreeShaft(friction_nm_s=0.02), i, 0, 20.0, 50.0, 17.0)
            for i in (1, 12)
        ]
        self.path = folder / "can0"
        super().__init__(CanServer([(self.path, self.wire)], self.motors, clock))


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served(tmp_path)
    yield made
    made.close()


async def drives(served: Served) -> None:
    """Settings by its console, the mode "position" with its timeout, faults, a stop."""
    transport = client.PythonCan(channel=str(served.path), interface="humanoid", fd=True)
    knee, hip = (client.Controller(id=i, transport=transport) for i in (1, 12))
    register, first = client.Register, served.motors[0]
    asked = await knee.custom_query({register.REGISTER_MAP_VERSION: client.INT32})
    assert asked.values[register.REGISTER_MAP_VERSION] == 5
    console = client.Stream(knee, use_flow_control=False)
    await console.command(b"conf set servo.pid_position.kp 60")
    await console.command(b"conf set servo.pid_position.kd 6")
    assert await console.command(b"conf get servo.pid_position.kp", allow_any_response=True) == (
        b"60.000000"
    )
    assert first.console["servo.pid_position.kd"] == 6.0

    async def goes_to(turns: float) -> None:
        while True:
            told = await knee.set_position(
                position=turns, velocity=0.0, kp_scale=0.5, kd_scale=1.0, maximum_torque=9.0,
                watchdog_timeout=5.0, query=True,
            )  # fmt: skip
            if told.values[register.POSITION] == pytest.approx(turns, abs=0.005):
                break
        assert told.values[register.MODE] == client.Mode.POSITION
        assert told.values[register.VOLTAGE] == 24.0

    await goes_to(0.25)
    await goes_to(-0.1)
    assert first.shaft.q_rad == pytest.approx(-0.1 * TURN, abs=0.05)
    assert first._ordered.kp == pytest.approx(30.0 / TURN)
    assert served.motors[1].mode == STOPPED
    told = await hip.query()
    assert (told.id, told.values[register.POSITION]) == (12, 0.0)
    first.trouble.status = DRIVER_FAULT
    until(lambda: first.mode == FAULT)
    assert (await knee.query()).values[register.FAULT] == DRIVER_FAULT
    first.trouble.status = None
    await knee.set_stop()
    await knee.set_output_exact(position=0.0)
    assert (await knee.query()).values[register.POSITION] == pytest.approx(0.0, abs=1e-3)
    transport.close()


def test_the_makers_client_asks_sets_moves_and_stops_it(served: Served):
    asyncio.run(asyncio.wait_for(drives(served), PATIENCE_S))
    assert served.motors[0].mode == STOPPED


def test_somebody_elses_mode_is_one_it_does_not_leave_by_a_position(host: Host):
    host.motor.suffer("wrong_mode")
    host.position(0.0)
    assert host.motor.mode == CURRENT
