"""A sentence is acted on where a reading of it is trusted, asked about where none is, and what
would lose a word that limits an order is never more than a question."""

import numpy as np
import pytest

from intents.context import Context
from intents.english.learnt.field import LEARNT, Field, Fields
from intents.english.words.names import index_of
from intents.goals import to_builtins
from intents.outcomes import Goals, Outcome, Question
from intents.parser import first_look, parse
from intents.second_look import Attempt, is_settled, second_look
from intents.vocabulary import Vocabulary

MILL = Vocabulary.of(
    objects=["flour sack", "grain scoop", "ledger", "oil lamp", "rye loaf"],
    places=["mill stone", "loading hatch", "cupboard", "counter"],
    rooms=["granary", "mill room"],
    people=["Tilda", "Old Anders"],
)
INDEX = index_of(MILL)


def read(said: str) -> Attempt:
    return first_look(said, MILL, Context())


def trusting(odds: float, *, whole: float = 0.0) -> Fields:
    """What was learnt, with the same log odds for every reading to be right; `whole`: more or less
    for the one that leaves no word out.
    """
    rows, weights = {"always": 0, "whole": 1}, np.array([[odds, 0.0], [whole, 0.0]])
    return {**LEARNT, "trust": Field(("right", "wrong"), rows, weights, np.zeros((2, 2)))}


def looked_at(said: str, fields: Fields) -> Outcome:
    return second_look(said, INDEX, read(said), read, fields=fields).outcome


TALK = "bring me the ledger would you my knees are killing me today"


def test_what_is_not_trusted_is_asked_about() -> None:
    assert isinstance(looked_at(TALK, trusting(9.0)), Goals)
    asked = looked_at(TALK, trusting(0.0))
    assert isinstance(asked, Question)
    assert asked.kind == "confirmation"


def test_what_the_grammar_reads_from_every_word_is_given_up_only_if_another_is_far_likelier() -> (
    None
):
    said = "find Tilda and tell me what she is wearing today and go home"
    for odds in (-9.0, 0.0, 9.0):
        assert looked_at(said, trusting(odds)) == read(said).outcome
    assert looked_at(said, trusting(0.0, whole=-9.0)) != read(said).outcome


def test_what_somebody_is_to_be_told_is_never_taken_for_talk() -> None:
    said = "Tell Tilda the miller is late, you know how he is, it has been raining all day"
    for whole in (-9.0, 0.0):
        assert looked_at(said, trusting(0.0, whole=whole)) == read(said).outcome


def test_what_is_an_order_by_itself_is_never_taken_for_talk() -> None:
    said = "go to the granary , locate a person , and say the mill stands still"
    for whole in (-9.0, 0.0):
        assert looked_at(said, trusting(0.0, whole=whole)) == read(said).outcome


@pytest.mark.parametrize(
    "said",
    [
        "bring me the ledger if Tilda has gone",
        "two of the rye loaves, those on the counter, want to be with Tilda",
        "to Tilda with the red ledger",
        "no ledger for Tilda",
    ],
)
def test_trust_excuses_no_loss_of_what_limits_an_order(said: str) -> None:
    outcome = looked_at(said, trusting(9.0))
    told = str(to_builtins(outcome.goals)) if isinstance(outcome, Goals) else ""
    kept = {"if": "'if'", "two": "'count': 2", "red": "red", "no": "\0"}
    for word, slot in kept.items():
        if word in said.split():
            assert not told or slot in told, outcome


def test_a_short_order_needs_no_second_look() -> None:
    assert is_settled("open the cupboard", read("open the cupboard"))
    said = "open the cupboard, it has been raining all day"
    assert not is_settled(said, read(said))


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        (
            "would you have the cupboard shut and the ledger with Tilda",
            "close the cupboard, then bring the ledger to Tilda",
        ),
    ],
)
def test_several_orders_are_said_again_one_after_the_other(said: str, plainly: str) -> None:
    outcome = parse(said, MILL)
    expected = parse(plainly, MILL)
    assert isinstance(outcome, Goals)
    assert isinstance(expected, Goals)
    assert to_builtins(outcome.goals) == to_builtins(expected.goals)
