"""`humanoid motors`: what it says of emulated motors, and of what cannot be meant."""

import json
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.errors import ConfigError, DriverError
from robot.model import identified
from tests.fakes.can_rig import ARM, MOTEUS

CROWDED = ARM.replace("rate_hz: 500", "rate_hz: 1000")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM)
    return path


def motors(*words):
    return CliRunner().invoke(app, ["motors", *map(str, words)])


@pytest.mark.usefixtures("workbench")
def test_a_check_of_sound_motors_says_so_and_that_they_are_emulated(file):
    result = motors("check", "--map", file, "--emulated", "--for", 1)
    assert result.exit_code == 0, result.output
    assert "All 3 motors are what the map says (emulated)." in result.stdout
    assert "40%" in result.stdout  # 3 joints, 270 µs each, 500 times a second


@pytest.mark.usefixtures("workbench")
def test_a_check_names_what_disagrees_with_its_cure_and_fails(file):
    flaws = ("--fail", "elbow=wrong_range", "--fail", "wrist=twin", "--fail", "shoulder=silent")
    result = motors("check", "--map", file, "--emulated", "--for", 1, *flaws)
    assert result.exit_code == 1
    for said in (
        "elbow: its position range is 6.25 (register 21), the map expects 12.5",
        "wrist: 2 motors answer as motor 3 on the bus 'arm'",
        "shoulder: motor 1 on the bus 'arm' does not answer",
        "cure: check its power, its cable and its id",
        "Not one motor may be enabled",
    ):
        assert said in result.stdout


@pytest.mark.usefixtures("workbench")
def test_a_check_compares_speeds_with_positions(file):
    result = motors("check", "--map", file, "--emulated", "--fail", "wrist=slow_speed", "--json")
    assert result.exit_code == 1
    told = json.loads(result.stdout)
    assert told["emulated"] is True
    (finding,) = [one for one in told["check"]["findings"] if one["is_grave"]]
    assert (finding["joint"], finding["code"]) == ("wrist", "speed_mismatch")


@pytest.mark.live
def test_scan_read_and_watch_tell_who_is_there_and_what_they_measure(file):
    scanned = motors("scan", "--map", file, "--emulated", "--up-to", 20, "--json")
    assert scanned.exit_code == 0, scanned.output
    found = json.loads(scanned.stdout)["motors"]
    assert [(one["joint"], one["id"], one["reply_id"]) for one in found] == [
        ("shoulder", 1, 17), ("elbow", 2, 18), ("wrist", 3, 19),
    ]  # fmt: skip
    assert found[2]["ranges"] == [12.5, 30.0, 10.0]
    read = motors("read", "--map", file, "--emulated", "--fail", "wrist=silent", "--json")
    assert read.exit_code == 1
    shoulder, _, wrist = json.loads(read.stdout)["joints"]
    assert (shoulder["status"], shoulder["supply_v"]) == ("disabled", 24.0)
    assert shoulder["q_rad"] == pytest.approx(0.25, abs=0.15)
    assert (wrist["status"], wrist["q_rad"]) == ("silent", None)
    watched = motors("watch", "--map", file, "--emulated", "--for", 0.5, "--every", 0.1)
    assert watched.exit_code == 0, watched.output
    assert "shoulder" in watched.stdout  # how often, the machine decides: its clock is the real one
    assert "all is well (emulated)" in watched.stdout


