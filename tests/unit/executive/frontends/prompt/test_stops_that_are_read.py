"""Stops that only the grammar knows are heard where lines are read, not after those before them."""

from types import SimpleNamespace
from typing import Any

import pytest

from benchmarks.intents.replies import HOME
from executive.frontends.prompt.brake import Brake
from intents.dialogue import Dialogue
from intents.parser import asks_to_stop
from intents.stopping import is_stop
from tests.unit.intents.test_stopping import ORDINARY, OTHERS

READ = (
    "I would be glad if you stopped", "could you possibly stop doing that for me",
    "kindly stop what you are doing", "be so kind as to stop",
)  # fmt: skip


def brake(*, busy: bool) -> Brake:
    robot: Any = SimpleNamespace(busy=busy, executive=None)
    return Brake(robot, Dialogue(HOME), people=SimpleNamespace(), model=None)  # type: ignore[arg-type]


@pytest.mark.parametrize("said", READ)
def test_they_are_cries_to_a_robot_at_work(said: str) -> None:
    assert not is_stop(said)
    assert brake(busy=True).is_cry(said)
    assert not brake(busy=False).is_cry(said)


@pytest.mark.parametrize("said", [*OTHERS, *ORDINARY, "go to the sofa", "stop by the shop"])
def test_nothing_else_is(said: str) -> None:
    assert not asks_to_stop(said, HOME)
