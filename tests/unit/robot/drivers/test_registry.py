"""A description names its drivers; what it names wrongly is told with the cure."""

import re
import shutil
from pathlib import Path

import msgspec
import pytest

from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers import registry
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError
from robot.model import description
from robot.model.ownership import BusOwner

JUNO = Path(description.__file__).parent / "juno"


@pytest.fixture
def robot(tmp_path):
    """Juno with other drivers."""

    def load(drivers: str):
        folder = tmp_path / "juno"
        shutil.copytree(JUNO, folder, dirs_exist_ok=True)
        path = folder / "juno.yaml"
        text, count = re.subn(r"(?m)^drivers: .*\n", drivers, path.read_text())
        assert count == 1
        path.write_text(text)
        return description.load(str(path))

    return load


def line_of(robot, word: str) -> int:
    lines = robot.path().read_text().splitlines()
    return next(k for k, line in enumerate(lines, 1) if word in line)


def test_the_shipped_robot_names_every_device():
    juno = description.load("juno")
    simulated = [one for one in registry.FAMILIES if registry.SIMULATED in one.drivers]
    assert set(juno.drivers) == {family.device for family in simulated}
    registry.check(juno)


def test_what_is_not_named_is_simulated(robot):
    unnamed = robot("")
    registry.check(unnamed)
    wiring = Wiring(robot=unnamed, clock=SimulatedClock(), bus=LocalBus())
    there = [sense for sense in registry.SENSES if sense.is_there(unnamed)]
    assert {"camera", "lidar", "battery"} <= {sense.device for sense in there}
    for sense in there:
        assert sense.is_simulated(unnamed)
        simulated = sense.drivers[registry.SIMULATED](wiring)
        assert type(sense.make(wiring)) is type(simulated)


def test_what_is_not_named_and_not_simulated_is_told(robot):
    wiring = Wiring(robot=robot(""), clock=SimulatedClock(), bus=LocalBus())
    nobody_s = registry.Family("nose", {"serial": lambda _wiring: None})
    with pytest.raises(ConfigError) as caught:
        nobody_s.make(wiring)
    (problem,) = caught.value.problems
    assert problem.message == "no driver of the device 'nose' is named, and nobody simulates it"
    assert "serial" in problem.suggestion
    assert problem.file == str(wiring.robot.path())


@pytest.mark.parametrize(
    ("drivers", "word", "message", "cure"),
    [
        ("drivers:\n  imu: simulated\n  motors: simulatd\n", "simulatd",
         "unknown driver 'simulatd' of the device 'motors'", "did you mean 'simulated'?"),
        ("drivers:\n  motrs: simulated\n", "motrs",
         "unknown device 'motrs' in drivers", "did you mean 'motors'?"),
    ],
)  # fmt: skip
def test_an_unknown_name_is_told_with_file_line_and_the_nearest(
    robot, drivers, word, message, cure
):
    wrong = robot(drivers)
    wiring = Wiring(robot=wrong, clock=SimulatedClock(), bus=LocalBus())
    for ask in (lambda: registry.check(wrong), lambda: registry.MOTORS.make(wiring)):
        with pytest.raises(ConfigError) as caught:
            ask()
        (problem,) = caught.value.problems
        assert problem.message == message
        assert problem.suggestion == cure
        assert problem.file == str(wrong.path())
        assert problem.line == line_of(wrong, word)


@pytest.mark.parametrize(
    ("driver", "usual"),
    [("", False), ("can", True), ("ethernet", True), ("dynamixel", False), ("pwm", False)],
)
def test_motors_are_owned_as_is_usual_for_their_driver_or_as_the_description_says(driver, usual):
    robot = description.load("juno").driven_by(driver)
    assert registry.is_owned(robot) == usual
    for enabled in (True, False):
        said = msgspec.structs.replace(robot, bus_owner=BusOwner(enabled=enabled))
        assert registry.is_owned(said) == enabled
