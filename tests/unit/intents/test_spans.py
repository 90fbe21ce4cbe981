"""A span of time that is said comes back in a goal, or is asked about: none vanishes."""

import pytest

from intents.bounds import unkept
from intents.goals import Gesture, GoTo, Wait
from intents.outcomes import Goals, Question, Refusal
from intents.parser import hear, parse
from intents.spans import unkept_span
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(
    objects=[Thing(name="mug", color="green"), Thing(name="mug", color="white"), "flask"],
    places=["bench", "rack"],
    people=["Ida"],
)
ASKED = [
    "take the flask, an hour's sunshine, then put it on the rack",
    "go to the bench, then a minute's silence, then nod",
    "in a minute's time, nod",
    "nod for a minute",
    "nod for half an hour",
    "go to the rack, and nod a minute afterwards",
    "bow, 20 seconds, nod",
    "go to the bench. One minute. Nod.",
    "just a minute, bring me the flask",
    "put the flask on the rack, 1 metre in",
]
KEPT = [
    ("take the flask, an hour's rest, then put it on the rack", 3600.0),
    ("go to the bench, then a minute's pause, then nod", 60.0),
    ("go to the bench (a minute's break), then nod", 60.0),
    ("go to the bench, a ten-second pause, nod", 10.0),
    ("go to the bench, two minutes' rest, and nod", 120.0),
    ("nod, a short pause of 5 seconds, bow", 5.0),
    ("take the flask, wait a minute, then put it on the rack", 60.0),
    ("take five seconds, then nod", 5.0),
    ("go to the bench and after two minutes go to the rack", 120.0),
    ("give me a minute, then nod", 60.0),
    ("wait for 2 minutes, no, 30 seconds please", 30.0),
    ("wait a minute but stop waiting after 20 seconds", 20.0),
]
TOLD = [
    "I have an hour's work left, bring me the flask",
    "the tea takes ten minutes, bring me the flask",
    "bring me the flask, it will only take a minute",
    "come here for a minute",
    "one sec, nod",
]


@pytest.mark.parametrize("text", ASKED)
def test_a_span_that_no_goal_carries_is_asked_about(text: str):
    assert isinstance(parse(text, HOME), Question)


@pytest.mark.parametrize(("text", "lasts_s"), KEPT)
def test_a_span_that_is_a_wait_is_none_to_ask_about(text: str, lasts_s: float):
    outcome = parse(text, HOME)
    assert isinstance(outcome, Goals)
    waits = [goal.duration_s for goal in outcome.goals if isinstance(goal, Wait)]
    assert waits == [lasts_s]


@pytest.mark.parametrize("text", TOLD)
def test_a_span_that_is_only_told_of_changes_nothing(text: str):
    outcome = parse(text, HOME)
    assert not isinstance(outcome, Refusal)
    assert "promise" not in str(getattr(outcome, "question", ""))


def test_no_reading_and_no_model_drops_a_span():
    goals = (GoTo(place="bench"), Gesture(kind="nod"))
    assert unkept("zoom to the bench, a minute's breather, nod", goals) == "a minute"
    assert unkept("after ten minutes zoom to the bench and nod", goals) == "ten minutes"
    assert unkept("zoom to the bench and nod within an hour", goals) == "an hour"
    assert unkept("zoom to the bench, a minute's breather", (*goals, Wait(duration_s=60))) == ""
    outcome, _ = hear(
        "zoom to the bench pronto like, a minute, nod",
        HOME,
        fallback=lambda *_: Goals(goals=goals, parser="model"),
    )
    assert isinstance(outcome, Question)
    assert outcome.parser != "model"


def test_a_shorter_span_takes_the_longer_one_back():
    assert unkept_span("squat for 9 seconds but stop after 4 seconds", [4.0]) == ""
    assert unkept_span("squat for 4 seconds, a minute's rest, nod", [4.0]) == "a minute"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("go to the bench, no closer than 1 m", "no closer than 1 m"),
        ("go no closer than 1 m to the bench", "no closer than 1 m"),
        ("follow Ida no nearer than two metres", "no nearer than two metres"),
        ("go to the rack no faster than 0.2 m/s and nod", "no faster than 0.2 m/s"),
        ("bring me the flask, no later than noon", "no later than noon"),
    ],
)
def test_a_bound_that_begins_with_no_is_asked_about_as_one(text: str, said: str):
    outcome = parse(text, HOME)
    assert isinstance(outcome, Question)
    assert outcome.question.startswith(f"I cannot promise “{said}”. Shall I just")
    assert outcome.kind == "confirmation"


def test_a_bound_of_what_cannot_be_read_is_no_name():
    outcome = parse("stay no closer than 1 m to Ida", HOME)
    assert isinstance(outcome, Refusal)
    assert outcome.reason == "I cannot promise “no closer than 1 m”."
