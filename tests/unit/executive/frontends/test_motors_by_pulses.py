"""`humanoid motors` of hobby servos: what it says of chips, and that it says nothing of servos."""

import json
from pathlib import Path

import msgspec
import pytest
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.control.loop import NEEDS
from robot.drivers.body_devices import BodyDevices
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError, DeviceNotAllowed, DriverError
from robot.model import description
from tests.fakes.motors import FakePlant
from tests.fakes.pwm_rig import HEAD


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "head.yaml"
    path.write_text(HEAD)
    return path


def motors(*words):
    return CliRunner().invoke(app, ["motors", *map(str, words)])


@pytest.mark.live
def test_chips_are_found_and_servos_have_nothing_to_say(file):
    found = motors("scan", "--map", file, "--emulated", "--json")
    assert found.exit_code == 0, found.output
    (chip,) = json.loads(found.stdout)["motors"]
    assert (chip["bus"], chip["id"], chip["joint"]) == ("hat", 64, "yaw, pitch, jaw")
    told = motors("read", "--map", file, "--emulated", "--json")
    for row in json.loads(told.stdout)["joints"]:
        assert row["status"] == "no_pulse"
        assert row["q_rad"] is row["winding_c"] is None
    checked = motors("check", "--map", file, "--emulated", "--for", 0.3)
    assert checked.exit_code == 0, checked.output
    assert "nothing is measured: where joints are is where they were sent" in checked.stdout
    assert "a PCA9685 has no watchdog" in checked.stdout
    assert "The chips of 3 servos answer (emulated); the servos say nothing." in checked.stdout


@pytest.mark.usefixtures("workbench")
@pytest.mark.parametrize(("flaw", "said"), [("silent", "Remote I/O"), ("stuck", "timed out")])
def test_a_chip_that_does_not_answer_is_said_with_its_cure(file, flaw, said):
    result = motors("read", "--map", file, "--emulated", "--fail", f"yaw={flaw}")
    assert isinstance(result.exception, DriverError)
    assert said in str(result.exception)
    assert "i2cdetect -y 1" in str(result.exception)


@pytest.mark.usefixtures("workbench")
@pytest.mark.parametrize("command", [("jog", "yaw", "--by", 0.1), ("zero", "yaw")])
def test_what_takes_a_measurement_is_refused(file, command):
    result = motors(*command, "--map", file, "--emulated")
    assert isinstance(result.exception, ConfigError)
    assert "the motor of yaw does not say where it is" in str(result.exception)


def test_a_bus_is_opened_only_if_the_user_lets_robots(file):
    result = motors("read", "--map", file)
    assert isinstance(result.exception, DeviceNotAllowed)
    assert 'devices = ["/dev/i2c-1"]' in str(result.exception)


def test_a_robot_of_hobby_servos_alone_is_refused_by_the_controller(tmp_path):
    """Head and hands are all that it has: its controller needs motors that measure."""
    juno = description.load("juno").driven_by("pwm")
    joint = (
        "chip: {chip}, model: X, id: {id}, travel_rad: 6, lower_rad: -2.9, upper_rad: 2.9, "
        "velocity_limit_rad_s: 5, torque_limit_nm: 1"
    )
    lines = [
        f"  {name}: {{{joint.format(chip=f'c{k // 16}', id=k % 16)}}}"
        for k, name in enumerate(juno.motor_names)
    ]
    chips = "\n".join(f"  c{k}: {{bus: {k}, address: 64}}" for k in range(3))
    (tmp_path / "pwm.yaml").write_text(f"chips:\n{chips}\njoints:\n" + "\n".join(lines) + "\n")
    alone = msgspec.structs.replace(
        juno, folder=str(tmp_path), groups={**juno.groups, "head": juno.motor_names}
    )
    plant = FakePlant(len(juno.motors))
    wiring = Wiring(
        robot=alone, clock=SimulatedClock(), bus=LocalBus(), plant=plant, emulated=tmp_path
    )
    with pytest.raises(DriverError, match="lack what its controller needs: gains, position, torqu"):
        BodyDevices(wiring, needs=NEEDS)
