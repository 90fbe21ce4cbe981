"""What a sentence says that its goals would contradict is asked about, and only that."""

import pytest

from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.vocabulary import Category, Thing, Vocabulary

MILL = Vocabulary(
    objects=(
        *Vocabulary.of(objects=["flour sack", "brass key", "lantern", "ledger"]).objects,
        Thing(name="rye loaf", category="bread"),
        Thing(name="oat loaf", category="bread"),
    ),
    places=Vocabulary.of(places=["hopper", "millstone", "sill"]).places,
    rooms=Vocabulary.of(rooms=["granary"]).rooms,
    people=Vocabulary.of(people=["Tamsin", "Mr Pascoe"]).people,
    categories=(Category(singular="bread", plural="breads"),),
)


@pytest.mark.parametrize(
    ("said", "offered"),
    [
        ("it's either the brass key or the lantern, you choose", ""),
        ("six o'clock sharp, lantern, sill", "the lantern on the sill"),
        ("all the breads onto the sill, without the rye loaf", ""),
        ("should the ledger be lying on the sill, hand it to me; otherwise I shall be happy with "
         "the lantern", ""),
        ("my pipe's on the sill, run and fetch it", ""),
        ("the hopper is dirty, see to it", ""),
    ],
)  # fmt: skip
def test_what_the_goals_would_contradict_is_asked_about(said: str, offered: str) -> None:
    outcome = parse(said, MILL)
    assert isinstance(outcome, Question), outcome
    assert offered in outcome.question
    assert "Tamsin" not in outcome.question


@pytest.mark.parametrize(
    "said",
    [
        "take the lantern to the sill, then bring it to Tamsin, no rush",
        "bring the lantern to Tamsin. No, to Mr Pascoe.",
        "bring the lantern to Tamsin oh no take it to Mr Pascoe",
        "put the flour sacks on the sill, but not the ledger",
        "if the ledger is on the sill, bring it to me, otherwise never mind",
        "tell Tamsin the mill opens at six o'clock",
        "say either the lantern or the key will do",
        "the lantern's on the sill, fetch it",
    ],
)
def test_nothing_else_is(said: str) -> None:
    outcome = parse(said, MILL)
    assert isinstance(outcome, Goals), outcome


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        # signs that are spoken
        ("go to the granary full stop", "go to the granary"),
        ("bring me the lantern comma the ledger and the brass key full stop",
         "bring me the lantern, the ledger and the brass key"),
        ("how many flour sacks are on the sill question mark",
         "how many flour sacks are on the sill?"),
        # said again
        ("sit down, sit down!", "sit down"),
        ("is Tamsin in the granary or not?", "is Tamsin in the granary?"),
        # who somebody is, beside the name
        ("give the lantern to our miller, Mr Pascoe", "give the lantern to Mr Pascoe"),
        ("tell both Tamsin and Mr Pascoe that it is late",
         "tell Tamsin and Mr Pascoe that it is late"),
        # learners, dialects, old forms
        ("the granary is dark, take you the lantern to Tamsin", "take the lantern to Tamsin"),
        ("when Tamsin in the granary is, bring her the ledger",
         "when Tamsin is in the granary, bring her the ledger"),
        ("take the lantern and the ledger to Tamsin, but no the brass key",
         "take the lantern and the ledger to Tamsin, but not the brass key"),
        ("bring the smallest o the flour sacks ower tae the sill",
         "bring the smallest of the flour sacks over to the sill"),
        ("would you ever hand Tamsin the ledger", "hand Tamsin the ledger"),
        ("two metres forward, right turn", "two metres forward, turn right"),
        ("if I may say so, bring me the lantern", "bring me the lantern"),
        ("it is dark, therefore bring me the lantern", "it is dark, so bring me the lantern"),
        # what for
        ("put the flour sacks on the millstone for grinding",
         "put the flour sacks on the millstone"),
    ],
)  # fmt: skip
def test_so_many_words_change_nothing(said: str, plainly: str) -> None:
    one, other = parse(said, MILL), parse(plainly, MILL)
    assert isinstance(one, Goals), one
    assert isinstance(other, Goals), other
    assert one.goals == other.goals


@pytest.mark.parametrize("cry", ["full stop!", "full stop", "come to a full stop now please robot"])
def test_a_full_stop_that_is_cried_is_no_sign(cry: str) -> None:
    outcome = parse(cry, MILL)
    assert not isinstance(outcome, Goals) or "Stop" in str(outcome.goals)


@pytest.mark.parametrize(
    "said",
    ["nod, then nod again", "walk one metre forward, walk one metre forward"],
)
def test_what_is_to_be_done_twice_is(said: str) -> None:
    outcome = parse(said, MILL)
    assert isinstance(outcome, Goals)
    assert len(outcome.goals) == 2