@pytest.mark.usefixtures("workbench")
def test_every_command_knows_moteus_on_a_bus_of_can_fd(tmp_path):
    file = tmp_path / "arm.yaml"
    file.write_text(MOTEUS)
    scanned = motors("scan", "--map", file, "--emulated", "--up-to", 20, "--json")
    assert scanned.exit_code == 0, scanned.output
    found = json.loads(scanned.stdout)["motors"]
    assert [(one["joint"], one["id"], one["version"]) for one in found] == [
        ("shoulder", 1, 0x010B), ("wrist", 3, 0x010B), ("elbow", 12, 0x010B),
    ]  # fmt: skip
    checked = motors("check", "--map", file, "--emulated", "--for", 1)
    assert checked.exit_code == 0, checked.output
    assert "All 3 motors are what the map says (emulated)." in checked.stdout
    assert "33%" in checked.stdout  # 211 µs of two joints and 234 of one, 500 times a second
    read = motors("read", "--map", file, "--emulated", "--json")
    told = json.loads(read.stdout)["joints"][2]
    assert (told["status"], told["supply_v"], told["driver_c"]) == ("disabled", 24.0, 25.0)
    watched = motors("watch", "--map", file, "--emulated", "--for", 0.5, "--every", 0.1)
    assert "all is well (emulated)" in watched.stdout, watched.output
    moved = motors("jog", "elbow", "--by", 0.2, "--map", file, "--emulated", "--json")
    assert moved.exit_code == 0, moved.output
    jog = json.loads(moved.stdout)["jog"]
    assert jog["to_rad"] - jog["from_rad"] == pytest.approx(0.2, abs=0.06)
    zeroed = motors("zero", "wrist", "--at", 0.5, "--in-motor", "--map", file, "--emulated")
    assert "Write offset_rad: 0.5000 at wrist" in zeroed.stdout, zeroed.output


def test_a_bus_of_can_fd_that_is_not_there_is_set_up_with_both_rates():
    result = motors("scan", "--channel", "nocan7", "--data-bitrate", 5_000_000)
    assert isinstance(result.exception, DriverError)
    told = "ip link set nocan7 up type can bitrate 1000000 dbitrate 5000000 fd on"
    assert told in str(result.exception)


@pytest.mark.usefixtures("workbench")
def test_two_that_answer_to_one_identifier_are_seen_by_a_scan(file):
    scanned = motors("scan", "--map", file, "--emulated", "--up-to", 5, "--fail", "elbow=twin")
    assert scanned.exit_code == 1
    assert "2 motors answer to 2 on arm" in scanned.stdout


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["check", "--robot", "g1"], "has no joint map"),
        (["check", "--fail", "elbow=silent"], "only emulated motors fail on request"),
        (["read", "--emulated", "--fail", "elbow"], "names no flaw"),
        (["read", "--emulated", "--fail", "elbow=silnt"], "did you mean 'silent'"),
        (["watch", "--emulated", "--fail", "elbwo=silent"], "there is no joint 'elbwo'"),
        (["scan", "--map", "nowhere.yaml"], "there is no such file"),
        (["jog", "elbwo", "--by", "0.1", "--emulated"], "did you mean 'elbow'"),
        (["zero", "elbwo", "--emulated"], "did you mean 'elbow'"),
    ],
)
def test_what_cannot_be_meant_is_said_with_its_cure(file, words, said):
    named = words if {"--robot", "--map"} & set(words) else [*words, "--map", str(file)]
    result = motors(*named)
    assert isinstance(result.exception, ConfigError)
    assert said in str(result.exception)


def test_a_bus_that_cannot_carry_its_rate_is_refused_with_the_buses_that_could(file):
    file.write_text(CROWDED)
    result = motors("check", "--map", file, "--emulated")
    assert isinstance(result.exception, ConfigError)
    assert "2 buses are needed" in str(result.exception)


def test_a_bus_that_is_not_there_is_an_error_with_the_command_that_sets_it_up():
    result = motors("scan", "--channel", "nocan7")
    assert isinstance(result.exception, DriverError)
    assert "ip link set nocan7 up type can bitrate 1000000" in str(result.exception)


