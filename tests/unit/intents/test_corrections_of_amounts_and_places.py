"""What takes the place of an amount, a side, or a place; and what a thing that was named is for."""

import pytest

from intents.amounts import amended
from intents.dialogue import Dialogue
from intents.goals import Gesture, GoTo
from intents.outcomes import Goals, Question, Refusal, Turn
from intents.vocabulary import Thing, Vocabulary
from intents.wording import in_words

HOME = Vocabulary.of(
    objects=[Thing(name="cup", color="red"), Thing(name="cup", color="blue"), Thing(name="bottle")],
    places=["counter", "table", "chair", "shelf"],
)


def turn_after(before: str, said: str) -> Turn:
    dialogue = Dialogue(HOME)
    dialogue.hear(before)
    return dialogue.hear(said)


@pytest.mark.parametrize(
    "said",
    ["actually, on the table", "on the table instead", "sorry, the table", "sorry, on the table",
     "rather on the table", "to the table instead", "no, on the table", "wait, on the table",
     "on second thoughts, the table", "the table instead"],
)  # fmt: skip
def test_another_place_takes_the_place_of_the_one_before(said: str) -> None:
    turn = turn_after("put the blue cup on the chair", said)
    assert isinstance(turn, Goals) and turn.instead
    assert in_words(turn.goals) == "put the blue cup on the table"


@pytest.mark.parametrize(
    ("before", "said", "meant"),
    [
        ("and after that nod twice", "no, three times", "3 times: nod"),
        ("nod twice", "three times, I mean", "3 times: nod"),
        ("wait 5 seconds", "no, ten seconds", "wait 10 s"),
        ("walk two metres back", "sorry, one metre", "walk 1 m back"),
        ("turn left 45 degrees", "no, 90 degrees", "turn 90° left"),
        ("turn left", "no, right", "turn 90° right"),
        ("wave with your left hand", "sorry, the right one", "wave with my right hand"),
        ("go to the table, then nod twice", "no, once", "go to the table, then 1 times: nod"),
    ],
)
def test_another_amount_takes_the_place_of_the_one_before(
    before: str, said: str, meant: str
) -> None:
    turn = turn_after(before, said)
    assert isinstance(turn, Goals) and turn.instead
    assert in_words(turn.goals) == meant


def test_an_amount_beyond_all_limits_is_refused_as_ever() -> None:
    assert isinstance(turn_after("walk two metres forward", "no, 700 metres"), Refusal)


@pytest.mark.parametrize("said", ["three times", "no, the red one", "no", "right", "no, stop", ""])
def test_without_a_word_of_correction_or_an_amount_nothing_is_amended(said: str) -> None:
    assert amended(said, (Gesture(kind="nod"),)) is None


def test_what_was_named_is_what_it_is_about() -> None:
    assert isinstance(turn_after("go to the table", "now the bottle"), Question | Goals)
    dialogue = Dialogue(HOME)
    dialogue.hear("the bottle")
    turn = dialogue.hear("put it on the counter")
    assert isinstance(turn, Goals) and not dialogue.dropped
    assert in_words(turn.goals) == "put the bottle on the counter"


@pytest.mark.parametrize(
    ("said", "then"),
    [
        ("wave when you arrive at the counter", "wave"),
        ("nod as soon as you are at the counter", "nod"),
        ("when you arrive at the counter, wave", "wave"),
        ("say hello when you get to the counter", "greet a person"),
        ("go to the counter and wave when you arrive at the counter", "wave"),
    ],
)
def test_where_one_arrives_one_goes_first(said: str, then: str) -> None:
    turn = Dialogue(HOME).hear(said)
    assert isinstance(turn, Goals) and isinstance(turn.goals[0], GoTo)
    assert in_words(turn.goals) == f"go to the counter, then {then}"


@pytest.mark.parametrize("said", ["bring it over there", "bring the red cup over there"])
def test_what_is_only_pointed_at_is_asked_about(said: str) -> None:
    assert isinstance(Dialogue(HOME).hear(said), Question)
    turn = turn_after("go to the table", said)
    assert not isinstance(turn, Goals) or "to the table" in in_words(turn.goals)


def test_how_fast_is_not_when() -> None:
    assert isinstance(Dialogue(HOME).hear("walk two metres in four seconds"), Question)
    turn = Dialogue(HOME).hear("wave in four seconds")
    assert isinstance(turn, Goals) and in_words(turn.goals) == "wait 4 s, then wave"


@pytest.mark.parametrize(
    ("said", "meant"),
    [("bring me either cup", "bring a cup to you"), ("stand back", "walk 0.3 m back")],
)
def test_little_words_are_heard(said: str, meant: str) -> None:
    turn = Dialogue(HOME).hear(said)
    assert isinstance(turn, Goals) and in_words(turn.goals) == meant


def test_who_wants_to_be_left_alone_is() -> None:
    turn = Dialogue(HOME).hear("leave me alone")
    assert isinstance(turn, Refusal) and "alone" in turn.reason
