"""`humanoid motors` of Dynamixel servos: what it says of emulated ones."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.errors import ConfigError
from tests.fakes.dynamixel_rig import ARM


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM)
    return path


def motors(*words):
    return CliRunner().invoke(app, ["motors", *map(str, words)])


@pytest.mark.live
def test_what_servos_measure_is_read_once(file):
    result = motors("read", "--map", file, "--emulated", "--json")
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert told["emulated"] is True
    assert [row["joint"] for row in told["joints"]] == ["shoulder", "elbow", "wrist"]
    for row in told["joints"]:
        assert row["status"] == "disabled"
        assert row["supply_v"] == pytest.approx(12.0)


@pytest.mark.usefixtures("workbench")
def test_a_check_names_what_disagrees_with_its_cure_and_fails(file):
    flaws = ("--fail", "elbow=wrong_model", "--fail", "wrist=twin", "--fail", "shoulder=silent")
    result = motors("check", "--map", file, "--emulated", "--for", 1, *flaws)
    assert result.exit_code == 1
    for said in (
        "elbow: it is a model 1060, the map says XM540-W150",
        "wrist: it does not tell its state: its answers are spoilt",
        "shoulder: servo 1 on the port 'arm' does not answer",
        "Not one motor may be enabled",
    ):
        assert said in result.stdout


def test_a_flaw_that_there_is_not_is_refused(file):
    result = motors("read", "--map", file, "--emulated", "--fail", "wrist=slient")
    assert isinstance(result.exception, ConfigError)
    assert "did you mean 'silent'" in str(result.exception)


@pytest.mark.usefixtures("workbench")
def test_jog_zero_and_log_say_what_they_did_to_emulated_servos(file, tmp_path):
    moved = motors(
        "jog", "elbow", "--by", 0.2, "--torque", 0.4, "--map", file, "--emulated", "--json"
    )
    assert moved.exit_code == 0, moved.output
    jog = json.loads(moved.stdout)["jog"]
    assert jog["to_rad"] - jog["from_rad"] == pytest.approx(0.2, abs=0.1)
    assert jog["most_nm"] <= jog["limit_nm"] == pytest.approx(2.4)
    found = motors("zero", "wrist", "--at", 0.1, "--in-motor", "--map", file, "--emulated")
    assert found.exit_code == 0, found.output
    assert "Its motor calls this position zero from now on." in found.stdout
    assert "Write offset_rad: 0.1000 at wrist" in found.stdout
    path = tmp_path / "log.csv"
    logged = motors("log", path, "--for", 0.3, "--map", file, "--emulated")
    assert logged.exit_code == 0, logged.output
    assert len(path.read_text().splitlines()) > 25