@pytest.mark.usefixtures("workbench")
def test_jog_zero_and_log_say_what_they_did_to_emulated_motors(file, tmp_path):
    moved = motors("jog", "elbow", "--by", 0.2, "--map", file, "--emulated", "--json")
    assert moved.exit_code == 0, moved.output
    jog = json.loads(moved.stdout)["jog"]
    assert jog["to_rad"] - jog["from_rad"] == pytest.approx(0.2, abs=0.06)
    assert jog["most_nm"] <= jog["limit_nm"] == pytest.approx(8.0)
    found = motors("zero", "elbow", "--at", 1.0, "--in-motor", "--map", file, "--emulated")
    assert found.exit_code == 0, found.output
    stands = re.search(r"elbow stands at (\S+) rad", found.stdout)
    assert stands is not None
    assert float(stands[1]) == pytest.approx(1.2, abs=0.06)
    assert "Write offset_rad: 1.0000 at elbow" in found.stdout
    path = tmp_path / "log.csv"
    logged = motors("log", path, "--for", 0.3, "--map", file, "--emulated")
    assert logged.exit_code == 0, logged.output
    assert len(path.read_text().splitlines()) > 50


def test_a_log_does_not_replace_a_file(file, tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("kept")
    result = motors("log", path, "--map", file, "--emulated")
    assert isinstance(result.exception, ConfigError)
    assert "there already" in str(result.exception)
    assert path.read_text() == "kept"


@pytest.mark.parametrize(
    "command",
    ["scan", "read", "check", "watch", ["zero", "elbow"], ["jog", "elbow", "--by", 0.1],
     ["log", "new.csv"]],
)  # fmt: skip
def test_a_bus_of_a_map_is_opened_only_if_the_user_lets_robots_open_it(file, command, monkeypatch):
    """A map may be a stranger's: it could name any interface, that of another machine too."""
    monkeypatch.setattr("can.Bus", lambda **_: pytest.fail("it was opened"))
    file.write_text(ARM.replace("channel: can0", "channel: tcp.example, interface: socketcand"))
    assert "interface: socketcand" in file.read_text()
    words = [command] if isinstance(command, str) else command
    result = motors(*words, "--map", file)
    assert isinstance(result.exception, DriverError)
    assert isinstance(result.exception, ConfigError)  # nothing broke: status 2, and its own cure
    assert not Path("new.csv").exists()
    assert 'devices = ["socketcand:tcp.example"]' in str(result.exception)


def test_the_map_that_is_shipped_is_for_every_motor_of_juno():
    from robot.drivers.motors import motor_map
    from robot.drivers.motors.can import joint_map
    from robot.model import description

    juno = description.load("juno")
    found = joint_map.load(juno.path().with_name(joint_map.FILE))
    assert list(motor_map.of_robot(found, juno.motor_names).joints) == list(juno.motor_names)
    for name, motor in juno.motors.items():
        assert found.joints[name].torque_limit_nm == motor.torque_limit_nm
        assert found.joints[name].velocity_limit_rad_s == motor.velocity_limit_rad_s


@pytest.mark.usefixtures("workbench")
def test_identify_says_what_a_worn_joint_is_like_and_writes_it_only_where_it_is_told(
    file, tmp_path
):
    words = ("identify", "shoulder", "--map", file, "--emulated", "--fail", "shoulder=worn")
    kept = tmp_path / "found.yaml"
    result = motors(*words, "--to", kept, "--json")
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert told["emulated"] is True
    found = told["identified"]
    assert found["friction_nm"] == pytest.approx(0.2, rel=0.25)
    assert found["backlash_rad"] == pytest.approx(0.004, rel=0.25)
    assert found["delay_s"] == pytest.approx(0.005, abs=0.0015)
    (joint,) = identified.read(kept).values()
    assert joint.friction_nm == pytest.approx(found["friction_nm"], rel=1e-4)
    assert not file.with_name(identified.FILE).exists()


def test_identify_refuses_servos_and_joints_that_there_are_not(file):
    result = motors("identify", "elbwo", "--map", file, "--emulated")
    assert "did you mean 'elbow'" in str(result.exception)
    servos = "robot/model/juno/dynamixel.yaml"
    result = motors("identify", "left_elbow", "--map", servos, "--emulated")
    assert isinstance(result.exception, ConfigError)
    assert "identify knows motors on CAN" in str(result.exception)
