"""The process in the terminal and the executive below it: whoever dies, it ends in order."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.fakes.executives import executives
from tests.fakes.waiting import HANG_S, eventually

PARENT = """
import json, os, signal, sys
from pathlib import Path
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # the tests may be run under nohup,
signal.signal(signal.SIGINT, signal.default_int_handler)  # and in a shell's background
from dataclasses import replace
from robot.bringup import child, launcher, lowering
from robot.bringup.processes import EXECUTIVE, Process
lowering.lower = lambda run, clock: "the robot squatted; its motors damp"
launcher._Terminal.hear_stops = lambda self: print("Ctrl-C is a signal", flush=True)
STUB = "tests.fakes.stub_process"
three = (Process("plant", STUB, "simulation", death="plant_lost"),
         Process("controller", STUB, "always", death="controller_lost"))
if json.loads(sys.argv[1]).get("term_at_start"):
    born = child.subprocess.Popen.__init__
    def term(self, *words, **options):
        born(self, *words, **options)
        child.subprocess.Popen.__init__ = born
        os.kill(os.getpid(), signal.SIGTERM)
    child.subprocess.Popen.__init__ = term
executive = replace(EXECUTIVE, module="tests.fakes.fronts", spare_after_s=json.loads(sys.argv[2]))
ended = launcher.launch("", json.loads(sys.argv[1]), tell=print,
                        executive=executive, processes=three)
print("ended", ended.status, ended.reason)
sys.exit(ended.status)
"""


class Shell:
    """A terminal's shell, with the launcher as its job."""

    def __init__(self, folder: Path, *, spare_after_s: float = 60.0, **options) -> None:
        self.folder = folder
        options = {"folder": str(folder), **options}
        self.job = subprocess.Popen(
            [sys.executable, "-c", PARENT, json.dumps(options), json.dumps(spare_after_s)],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
        )  # fmt: skip

    @property
    def told(self) -> list[str]:
        path = self.folder / "told"
        return path.read_text().splitlines() if path.exists() else []

    def ups(self) -> list[int]:
        """Process ids of the executives that came up, in order."""
        return [int(line.split()[1]) for line in self.told if line.startswith("up")]

    def wait_up(self, count: int = 1) -> int:
        assert eventually(lambda: len(self.ups()) >= count), self.told
        return self.ups()[-1]

    def end(self) -> tuple[int, str]:
        """Exit status and output, once it has ended and all below it are gone."""
        text, _ = self.job.communicate(timeout=HANG_S)
        assert eventually(lambda: not self.left()), self.left()
        return self.job.returncode, text

    def left(self) -> list[str]:
        """Processes of the job that are still there."""
        found = []
        for entry in Path("/proc").iterdir():
            try:
                words = (entry / "cmdline").read_text(errors="replace").split("\0")
                state = (entry / "stat").read_text().rpartition(")")[2].split()
            except (OSError, NotADirectoryError):
                continue
            if str(self.job.pid) in words and state[0] != "Z":
                found.append(" ".join(words))
        return found


@pytest.fixture
def shell(tmp_path):
    shells = []

    def make(**options) -> Shell:
        shells.append(Shell(tmp_path, **options))
        return shells[-1]

    yield make
    for one in shells:
        if one.job.poll() is None:
            os.killpg(one.job.pid, signal.SIGKILL)


@pytest.mark.parametrize("status", [0, 1, 2, 3])
def test_the_executives_exit_status_is_the_shells(shell, status):
    assert shell(status=status).end()[0] == status


def test_ctrl_c_while_the_executive_is_loading_is_heeded(shell):
    """Before there is a robot, and before anybody could listen."""
    job = shell(ends=False, robot=False)
    loading = lambda: any("tests.fakes.fronts" in words for words in job.left())  # noqa: E731
    assert eventually(loading)
    os.killpg(job.job.pid, signal.SIGINT)
    status, text = job.end()
    assert status == 1
    assert text.startswith("Stopped on request.")
    assert "Traceback" not in text
    assert job.told == []


def test_ctrl_z_suspends_nobody_who_has_to_hear_a_stop(shell):
    job = shell(ends=False, dies=0, spare_after_s=0.0)
    first = job.wait_up()
    assert eventually(lambda: len(executives(job.job.pid, "tests.fakes.fronts")) == 2)
    os.killpg(job.job.pid, signal.SIGTSTP)
    os.kill(first, signal.SIGKILL)
    second = job.wait_up(2)  # launcher and spare go on as ever
    os.killpg(job.job.pid, signal.SIGTSTP)
    os.kill(second, signal.SIGINT)
    status, text = job.end()
    assert status == 1
    assert "Ctrl-Z does not suspend a robot" in text


