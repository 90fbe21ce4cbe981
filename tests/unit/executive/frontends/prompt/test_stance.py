"""What the robot says that is told to stop and has nothing to stop is true."""

from types import SimpleNamespace
from typing import cast

import pytest

from executive.blackboard import HEALTH
from executive.engine.estop import EmergencyStop
from executive.engine.executive import Executive
from executive.frontends.prompt.stance import standing
from executive.frontends.prompt.view import View
from executive.health import Level
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.waiting import eventually


def executive_with(mode: str | None, estop: EmergencyStop | None = None) -> Executive:
    body = SimpleNamespace(mode=mode) if mode else None
    board = SimpleNamespace(read=lambda _key: body)  # type: ignore[reportUnknownLambdaType]
    robot = SimpleNamespace(board=board, estop=estop or EmergencyStop())
    return cast("Executive", robot)


@pytest.mark.parametrize(
    ("mode", "view", "words"),
    [
        ("stand", View(), "I stand already."),
        ("stand", View(low=True), "squat"),
        ("fallen", View(), "lie on the floor; nothing moves. Say “get up”"),
        ("damping", View(), "damped"),
        ("walk", View(), "coming to a stand"),
        ("stand", View(mode="gone"), "gone"),
        (None, View(), "not moving"),
    ],
)
def test_it_says_how_it_is(mode: str | None, view: View, words: str) -> None:
    assert words in standing(executive_with(mode), view)


def test_it_says_that_the_emergency_stop_is_on() -> None:
    estop = EmergencyStop()
    estop.press()
    assert "emergency stop" in standing(executive_with("stand", estop), View())


def test_an_emergency_stop_is_shown_as_it_is_while_time_stands_still(tmp_path):
    said: list[str] = []
    with puppet_shell(tmp_path, said, kind="fast") as shell:
        robot = shell.robot
        shell.line("estop")
        assert eventually(lambda: "emergency stop" in robot.view.unwell)
        shell.line("estop release")
        robot.submit(shell.understand("nod"))  # is refused, and the tick that does sees the stop
        robot.wait()
        assert robot.executive.board.read(HEALTH).failure is not None
        shell.line("estop reset")
        assert eventually(lambda: robot.view.level is Level.OK)
        said.clear()
        shell.line("how are you?")
        assert not any("emergency stop" in one for one in said)
