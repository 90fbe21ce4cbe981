"""One of several things, told apart: it comes first, last, or goes elsewhere; none is forgotten."""

import pytest

from intents.dialogue import Dialogue
from intents.goals import to_builtins
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.state import RobotState
from intents.vocabulary import Thing, Vocabulary
from intents.wording import in_words

HOME = Vocabulary.of(
    objects=[
        Thing(name="cup", color="red"),
        Thing(name="cup", color="blue"),
        Thing(name="bottle", color="green"),
    ],
    places=["counter", "table", "chair", "shelf", "upper shelf", "lower shelf", "middle shelf"],
)


def words(said: str, *before: str) -> str:
    dialogue = Dialogue(HOME)
    for one in before:
        dialogue.hear(one)
    turn = dialogue.hear(said)
    return in_words(turn.goals) if isinstance(turn, Goals) else ""


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        (
            "bring me the cups, the blue one first",
            "bring the blue cup to you, then for every red cup: bring it to you",
        ),
        (
            "bring me the cups, first the blue one",
            "bring the blue cup to you, then for every red cup: bring it to you",
        ),
        (
            "put the cups on the counter, the red one last",
            "for every blue cup: put it on the counter, then put the red cup on the counter",
        ),
        (
            "put the cups on the counter, starting with the red one",
            "put the red cup on the counter, then for every blue cup: put it on the counter",
        ),
        (
            "put both cups on the counter, the red one first and then the blue one",
            "put the red cup on the counter, then put a blue cup on the counter",
        ),
        (
            "put the cups on the shelf, the blue one on the upper shelf",
            "for every red cup: put it on the shelf, then put the blue cup on the upper shelf",
        ),
        (
            "put the cups on the shelf, the red one on the upper shelf and the blue one on the "
            "lower shelf",
            "put the red cup on the upper shelf, then put the blue cup on the lower shelf",
        ),
    ],
)
def test_each_is_handled_once_in_the_order_and_place_that_is_said(said: str, meant: str) -> None:
    assert words(said) == meant


@pytest.mark.parametrize(
    "said",
    ["put both cups on the counter, the red one on the left",
     "put the cups on the counter, the red one in the middle"],
)  # fmt: skip
def test_where_among_the_others_is_asked_about(said: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Question)
    assert "the red one" in outcome.question
    assert "middle shelf" not in str(to_builtins(outcome.goals))


@pytest.mark.parametrize("said", ["no, the red one first", "the red one first"])
def test_said_afterwards_it_takes_the_place_of_the_order_and_keeps_all_of_it(said: str) -> None:
    dialogue = Dialogue(HOME)
    dialogue.hear("put both cups on the counter", RobotState())
    turn = dialogue.hear(said, RobotState())
    assert isinstance(turn, Goals) and turn.instead
    assert in_words(turn.goals) == (
        "put the red cup on the counter, then put a blue cup on the counter"
    )


def test_of_several_orders_the_one_that_is_named_comes_first() -> None:
    before = "put the red cup on the table and bring me the bottle"
    assert words("no, the bottle first", before) == (
        "bring the bottle to you, then put the red cup on the table"
    )
