"""The executive of a prompt is killed: the prompt comes back on the same terminal, and goes on."""

import os
import signal
from pathlib import Path

import pytest

from executive.journal.journal import read
from tests.fakes.executives import executives
from tests.fakes.terminal import CTRL_C, CTRL_D, CTRL_U, ENTER, TAB, UP, Terminal
from tests.fakes.waiting import eventually

pytestmark = pytest.mark.live


@pytest.mark.slow
def test_the_prompt_survives_its_executive(tmp_path: Path):
    run = tmp_path / "run"
    with Terminal("repl", "--world", "empty", "--run-dir", str(run), folder=tmp_path) as terminal:
        assert terminal.shows("`help` shows what can be said")
        terminal.enter("walk two metres forward")
        terminal.enter("say hello")
        terminal.enter("then squat for 1 second")
        assert terminal.shows("walk | ")
        terminal.press("half a li")
        assert terminal.shows("> half a li")
        first, *_ = executives(terminal.process.pid)
        os.kill(first, signal.SIGKILL)
        assert terminal.shows("The executive was killed by SIGKILL")
        assert terminal.shows("The prompt is back")
        assert first not in executives(terminal.process.pid)
        assert terminal.shows("walk | ")  # the job that was open goes on

        terminal.press("pau" + TAB)  # keys and completion work as before
        assert terminal.shows("> pause")
        terminal.press(CTRL_U)  # Ctrl-C would stop the robot
        assert eventually(lambda: "> pause" not in terminal.text)
        terminal.press(UP)
        assert terminal.shows("> then squat")  # so does the history
        terminal.press(CTRL_U)
        assert terminal.shows("squat for 1 s: done")
        terminal.press(CTRL_D)
        assert eventually(lambda: terminal.process.poll() is not None)
        assert terminal.process.returncode == 0
    events = read(run)
    assert [event.n for event in events] == list(range(len(events)))
    done = [event.data["step"] for event in events if event.event == "done"]
    assert done.count("walk 2 m forward") == 1
    assert sum(event.event == "said" for event in events) == 1
    assert {e.data["mode"] for e in events if e.event == "pose" and "mode" in e.data} == {
        "stand", "walk",
    }  # fmt: skip


@pytest.mark.slow
@pytest.mark.rest
def test_what_the_robot_was_told_holds_for_the_executive_that_takes_over(tmp_path: Path):
    run = tmp_path / "run"
    with Terminal("repl", "--world", "empty", "--run-dir", str(run), folder=tmp_path) as terminal:
        assert terminal.shows("`help` shows what can be said")
        terminal.enter("walk two metres forward")
        assert terminal.shows("walk | ")
        terminal.enter("pause")
        assert terminal.shows("paused: nothing moves")
        _kill_and_come_back(terminal)
        terminal.enter("estop")
        assert terminal.shows("Emergency stop.")
        _kill_and_come_back(terminal)
        terminal.enter("nod")
        assert terminal.shows("The emergency stop is on, and nothing moves")
        terminal.press(CTRL_D)
        assert eventually(lambda: terminal.process.poll() is not None)
    events = read(run)
    done = [event.data["step"] for event in events if event.event == "done"]
    assert "walk 2 m forward" not in done
    assert "nod" not in done


@pytest.mark.slow
@pytest.mark.rest
def test_what_is_typed_while_the_executive_is_replaced_is_heard(tmp_path: Path):
    run = tmp_path / "run"
    with Terminal("repl", "--world", "empty", "--run-dir", str(run), folder=tmp_path) as terminal:
        assert terminal.shows("`help` shows what can be said")
        terminal.enter("walk three metres forward")
        assert terminal.shows("walk | ")
        terminal.enter("wait")
        assert terminal.shows("Shall I go on with “walk three metres forward”?")
        _kill_and_come_back(terminal)
        assert eventually(lambda: terminal.text.count("Shall I go on with") == 2)
        terminal.enter("yes")
        assert terminal.shows("walk | ")
        _kill(terminal)
        terminal.press(CTRL_C)
        assert terminal.shows("Stop is heard")
        assert terminal.shows("The prompt is back; what was open is stopped")
        terminal.press(CTRL_D)
        assert eventually(lambda: terminal.process.poll() is not None)
        assert terminal.process.returncode == 0
    jobs = {e.data["job"]: e.data["state"] for e in read(run) if e.event == "job"}
    assert jobs == {1: "cancelled"}


@pytest.mark.slow
@pytest.mark.rest
def test_who_leaves_while_the_executive_is_replaced_leaves(tmp_path: Path):
    run = tmp_path / "run"
    with Terminal("repl", "--world", "empty", "--run-dir", str(run), folder=tmp_path) as terminal:
        assert terminal.shows("`help` shows what can be said")
        terminal.enter("walk three metres forward")
        assert terminal.shows("walk | ")
        _kill(terminal)
        terminal.press("nod" + ENTER + CTRL_D)
        assert eventually(lambda: terminal.process.poll() is not None)
        assert terminal.process.returncode == 0


@pytest.mark.slow
@pytest.mark.rest
def test_a_term_while_the_executive_is_replaced_ends_the_prompt_that_comes_back(tmp_path: Path):
    run = tmp_path / "run"
    with Terminal("repl", "--world", "empty", "--run-dir", str(run), folder=tmp_path) as terminal:
        assert terminal.shows("`help` shows what can be said")
        _kill(terminal)
        terminal.process.send_signal(signal.SIGTERM)
        assert eventually(lambda: terminal.process.poll() is not None)
        assert terminal.shows("what was open is stopped")


def _kill(terminal: Terminal) -> None:
    first, *_ = executives(terminal.process.pid)
    before = terminal.text.count("killed by SIGKILL")
    os.kill(first, signal.SIGKILL)
    assert eventually(lambda: terminal.text.count("killed by SIGKILL") > before)


def _kill_and_come_back(terminal: Terminal) -> None:
    before = terminal.text.count("The prompt is back")
    _kill(terminal)
    assert eventually(lambda: terminal.text.count("The prompt is back") > before)
