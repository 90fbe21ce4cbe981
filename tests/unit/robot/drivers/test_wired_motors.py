"""How a process's wiring decides over what the motors of a description are driven."""

from pathlib import Path

import pytest

from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.ethernet.driver import EthernetMotors
from robot.drivers.motors.pwm_and_others import PwmAndOthers
from robot.drivers.motors.servos_and_others import ServosAndOthers
from robot.drivers.registry import MOTORS
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.model import description
from tests.fakes.motors import FakePlant

JUNO = description.load("juno")


def wiring(driver: str, emulated: Path | None) -> Wiring:
    robot = JUNO.driven_by(driver)
    plant = FakePlant(len(robot.motors)) if emulated is not None else None
    return Wiring(
        robot=robot, clock=SimulatedClock(), bus=LocalBus(), plant=plant, emulated=emulated
    )


def test_emulated_ones_are_reached_in_the_plants_folder_whatever_the_map_names(tmp_path):
    on_can = MOTORS.make(wiring("can", tmp_path))
    assert isinstance(on_can, CanMotors)
    assert list(on_can.joints.joints) == list(JUNO.motor_names)
    assert {Path(at).parent for at in on_can.joints.channels.values()} == {tmp_path}
    both = MOTORS.make(wiring("dynamixel", tmp_path))
    assert isinstance(both, ServosAndOthers)
    for part in (both.servos, both.others):
        assert {Path(at).parent for at in part.joints.channels.values()} == {tmp_path}
    by_net = MOTORS.make(wiring("ethernet", tmp_path))
    assert isinstance(by_net, EthernetMotors)
    assert list(by_net.joints.joints) == list(JUNO.motor_names)
    assert {Path(at).parent for at in by_net.joints.channels.values()} == {tmp_path}
    by_pulses = MOTORS.make(wiring("pwm", tmp_path))
    assert isinstance(by_pulses, PwmAndOthers)
    assert {Path(chip.emulated).parent for chip in by_pulses.servos.joints.chips.values()} == {
        tmp_path
    }
    names = {*both.servos.joints.joints, *both.others.joints.joints}
    assert names == set(JUNO.motor_names)


@pytest.mark.parametrize("driver", ["can", "dynamixel", "ethernet", "pwm"])
def test_real_ones_are_opened_only_if_the_user_lets_robots_open_them(driver):
    """A description may be a stranger's."""
    with pytest.raises(DriverError, match="devices = "):
        MOTORS.make(wiring(driver, None))
