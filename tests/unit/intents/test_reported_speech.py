"""What is told somebody is said as they are to hear it."""

import pytest

from intents.goals import Close, Open, Person, Report, Say
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Vocabulary
from tests.unit.intents.hotel_words import heard

STABLE = Vocabulary.of(
    objects=["saddle", "bucket"],
    places=["barn door", "side door", "feed bin"],
    rooms=["yard", "tack room"],
    people=["Ravi"],
)


@pytest.mark.parametrize(
    ("told", "hears"),
    [
        ("he is late for the party", "you are late for the party"),
        ("he still owes me a tea", "you still owe me a tea"),
        ("he's a dear", "you're a dear"),
        ("he's dropped it again", "you've dropped it again"),
        ("he doesn't listen", "you don't listen"),
        ("his sister is looking for him", "your sister is looking for you"),
        ("his sister is here and she is cross", "your sister is here and she is cross"),
        ("to put his scarf on", "put your scarf on"),
        ("not to run", "do not run"),
    ],
)
def test_who_is_told_is_you(told: str, hears: str) -> None:
    outcome = heard(f"tell Ravi {told}")
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Say(what=hears, to=Person(name="Ravi")),)


@pytest.mark.parametrize(
    "told",
    [
        "the tea is hers",
        "Olga thinks he is late",
        "my sister is here and she is cross",
        "to the left is the bar",
        '"he is late"',
    ],
)
def test_somebody_else_stays_who_they_are(told: str) -> None:
    outcome = heard(f"tell Ravi {told}")
    says = (
        [goal.what for goal in outcome.goals if isinstance(goal, Say)]
        if not isinstance(outcome, Refusal)
        else []
    )
    assert all(" you" not in f" {what}" for what in says), says


def test_after_somebody_else_he_may_be_them() -> None:
    outcome = heard("Hans is at the bar. Tell Ravi he is late.")
    assert not isinstance(outcome, Refusal), outcome
    assert [goal.what for goal in outcome.goals if isinstance(goal, Say)] == ["he is late"]


@pytest.mark.parametrize("said", ["say sorry to the postman", "say happy birthday to auntie"])
def test_a_wish_is_said_to_nobody_who_is_not_known(said: str) -> None:
    outcome = heard(said)
    assert isinstance(outcome, Refusal), outcome
    assert "who" in outcome.reason


@pytest.mark.parametrize("said", ["help, bring me the cap", "help me! Bring me the cap."])
def test_a_call_for_help_ahead_of_an_order_only_calls(said: str) -> None:
    outcome, wanted = heard(said), heard("bring me the cap")
    assert isinstance(outcome, Goals), outcome
    assert isinstance(wanted, Goals)
    assert outcome.goals == wanted.goals
    alone = heard("help me")
    assert isinstance(alone, Goals)
    assert isinstance(alone.goals[0], Report)


def test_every_door_is_each_of_them() -> None:
    opened, closed = (parse(f"{verb} every door", STABLE) for verb in ("open", "close"))
    assert isinstance(opened, Goals), opened
    assert isinstance(closed, Goals), closed
    assert opened.goals == (Open(what="barn door"), Open(what="side door"))
    assert closed.goals == (Close(what="barn door"), Close(what="side door"))
    assert isinstance(parse("open every window", STABLE), Question)
