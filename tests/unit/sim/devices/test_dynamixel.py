"""An emulated servo does what the e-manual says, on a line whose bytes take their time."""

import math

import pytest

from sim.devices.dynamixel import PULSE_RAD, SPEED_RAD_S, Kind, Servo
from sim.devices.dynamixel_codec import crc, status
from sim.devices.serial_line import BITS_A_BYTE, THINKS_S, Line
from sim.devices.shaft import FreeShaft

XM430 = Kind(1020, 4.1, 2.3, 46 * 2 * math.pi / 60, 2.69e-3, 1193)
BAUD = 1_000_000


def told(to: int, code: int, parameters: bytes = b"") -> bytes:
    length = len(parameters) + 3
    whole = bytes((0xFF, 0xFF, 0xFD, 0, to, length & 0xFF, length >> 8, code)) + parameters
    check = crc(whole)
    return whole + bytes((check & 0xFF, check >> 8))


def read(to: int, address: int, size: int) -> bytes:
    return told(to, 2, address.to_bytes(2, "little") + size.to_bytes(2, "little"))


def write(to: int, address: int, data: bytes) -> bytes:
    return told(to, 3, address.to_bytes(2, "little") + data)


class Desk:
    """Servos on a line, and simulated time."""

    def __init__(self, *numbers: int) -> None:
        self.line, self.now_s = Line(baud_hz=BAUD), 0.0
        self.shafts = [FreeShaft(inertia_kg_m2=0.02) for _ in numbers]
        pairs = zip(numbers, self.shafts, strict=True)
        self.servos = [Servo(XM430, shaft, number) for number, shaft in pairs]
        self.line.servos += self.servos
        for servo in self.servos:
            servo.memory.put(9, 1, 0)

    def play(self, for_s: float) -> bytes:
        heard = b""
        ends_s = self.now_s + for_s
        while self.now_s < ends_s - 1e-9:
            self.now_s += 0.001
            heard += self.line.advance(self.now_s)
            self.line.live(self.now_s)
        return heard

    def ask(self, data: bytes, for_s: float = 0.002) -> bytes:
        self.line.write(data, self.now_s)
        return self.play(for_s)

    def set(self, address: int, data: bytes, number: int = 1) -> int:
        return self.ask(write(number, address, data))[8]

    def run(self, mode: int) -> None:
        assert self.set(11, bytes((mode,))) == 0
        assert self.set(64, b"\1") == 0


def test_it_answers_a_ping_as_in_the_manual():
    desk = Desk(1)
    desk.servos[0].memory.put(0, 2, 1030)
    desk.servos[0].memory.put(6, 1, 38)
    assert desk.ask(told(1, 1)).hex(" ").upper() == "FF FF FD 00 01 07 00 55 00 06 04 26 65 5D"


def test_bytes_take_their_time_and_the_return_delay_comes_before_the_answer():
    desk = Desk(1)
    desk.servos[0].memory.put(9, 1, 250)
    asked = read(1, 132, 4)
    desk.line.write(asked, 0.0)
    begins_s = len(asked) * BITS_A_BYTE / BAUD + 500e-6 + THINKS_S
    assert desk.line.advance(begins_s + 9e-6) == b""
    assert len(desk.line.advance(begins_s + 10.5e-6)) == 1
    assert len(desk.line.advance(begins_s + 15 * 10e-6 + 1e-6)) == 14


def test_eeprom_is_locked_while_torque_is_on():
    desk = Desk(1)
    desk.run(3)
    assert desk.set(11, b"\0") == 7
    assert desk.set(64, b"\0") == 0
    assert desk.set(11, b"\0") == 0


@pytest.mark.parametrize(
    ("address", "data", "error"),
    [
        (132, b"\0\0\0\0", 7),  # read only
        (116, b"\0\0", 5),  # half a value
        (98, b"\xfe", 4),  # -2
        (11, b"\x07", 4),  # no such mode
        (102, (1200).to_bytes(2, "little"), 6),  # over the limit of current
        (116, (4096).to_bytes(4, "little"), 6),  # over the limit of position
    ],
)
def test_what_cannot_be_written_is_refused_by_number(address: int, data: bytes, error: int):
    assert Desk(1).set(address, data) == error


def test_nobody_answers_a_packet_with_a_wrong_crc_or_for_another():
    desk = Desk(1)
    spoilt = bytearray(read(1, 132, 4))
    spoilt[9] ^= 1
    assert desk.ask(bytes(spoilt)) == b""
    assert desk.line.crc_errors == 1
    assert desk.ask(read(2, 132, 4)) == b""


def test_position_control_gets_there_and_a_profile_limits_its_speed():
    desk = Desk(1)
    desk.run(3)
    goal = 2048 + 600
    desk.set(116, goal.to_bytes(4, "little"))
    desk.play(1.5)
    assert desk.shafts[0].q_rad == pytest.approx(600 * PULSE_RAD, abs=0.01)
    desk.set(108, (20).to_bytes(4, "little"))
    desk.set(112, (30).to_bytes(4, "little"))
    desk.set(116, (2048).to_bytes(4, "little"))
    fastest = 0.0
    for _ in range(300):
        desk.play(0.01)
        fastest = max(fastest, abs(desk.shafts[0].qd_rad_s))
    assert fastest == pytest.approx(30 * SPEED_RAD_S, rel=0.15)
    assert desk.shafts[0].q_rad == pytest.approx(0.0, abs=0.01)


def test_velocity_control_turns_as_fast_as_it_is_told():
    desk = Desk(1)
    desk.run(1)
    desk.set(104, (60).to_bytes(4, "little"))
    desk.play(1.0)
    assert desk.shafts[0].qd_rad_s == pytest.approx(60 * SPEED_RAD_S, rel=0.05)


