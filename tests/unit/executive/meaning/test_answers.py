"""A report in a task says what the robot would answer at the prompt, from the same state."""

import math

import pytest

from executive.blackboard import HELD, WORLD, Blackboard
from executive.meaning import answers
from executive.meaning.knowledge import Knowledge
from executive.meaning.robot_state import state_of
from executive.skills.say import SayParams
from intents import replies
from robot.messages import Track, WorldState
from robot.se3 import SE3
from tests.fakes.worlds import world_map

KNOWN = Knowledge(world_map())
SKILLS = frozenset({"pick"})


@pytest.fixture
def board() -> Blackboard:
    board = Blackboard()
    sense = board.claim("sense")
    turned = SE3.from_xy_yaw(1.0, 0.5, math.radians(90.0), z_m=0.8)
    cup = Track(id="cup_red", X_WO=SE3((1.0, 0.6, 0.9)), seen_s=1.0)
    sense.set(WORLD, WorldState(stamp_s=1.0, X_WN=SE3(), X_WB=turned, fix_age_s=0.0, tracks=(cup,)))
    sense.set(HELD, {"left": "cup_red"})
    return board


def said(topic, board) -> str:
    words = answers.report(topic, KNOWN, skills=SKILLS)(board)
    assert isinstance(words, SayParams)
    return words.text


@pytest.mark.parametrize(
    "topic", ["holding", "seeing", "location", "status", "health", "why", "capabilities"]
)
def test_a_report_is_what_is_answered_at_the_prompt(topic, board):
    assert said(topic, board) == replies.report(topic, state_of(board, KNOWN, skills=SKILLS))


def test_it_says_what_it_holds_and_where_it_is(board):
    assert said("holding", board) == "I am holding the red cup in my left hand."
    assert said("location", board).endswith("at x 1.0 m, y 0.5 m, heading 90 degrees.")


def test_before_anything_is_known_it_says_so():
    assert said("location", Blackboard()) == "I do not know where I am."
    assert said("holding", Blackboard()) == "I am not holding anything."
