"""Words that change what is to be done come back in the goals, or the robot says that they do not.

Hands, sides, times, speeds, quotations and rooms.
"""

import pytest

from intents.context import Context
from intents.grounding import Entity
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.wording import in_words
from tests.unit.intents.workshop_words import WORKSHOP

READ = [
    ("wave with your left hand", "wave with my left hand"),
    ("wave at Ada with your right arm", "wave at Ada with my right hand"),
    ("point at the sofa with your left hand", "point at sofa with my left hand"),
    ("raise your left arm", "raise my left arm"),
    ("look left then right then straight ahead", "look left, then look right, then look ahead"),
    ("look left, then right, and then up", "look left, then look right, then look up"),
    ("turn left, then right, then left",
     "turn 90° left, then turn 90° right, then turn 90° left"),
    ("look at the thermos for five seconds", "look at the thermos, then wait 5 s"),
    ("look left for three seconds", "look left, then wait 3 s"),
    ("walk sideways one metre to the left", "walk 1 m left"),
    ("step sideways to the right", "walk 0.3 m right"),
    ('say "hello" and then "goodbye"', "say “hello”, then say “goodbye”"),
    ('say "one", "two" and "three", then wave',
     "say “one”, then say “two”, then say “three”, then wave"),
    ('say "hello" to Ada and "goodbye" to Emil',
     "say “hello” to Ada, then say “goodbye” to Emil"),
    ("go to every room and wave",
     "go to the office, then wave, then go to the garage, then wave, then go to the living room, "
     "then wave"),
    ("visit all the rooms, then come back to me",
     "go to the office, then go to the garage, then go to the living room, then go to you"),
    ("go through each of the rooms and nod and bow, then wave",
     "go to the office, then nod, then bow, then go to the garage, then nod, then bow, then go to "
     "the living room, then nod, then bow, then wave"),
    ("go into every room and look for the thermos", "look for the thermos"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "meant"), READ, ids=[said for said, _ in READ])
def test_what_is_said_comes_back(said: str, meant: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert in_words(outcome.goals) == meant


@pytest.mark.parametrize(
    ("said", "about"),
    [
        ("take the thermos, but not yet", "“not yet”"),
        ("take the thermos but not now", "“not now”"),
        ("go to the garage, but not before I say so", "“not before I say so”"),
        ("walk one metre sideways", "left or to the right?"),
        ("walk sideways to the sofa", "“sideways”"),
        ("look under the sofa", "What shall I look for?"),
    ],
)
def test_what_is_not_clear_is_asked(said: str, about: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Question), outcome
    assert about in outcome.question


@pytest.mark.parametrize(
    "said",
    [
        "wave with both hands",
        "nod with your left hand",
        "stand behind the sofa",
        "stand to the left of the workbench",
        "go behind the sofa",
    ],
)
def test_what_cannot_be_done_so_is_refused(said: str):
    assert isinstance(parse(said, WORKSHOP), Refusal)


@pytest.mark.parametrize(
    ("said", "pace"),
    [
        ("walk slowly to the garage", "slowly"),
        ("very slowly go to the garage", "very slowly"),
        ("go to the garage as fast as you can", "as fast as you can"),
        ("bring me the thermos, quickly", "quickly"),
    ],
)
def test_a_pace_is_remarked_on(said: str, pace: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert outcome.reason == f"I move at my own pace: “{pace}” changes nothing."


@pytest.mark.parametrize("said", ["go to the garage", "say slowly but surely", "where are you?"])
def test_nothing_is_remarked_where_no_pace_is_said(said: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals)
    assert "pace" not in (outcome.reason or "")


def test_more_than_there_are_is_refused_with_how_many_there_are():
    mugs = tuple(Entity(id=c, name="mug", color=c) for c in ("red", "blue"))
    outcome = parse("put three mugs on the sofa", WORKSHOP, context=Context(entities=mugs))
    assert isinstance(outcome, Refusal)
    assert outcome.reason == "There are only 2 of them, not 3: a red mug and a blue mug."
