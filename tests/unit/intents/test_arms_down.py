"""An arm that is to come down comes down, and never up."""

import pytest

from intents.goals import Balance, Gesture, Goal
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(objects=[Thing(name="cup", color="red")], places=["table"])


def goals(said: str) -> tuple[Goal, ...]:
    outcome = parse(said, HOME)
    return outcome.goals if isinstance(outcome, Goals) else ()


@pytest.mark.parametrize(
    ("said", "kind"),
    [
        ("lower your left arm", "lower_left_arm"),
        ("lower your arm", "lower_arm"),
        ("put your hand down", "lower_arm"),
        ("take your right hand down", "lower_right_arm"),
        ("move your left arm down", "lower_left_arm"),
        ("relax your left arm", "lower_left_arm"),
        ("put your arms down", "lower_both_arms"),
        ("lower both arms", "lower_both_arms"),
        ("drop your arms", "lower_both_arms"),
        ("let your arms hang down", "lower_both_arms"),
        ("hands down", "lower_both_arms"),
        ("please put your hands by your sides", "lower_both_arms"),
    ],
)
def test_a_limb_that_is_to_come_down_does(said: str, kind: str) -> None:
    assert goals(said) == (Gesture(kind=kind),)


@pytest.mark.parametrize(
    "said",
    ["lower your arm three times", "lower your other arm", "lower your hand to the table",
     "put your hand on the table", "lower your arm for 3 seconds", "don't raise your arm"],
)  # fmt: skip
def test_however_it_is_said_nothing_is_raised(said: str) -> None:
    assert "raise" not in str(goals(said))


def test_what_was_raised_is_lowered() -> None:
    assert goals("raise your left arm, then lower it")[-1] == Gesture(kind="lower_left_arm")
    assert goals("raise both arms and lower them again")[-1] == Gesture(kind="lower_both_arms")
    assert goals("raise your left leg and put it down")[-1] == Balance(mode="stand")
    assert goals("put your foot down") == (Balance(mode="stand"),)


@pytest.mark.parametrize("said", ["put your hands up", "hands up", "raise your arms"])
def test_up_is_up(said: str) -> None:
    assert goals(said) == (Gesture(kind="raise_both_arms"),)


def test_a_thing_is_put_down_as_before() -> None:
    assert goals("pick up the red cup, then put it down")[-1] != Gesture(kind="lower_arm")
    assert "place" in str(goals("lower the cup")).lower()
