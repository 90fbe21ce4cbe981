"""What the robot says that is told to stop and has nothing to stop is true."""

from types import SimpleNamespace
from typing import cast

import pytest

from executive.engine.estop import EmergencyStop
from executive.engine.executive import Executive
from executive.frontends.prompt.stance import standing
from executive.frontends.prompt.view import View


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