def test_current_control_gives_its_torque_until_speed_takes_it():
    desk = Desk(1)
    desk.run(0)
    desk.set(102, (100).to_bytes(2, "little"))
    desk.play(0.01)
    assert desk.servos[0].tau_nm == pytest.approx(100 * XM430.step_nm, rel=0.01)
    desk.play(3.0)
    assert desk.shafts[0].qd_rad_s < XM430.speed_rad_s
    assert desk.servos[0].tau_nm < 50 * XM430.step_nm


def test_a_goal_current_limits_current_based_position_control():
    desk = Desk(1)
    desk.run(5)
    desk.set(102, (50).to_bytes(2, "little"))
    desk.set(116, (2048 + 1000).to_bytes(4, "little"))
    desk.play(0.005)
    assert desk.servos[0].tau_nm == pytest.approx(50 * XM430.step_nm, rel=0.01)


def test_the_bus_watchdog_stops_it_and_refuses_goals_until_it_is_cleared():
    desk = Desk(1)
    desk.run(0)
    desk.set(98, b"\x02")
    desk.set(102, (100).to_bytes(2, "little"))
    desk.play(0.036)
    assert desk.servos[0].tau_nm > 0.0
    desk.play(0.01)
    assert desk.servos[0].tau_nm == 0.0
    assert desk.ask(read(1, 98, 1))[9] == 0xFF
    assert desk.set(102, b"\1\0") == 4
    assert desk.set(98, b"\x02") == 4
    assert desk.set(98, b"\0") == 0
    assert desk.set(102, b"\1\0") == 0


@pytest.mark.parametrize(
    ("spoil", "bit"),
    [
        (lambda servo: setattr(servo, "volts", 9.0), 0),
        (lambda servo: setattr(servo, "winding_c", 90.0), 2),
        (lambda servo: servo.suffer("overload"), 5),
    ],
)
def test_hardware_errors_raise_the_alert_and_what_shuts_it_down_wants_a_reboot(spoil, bit: int):
    desk = Desk(1)
    desk.run(0)
    spoil(desk.servos[0])
    desk.play(0.002)
    answer = desk.ask(read(1, 70, 1))
    assert answer[8] == 0x80
    assert answer[9] >> bit & 1
    shuts = bool(52 >> bit & 1)
    assert desk.servos[0].is_on != shuts
    if shuts:
        assert desk.set(64, b"\1") == 0x81
        desk.servos[0].trouble.error, desk.servos[0].winding_c = 0, 25.0
        desk.ask(told(1, 8))
        assert desk.set(64, b"\1") == 0


def test_a_blocked_servo_at_its_limit_falls_into_an_overload():
    desk = Desk(1)
    desk.shafts[0]._gained = 0.0  # nothing moves it
    desk.servos[0].heat_k_s = 0.0
    desk.run(0)
    desk.set(102, (1193).to_bytes(2, "little"))
    desk.play(1.9)
    assert desk.servos[0].is_on
    desk.play(0.2)
    assert not desk.servos[0].is_on


def test_after_a_reboot_it_knows_where_it_is_within_one_turn_only():
    desk = Desk(1)
    desk.shafts[0].q_rad = 7.0
    assert desk.servos[0].read(132, 4)[1] == (2048 + int(7.0 / PULSE_RAD)).to_bytes(4, "little")
    desk.ask(told(1, 8))
    there = int.from_bytes(desk.servos[0].read(132, 4)[1], "little")
    assert there == 2048 + int(7.0 / PULSE_RAD) - 4096


def test_sync_reads_are_answered_in_order_and_end_at_the_first_that_is_missing():
    desk = Desk(1, 2, 3)
    asked = told(0xFE, 0x82, bytes((146, 0, 1, 0, 3, 1, 2)))
    answer = desk.ask(asked, 0.005)
    assert [answer[i + 4] for i in range(0, len(answer), 12)] == [3, 1, 2]
    desk.servos[0].trouble.silent = True
    answer = desk.ask(asked, 0.005)
    assert [answer[i + 4] for i in range(0, len(answer), 12)] == [3]


def test_fast_sync_reads_are_one_packet_with_a_crc_for_each():
    desk = Desk(1, 2)
    answer = desk.ask(told(0xFE, 0x8A, bytes((146, 0, 1, 0, 1, 2))), 0.005)
    assert answer[:8] == bytes((0xFF, 0xFF, 0xFD, 0, 0xFE, 11, 0, 0x55))
    assert (answer[9], answer[10], answer[14], answer[15]) == (1, 25, 2, 25)
    for end in (11, 16):
        assert crc(answer[:end]) == answer[end] | answer[end + 1] << 8


def test_two_of_one_identifier_are_not_understood_unless_they_say_the_same():
    desk = Desk(1, 1)
    desk.shafts[1].q_rad = 0.5
    assert desk.ask(read(1, 132, 4)) != status(1, 0, desk.servos[0].read(132, 4)[1])
    assert desk.line.collisions == 1


def test_who_talks_while_a_servo_answers_spoils_both():
    desk = Desk(1)
    desk.line.write(read(1, 0, 100), 0.0)
    desk.line.advance(0.0005)
    desk.line.write(read(1, 132, 4), 0.0005)
    heard = desk.line.advance(0.005)
    assert desk.line.collisions == 1
    assert crc(heard[:-2]) != heard[-2] | heard[-1] << 8


def test_junk_on_the_line_is_passed_over():
    desk = Desk(1)
    for junk in (b"\xff" * 9, b"\xff\xff\xfd\x00\x01\xff\xff\x02", b"\xff\xff\xfd\x00\x01\x02\x00"):
        desk.ask(junk + bytes(1100), 0.02)
        assert desk.ask(read(1, 146, 1))[-3] == 25
