"""Maps of boards: what cannot be meant is refused with its line and a cure."""

import pytest

from robot.drivers.motors.ethernet import load
from robot.drivers.motors.ethernet.driver import FAMILY
from robot.errors import ConfigError
from robot.model import description
from tests.fakes.ethernet_rig import ARM, arm


def refused(folder, old: str, new: str) -> str:
    assert old in ARM
    with pytest.raises(ConfigError) as caught:
        arm(folder, ARM.replace(old, new))
    return str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("10.0.7.11", "board1.local", "'board1.local' is no address of IP (write its number"),
        ("10.0.7.11", "/tmp/udp0", "'/tmp/udp0' is no address of IP"),
        ("10.0.7.11", "255.255.255.255", "is not the address of one board"),
        ("10.0.7.11", "239.1.2.3", "is not the address of one board"),
        ("10.0.7.11", "0.0.0.0", "is not the address of one board"),
        ("10.0.7.12", "10.0.7.11", "10.0.7.11:4310 is where 'upper' is already"),
        ("id: 0", "id: 1", "slot 1 of the board 'upper' is shoulder's already"),
        ("id: 0", "id: 16", "16"),
        ("board: lower", "board: lowr", "did you mean 'lower'"),
        ("lower_rad: 0.0, upper_rad: 2.4", "lower_rad: 2.4, upper_rad: 0", "exchange them"),
        ("rate_hz: 500", "rate_hz: 500\nwatchdog_s: 0.003", "at least 3 periods: 0.006"),
        ("ARM-40", "a model of mine, which is long", "model"),
        ("number: 2}", "number: 2}\n  spare: {address: 10.0.7.13, number: 3}", "leave it out"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, old, new, said):
    assert said in refused(tmp_path, old, new)


def test_links_that_cannot_carry_the_rate_are_refused_with_the_rate_that_they_can(tmp_path):
    said = refused(tmp_path, "number: 1}", "number: 1, link_hz: 1000000}")
    assert "2 joints at 500 Hz fill its link to 68%" not in said  # below what is safe
    assert "the last answer is there after" in said
    said = refused(tmp_path, "number: 1}", "number: 1, link_hz: 1000000, turn_s: 0.01}")
    assert "the last answer is there after" in said
    hz = int(said.rsplit(" or ", 1)[1].split(" Hz")[0])
    slower = ARM.replace("number: 1}", "number: 1, link_hz: 1000000, turn_s: 0.01}")
    assert arm(tmp_path, slower.replace("500", str(hz)) + "watchdog_s: 0.1\n").rate_hz == hz
    with pytest.raises(ConfigError, match="the last answer is there after"):
        arm(tmp_path, slower.replace("500", str(hz + 1)) + "watchdog_s: 0.1\n")
    said = refused(tmp_path, "rate_hz: 500", "rate_hz: 2000\nuplink_hz: 1000000")
    assert "2 boards at 2000 Hz fill the computer's link to" in said


def test_a_link_of_100_mbit_is_hardly_busy_and_its_bits_are_those_of_the_frames():
    board = load.BoardLink(joints=6, link_hz=1e8, turn_s=2e-4, ip=4)
    # header 28, six orders of 20, CRC 4; UDP 8, IP 20; Ethernet 14 + 4, preamble 8, gap 12
    assert board.command_bits == 8 * (28 + 120 + 4 + 8 + 20 + 14 + 4 + 8 + 12)
    assert board.answer_bits == 8 * (28 + 12 + 120 + 4 + 8 + 20 + 14 + 4 + 8 + 12)
    assert load.load(board, 500.0) == pytest.approx(500 * 8 * 230 / 1e8)
    empty = load.BoardLink(joints=0, link_hz=1e8, turn_s=0.0, ip=4)
    assert empty.command_bits == 8 * (8 + 14 + 4 + 12 + 28 + 32)
    assert load.answered_s([board] * 5, 1e8) < 0.0005


def test_junos_proposed_map_fits_it(tmp_path):
    juno = description.load("juno")
    joints = FAMILY.beside(juno)
    assert list(joints.joints) == list(juno.motor_names)
    assert max(joints.load(board) for board in joints.boards) < 0.02
