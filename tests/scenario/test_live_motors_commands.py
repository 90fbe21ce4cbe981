"""`humanoid motors check`, `jog` and `zero` as people run them: a process, and the wall's clock."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.fakes import can_rig, dynamixel_rig, ethernet_rig
from tests.fakes.waiting import HANG_S

pytestmark = pytest.mark.live

MAPS = {"can": can_rig.ARM, "servos": dynamixel_rig.ARM, "ethernet": ethernet_rig.ARM}
BY_RAD, OFF_RAD = 0.2, 0.1
"""How far the elbow is asked to go, and how much of that its weak motor may leave."""


@pytest.fixture(params=MAPS)
def file(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    path = tmp_path / "arm.yaml"
    path.write_text(MAPS[request.param])
    return path


def begun(file: Path, *words: object) -> subprocess.Popen[str]:
    given = (*map(str, words), "--map", str(file), "--emulated")
    return subprocess.Popen(
        [sys.executable, "-m", "executive", "motors", *given],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=file.parent,
    )  # fmt: skip


def ended(file: Path, *words: object, status: int = 0) -> str:
    with begun(file, *words) as process:
        out, err = process.communicate(timeout=HANG_S)
    assert process.returncode == status, out + err
    assert "Traceback" not in err
    return out


def test_a_check_says_that_all_motors_are_what_the_map_says(file):
    assert "motors are what the map says (emulated)" in ended(file, "check", "--for", 1)


def test_a_check_of_a_motor_that_does_not_answer_fails_with_its_cure(file):
    told = json.loads(
        ended(file, "check", "--for", 1, "--fail", "elbow=silent", "--json", status=1)
    )
    grave = {one["joint"]: one for one in told["check"]["findings"] if one["is_grave"]}
    assert grave["elbow"]["cure"]


def test_a_jog_moves_its_joint_and_lets_go(file):
    told = ended(file, "jog", "elbow", "--by", BY_RAD, "--torque", 0.4, "--json")
    jog = json.loads(told)["jog"]
    assert jog["ending"] == "there"
    assert jog["to_rad"] - jog["from_rad"] == pytest.approx(BY_RAD, abs=OFF_RAD)
    assert jog["most_nm"] <= jog["limit_nm"]


def test_ctrl_c_ends_a_jog_on_its_way_and_the_motor_lets_go(file):
    """At this speed it would take 20 s."""
    with begun(file, "jog", "elbow", "--by", BY_RAD, "--speed", 0.01) as process:
        assert process.stdout is not None
        first = process.stdout.readline()
        assert first.startswith("Moving elbow"), first
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=HANG_S)
    assert process.returncode == 1, out + err
    assert "elbow: stopped on request" in out
    assert "Its motor has let go." in out
    assert "Traceback" not in err


def test_a_zero_says_what_to_write_into_the_map(file):
    assert "Write offset_rad: 0.1000 at wrist" in ended(
        file, "zero", "wrist", "--at", 0.1, "--in-motor"
    )
