"""`humanoid motors` of boards behind Ethernet: what it says of emulated ones."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.errors import DeviceNotAllowed
from tests.fakes.ethernet_rig import ARM


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM)
    return path


def motors(*words):
    return CliRunner().invoke(app, ["motors", *map(str, words)])


@pytest.mark.live
def test_boards_say_which_drives_they_have_and_what_these_measure(file):
    found = motors("scan", "--map", file, "--emulated", "--json")
    assert found.exit_code == 0, found.output
    seen = {(row["bus"], row["id"]): row for row in json.loads(found.stdout)["motors"]}
    assert {key: row["joint"] for key, row in seen.items()} == {
        ("upper", 0): "elbow", ("upper", 1): "shoulder", ("lower", 5): "wrist",
    }  # fmt: skip
    told = motors("read", "--map", file, "--emulated", "--json")
    assert told.exit_code == 0, told.output
    for row in json.loads(told.stdout)["joints"]:
        assert row["status"] == "disabled"
        assert row["supply_v"] == pytest.approx(48.0)
        assert row["winding_c"] == pytest.approx(25.0, abs=1.0)


@pytest.mark.usefixtures("workbench")
def test_a_check_names_what_disagrees_with_its_cure_and_fails(file):
    flaws = ("--fail", "elbow=weak", "--fail", "wrist=wrong_board")
    result = motors("check", "--map", file, "--emulated", "--for", 1, *flaws)
    assert result.exit_code == 1
    for said in (
        "elbow: its drive does 25 N m at the joint, the map says 40",
        "cure: torque_limit_nm: 25, or another drive",
        "is board 3, the map says 2",
        "Not one motor may be enabled",
    ):
        assert said in result.stdout


@pytest.mark.usefixtures("workbench")
def test_jog_zero_watch_and_log_say_what_they_did(file, tmp_path):
    moved = motors(
        "jog", "elbow", "--by", 0.2, "--torque", 0.4, "--map", file, "--emulated", "--json"
    )
    assert moved.exit_code == 0, moved.output
    jog = json.loads(moved.stdout)["jog"]
    assert jog["to_rad"] - jog["from_rad"] == pytest.approx(0.2, abs=0.1)
    assert jog["most_nm"] <= jog["limit_nm"] == pytest.approx(16.0)
    found = motors("zero", "wrist", "--at", 0.1, "--in-motor", "--map", file, "--emulated")
    assert found.exit_code == 0, found.output
    assert "Write offset_rad: 0.1000 at wrist" in found.stdout
    shown = motors("watch", "--map", file, "--emulated", "--for", 0.3, "--every", 0.1, "--json")
    assert shown.exit_code == 0, shown.output
    rows = [json.loads(line) for line in shown.stdout.splitlines()]
    assert {row["joint"] for row in rows[0]["joints"]} == {"shoulder", "elbow", "wrist"}
    path = tmp_path / "log.csv"
    logged = motors("log", path, "--for", 0.3, "--map", file, "--emulated")
    assert logged.exit_code == 0, logged.output
    assert len(path.read_text().splitlines()) > 50


@pytest.mark.parametrize("command", ["scan", "read", "check"])
def test_boards_are_talked_to_only_if_the_user_lets_robots(file, command):
    """A map may be a stranger's, and a datagram goes anywhere."""
    result = motors(command, "--map", file)
    assert isinstance(result.exception, DeviceNotAllowed)
    assert 'devices = ["udp:10.0.7.11:4310"]' in str(result.exception)
