"""A robot that asks for leave has it from whoever tells it to do just that."""

import pytest

from executive.behaviours.ask import answer_of

QUESTION = "the robot lies on its side; may I get up? Please see that nobody is near me"


@pytest.mark.parametrize(
    "said",
    ["get up", "Stand up!", "please get up now", "ok, get up", "you may get up", "yes", "continue"],
)
def test_to_say_it_gives_leave(said: str):
    assert answer_of(said, QUESTION) == "continue"


@pytest.mark.parametrize("said", ["wave", "do not get up", "don't stand up", "get up and wave"])
def test_anything_else_gives_none(said: str):
    assert answer_of(said, QUESTION) != "continue"


def test_nobody_gives_leave_for_what_is_not_asked():
    assert answer_of("get up", "please make room around it, then say continue") is None