def test_a_killed_executive_is_started_again_and_the_robot_stays(shell, tmp_path):
    job = shell(dies=1, ends=False)
    second = job.wait_up(2)
    pids = [
        int((tmp_path / "logs" / f"{name}.pid").read_text()) for name in ("plant", "controller")
    ]
    assert job.told[1] == f"up {second} 1"
    os.kill(pids[0], 0)
    os.kill(second, signal.SIGTERM)
    status, text = job.end()
    assert status == 1
    assert "The executive was killed by SIGKILL. The robot finishes its step and stands" in text
    heard, told = text.index("Ctrl-C is a signal"), text.index("The executive was killed")
    assert heard < told  # who reads the notice may press it at once
    assert (tmp_path / "logs" / "plant.log").read_text().count("ready") == 1


def test_the_one_that_takes_over_was_there_before(shell):
    job = shell(ends=False, dies=0, spare_after_s=0.0)
    first = job.wait_up()
    found = lambda: executives(job.job.pid, "tests.fakes.fronts")  # noqa: E731
    assert eventually(lambda: len(found()) == 2)
    (spare,) = set(found()) - {first}
    os.kill(first, signal.SIGKILL)
    second = job.wait_up(2)
    assert second == spare
    os.kill(second, signal.SIGTERM)
    assert job.end()[0] == 1


def test_a_stop_while_nobody_hears_is_told_to_the_one_that_takes_over(shell, tmp_path):
    job = shell(ends=False, dies=0, spare_after_s=0.0, deaf_at_first=True)
    first = job.wait_up()
    assert eventually(lambda: len(executives(job.job.pid, "tests.fakes.fronts")) == 2)
    os.kill(first, signal.SIGKILL)
    assert eventually(lambda: job.told[-1] == "deaf")
    os.killpg(job.job.pid, signal.SIGINT)
    (tmp_path / "hear").touch()
    second = job.wait_up(2)
    assert job.told[1:] == ["deaf", "told to stop", f"up {second} 1"]
    job.job.send_signal(signal.SIGTERM)  # now that it hears, the launcher passes wishes on
    status, text = job.end()
    assert status == 1
    assert "Stop is heard: the robot stands" in text
    assert job.told[-1] == "heard [15]"


@pytest.mark.parametrize("how", ["kill", pytest.param("exception", marks=pytest.mark.rest)])
def test_the_third_death_in_a_minute_is_the_last(shell, how):
    job = shell(dies=99, how=how)
    status, text = job.end()
    assert status == 3
    assert len(job.ups()) == 3
    assert "3 times within a minute; the robot squatted; its motors damp" in text


def test_a_mistake_before_there_is_a_robot_is_not_tried_again(shell):
    job = shell(dies=99, how="exception", robot=False)
    status, text = job.end()
    assert status == 3
    assert len(job.ups()) == 1
    assert "a mistake on purpose" in text


def test_a_dead_plant_is_told_to_the_executive(shell, tmp_path):
    job = shell(ends=False)
    job.wait_up()
    os.kill(int((tmp_path / "logs" / "plant.pid").read_text()), signal.SIGKILL)
    assert job.end()[0] == 3
    assert job.told[-1] == "lost plant_lost"


def test_ctrl_c_reaches_the_executive_once(shell):
    job = shell(ends=False)
    job.wait_up()
    os.killpg(job.job.pid, signal.SIGINT)
    assert job.end()[0] == 1
    assert job.told[-1] == "heard [2]"


def test_a_term_to_the_job_is_passed_on(shell):
    job = shell(ends=False)
    job.wait_up()
    job.job.send_signal(signal.SIGTERM)
    assert job.end()[0] == 1
    assert job.told[-1] == "heard [15]"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_a_wish_that_comes_to_the_launcher_alone_is_passed_on(shell, number):
    job = shell(ends=False)
    job.wait_up()
    job.job.send_signal(number)
    assert job.end()[0] == 1
    assert job.told[-1] == "heard [15]"


def test_a_term_that_comes_while_the_executive_is_started_is_heard(shell):
    job = shell(ends=False, robot=False, term_at_start=True)
    status, text = job.end()
    assert status == 1
    assert "Traceback" not in text
    assert job.told == []


def test_nobody_takes_over_from_one_that_dies_after_a_wish_to_stop(shell):
    job = shell(ends=False, deaf=True)
    first = job.wait_up()
    job.job.send_signal(signal.SIGTERM)
    assert eventually(lambda: job.told[-1] == "heard [15]")
    os.kill(first, signal.SIGKILL)
    assert job.end()[0] == 1
    assert len(job.ups()) == 1


def test_a_closed_terminal_is_a_wish_to_stop(shell):
    job = shell(ends=False)
    job.wait_up()
    os.killpg(job.job.pid, signal.SIGHUP)
    assert job.end()[0] == 1
    assert job.told[-1] == "heard [15]"


def test_nothing_is_left_of_a_job_that_is_killed(shell):
    job = shell(ends=False, spare_after_s=0.0)
    job.wait_up()
    assert eventually(lambda: len(job.left()) == 4)
    job.job.kill()
    job.job.wait()
    assert eventually(lambda: not job.left()), job.left()
