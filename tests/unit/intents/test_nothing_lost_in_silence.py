"""When, how long, how often and beside what: what no goal carries is asked about or refused."""

import pytest

from intents.dialogue import Dialogue
from intents.goals import Stop
from intents.grounding import Entity
from intents.outcomes import Goals, Question, Refusal, Reply
from intents.parser import parse
from intents.relations import Viewpoint
from intents.state import RobotState
from intents.wording import in_words
from tests.unit.intents.workshop_words import WORKSHOP

ASKED = [
    ("keep bowing", "“keep bowing”"),
    ("nod on and on", "“on and on”"),
    ("bow repeatedly", "“repeatedly”"),
    ("clap while squatting", "“while squatting”"),
    ("while you go to the sofa, wave", "“while you go to the sofa”"),
    ("nod as you walk to the sofa", "“as you walk to the sofa”"),
    ("lean forward for 4 seconds, pointing at the sofa", "“pointing at the sofa”"),
    ("nod and bow simultaneously", "“simultaneously”"),
    ("in parallel, nod and bow", "“In parallel”"),
    ("nod while Ada is here", "“while Ada is here”"),
    ("bow every hour", "“every hour”"),
    ("nod every 5 minutes", "“every 5 minutes”"),
    ("go to the sofa at 8 am", "“at 8 am”"),
    ("nod at midnight", "“at midnight”"),
    ("put the thermos on the sofa, using your right hand", "I choose the hand myself"),
    ("is the cupboard open", "Shall I just"),
]


@pytest.mark.parametrize(("said", "about"), ASKED, ids=[said for said, _ in ASKED])
def test_what_no_goal_carries_is_asked_about(said: str, about: str):
    outcome = parse(said, WORKSHOP)
    if isinstance(outcome, Refusal):
        assert said.startswith("is ")  # where no such door is known
        return
    assert isinstance(outcome, Question), outcome
    assert about.lower() in outcome.question.lower()


@pytest.mark.parametrize(
    "said",
    ["nod -2 times", "bow 0 times", "nod 1.5 times", "do 2.5 squats", "bow a thousand times",
     "skip this step", "leave out the last part", "don't do step three", "go on to the next step"],
)  # fmt: skip
def test_what_cannot_be_is_refused(said: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Refusal)
    assert "shall not" not in outcome.reason


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("nod a hundred times", "100 times: nod"),
        ("keep looking for the thermos", "look for the thermos"),
        ("wait here until further notice", "wait"),
        ("say it is noon every day", "say “it is noon every day”"),
        ("nod, then bow", "nod, then bow"),
        ("while you are at it, nod", "nod"),
        ("look left; look right; nod", "look left, then look right, then nod"),
        ("turn left. Turn right. Nod.", "turn 90° left, then turn 90° right, then nod"),
        ("carry the thermos to the sofa, please", "bring the thermos to the sofa"),
    ],
)
def test_what_is_carried_is_done(said: str, meant: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert in_words(outcome.goals) == meant


def test_a_posture_and_a_gesture_are_said_to_come_one_after_the_other():
    outcome = parse("stand on your left leg and nod", WORKSHOP)
    assert isinstance(outcome, Goals)
    assert outcome.reason == "I do one thing after the other."


@pytest.mark.parametrize("said", ["cease", "desist at once", "cease and desist", "please cease"])
def test_these_stop(said: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Stop(),)


def test_what_is_asked_and_not_known_says_what_can_be_asked():
    outcome = parse("how old is the wallpaper", WORKSHOP)
    assert isinstance(outcome, Refusal)
    assert "I can say where things are" in outcome.reason


STATE = RobotState(
    entities=(Entity(id="t", name="thermos", hand="left", held=True),),
    view=Viewpoint(x_m=1.0, y_m=1.0),
    spots=(("sofa", 4.0, 5.0),),
)


@pytest.mark.parametrize(
    ("said", "answer"),
    [
        ("how far is the sofa?", "5.0 m"),
        ("how far away is the thermos", "holding the thermos"),
        ("which hand do you hold it in?", "in my left hand"),
        ("undo the last two things", "undo that"),
    ],
)
def test_questions_of_an_evening_are_answered(said: str, answer: str):
    turn = Dialogue(WORKSHOP).hear(said, STATE)
    assert isinstance(turn, Reply)
    assert answer in turn.text


def test_no_promise_is_made_about_what_goes_on():
    busy = RobotState(doing="go to the sofa")
    turn = Dialogue(WORKSHOP).hear("avoid the sofa", busy)
    assert isinstance(turn, Refusal)
    assert "go on with it" in turn.reason
