"""What somebody says who was asked is the answer; who says nothing is asked twice."""

import pytest

from executive.blackboard import HEARD, Blackboard
from executive.meaning import answers, questions
from executive.skills.ask import LISTEN_S, TRIES, AskParams
from executive.skills.hearing import Hearing
from executive.skills.say import SayParams
from robot.messages import Heard, PersonInfo
from robot.se3 import SE3
from tests.fakes.stage import Stage

QUESTION = AskParams(text="Can you tell me if you are well?", person_id="ann")


@pytest.fixture
def stage():
    return Stage()


def speaks(stage, who: str, *, after_s: float) -> None:
    """Somebody says something so long after the first question."""
    tick, asked = stage.puppet.tick, []

    def say():
        tick()
        now_s = stage.puppet.time_s
        asked.extend([now_s] if stage.said and not asked else [])
        if asked and now_s > asked[0] + after_s:
            stage.context.hearing.note(Heard(stamp_s=now_s, text="Yes.", person_id=who))

    stage.puppet.tick = say


def test_the_answer_ends_it(stage):
    speaks(stage, "ann", after_s=2.0)
    assert stage.run(QUESTION).status == "succeeded"
    assert stage.said == [QUESTION.text]
    assert stage.context.hearing.newest() == {"ann": "Yes."}
    assert 2.0 < stage.puppet.time_s < 3.0
    assert stage.skill.remaining() is None


def test_who_did_not_hear_it_is_asked_again(stage):
    speaks(stage, "ann", after_s=LISTEN_S + 1.0)
    assert stage.run(QUESTION).status == "succeeded"
    assert stage.said == [QUESTION.text] * 2


@pytest.mark.parametrize("who", ["", "ben"])
def test_what_others_say_is_no_answer(stage, who):
    speaks(stage, who, after_s=1.0)
    report = stage.run(QUESTION)
    assert report.failure.code == "no_answer"
    assert "Ann" in report.failure.cause
    assert stage.said == [QUESTION.text] * TRIES


def test_what_was_said_before_the_question_is_no_answer_to_it():
    hearing = Hearing()
    hearing.note(Heard(stamp_s=1.0, text="No.", person_id="ann"))
    assert hearing.since("ann", 0.5) == "No."
    assert hearing.since("ann", 1.0) == ""


@pytest.mark.parametrize(
    ("what", "spoken"),
    [
        ("if the lab results have arrived", "if the lab results have arrived"),
        ("if she needs anything", "if you need anything"),
        ("whether he has seen my keys", "whether you have seen my keys"),
        ("what they want for their lunch?", "what you want for your lunch"),
        ("when she also goes home", "when you also go home"),
        ("how she is", "how you are"),
        ("if she misses us", "if you miss us"),
        ("if he tries it", "if you try it"),
        ("where the bus stops", "where the bus stops"),
    ],
)
def test_a_question_is_put_to_whom_it_is_for(what, spoken):
    assert questions.spoken(what) == f"Can you tell me {spoken}?"


def test_the_answer_is_told_with_the_question():
    ann = PersonInfo(id="ann", name="Ann", X_WO=SE3())
    words = answers.answered(ann, "if the results are there")
    board = Blackboard()
    unknown = words(board)
    board.claim("sense").set(HEARD, {"ann": "Yes.", "ben": "No."})
    told = words(board)
    assert isinstance(told, SayParams) and isinstance(unknown, SayParams)
    assert told.text == "I asked Ann if the results are there. The answer is: Yes."
    assert "do not know" in unknown.text
