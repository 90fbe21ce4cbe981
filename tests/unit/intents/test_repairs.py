"""Quantities and directions that are taken back at once, and what only sounds like that."""

import pytest

from intents.english.words.lexer import tokenize
from intents.english.words.repairs import repaired


def words(text):
    return " ".join(token.text for token in repaired(tokenize(text)))


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("spin left, no, right", "spin right"),
        ("face left, no wait, to the right, then bow", "face right , then bow"),
        ("look left, hold on, right", "look right"),
        ("go back, I mean forward", "go forward"),
        ("lift your left arm, sorry, the right one", "lift your right arm"),
        ("march four metres, no, six", "march six metres"),
        ("rotate by 30 degrees, make that 60", "rotate by 60 degrees"),
        ("march four metres, no, 80 centimetres forward", "march 80 centimetres forward"),
        ("nod twice, no, four times", "nod four times"),
        ("pause for 2 minutes, no, 30 seconds please", "pause for 30 seconds please"),
        ("nod two times, no, three, sorry, five", "nod five times"),
    ],
)
def test_what_was_said_last_stands_for_what_is_of_its_kind(said, meant):
    assert words(said) == meant


@pytest.mark.parametrize(
    "said",
    [
        "say left, no, right",
        "tell Mia there are four, no, six",
        "spin left, right",
        "spin left, then right",
        "spin left, no, not there",
        "go to the bench, wait, left",
        "wait, 10 seconds",
        "march to the bench, no, 80 centimetres",
        "the red one, no, three boxes",
        "have no left glove",
        "i mean right",
    ],
)
def test_all_else_stays(said):
    assert words(said) == " ".join(token.text for token in tokenize(said))
