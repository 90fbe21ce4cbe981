"""Goals that do the contrary of what was said, or do it to more or fewer, are seen to."""

import pytest

from intents import mismatches
from intents.context import Context
from intents.english.words.lexer import words_in
from intents.english.words.names import index_of
from intents.goals import Goal
from intents.parser import first_look
from intents.vocabulary import Vocabulary

FORGE = Vocabulary.of(
    objects=["hammer", "tongs", "cider", "nail", "bellows", "lamp"],
    places=["anvil", "trough", "shutter"],
    rooms=["yard"],
    people=["Maud"],
)
INDEX = index_of(FORGE)


def meant(plain: str) -> tuple[Goal, ...]:
    """The goals of plain words."""
    return first_look(plain, FORGE, Context()).goals


@pytest.mark.parametrize(
    ("said", "plain", "turned"),
    [
        ("bring down the shutter", "open the shutter", True),
        ("douse the lamp", "switch on the lamp", True),
        ("let the shutter up", "open the shutter", False),
        ("the shutter stands wide open again", "close the shutter", False),
        ("sit down and open the shutter", "open the shutter", False),
    ],
)
def test_what_is_turned_round(said: str, plain: str, turned: bool) -> None:
    assert mismatches.turns_round(words_in(said), meant(plain)) is turned


def test_what_is_no_device_is_switched_only_where_that_was_said() -> None:
    off = meant("switch off the anvil")
    assert mismatches.switches_furniture(words_in("boots off the anvil"), off)
    assert not mismatches.switches_furniture(words_in("switch off that anvil"), off)
    assert not mismatches.switches_furniture(words_in("lamp off now"), meant("switch off the lamp"))


@pytest.mark.parametrize(
    ("said", "plain", "another"),
    [
        ("cider, two sugars", "bring two ciders to me", True),
        ("two more ciders", "bring two ciders to me", False),
        ("ciders, two of them", "bring two ciders to me", False),
        ("some cider", "bring the cider to me", False),
    ],
)
def test_number_of_something_else_counts_nothing(said: str, plain: str, another: bool) -> None:
    assert mismatches.counts_another(words_in(said), meant(plain), INDEX) is another


def test_wait_is_as_long_as_was_said() -> None:
    said = words_in("rest you there ten minutes")
    assert mismatches.mistimes(said, meant("wait 10 s"))
    assert not mismatches.mistimes(said, meant("wait 600 s"))
    assert not mismatches.measures_lost(said, meant("wait 600 s"))
    assert mismatches.measures_lost(said, meant("go to the yard"))


@pytest.mark.parametrize(
    ("said", "plain", "lost"),
    [
        ("everything in the trough onto the anvil", "put the trough on the anvil", True),
        ("every nail, the trough", "put the nail in the trough", True),
        ("every nail, the trough", "put every nail in the trough", False),
        ("drop everything and bring the hammer", "bring the hammer to me", False),
    ],
)
def test_all_is_not_one(said: str, plain: str, lost: bool) -> None:
    assert mismatches.loses_all(words_in(said), meant(plain), INDEX) is lost


@pytest.mark.parametrize(
    ("said", "plain", "fewer"),
    [
        ("put the nails away and wave the tongs then bring the cider", "bring the cider", True),
        ("take the hammer and put it on the anvil", "put the hammer on the anvil", False),
        ("bring the cider, it is hot in here", "bring the cider", False),
    ],
)
def test_no_order_is_lost_of_several(said: str, plain: str, fewer: bool) -> None:
    assert mismatches.orders_fewer(said, meant(plain)) is fewer


@pytest.mark.parametrize(
    ("said", "plain", "lost"),
    [
        ("nod, wait one second", "wave", True),
        ("nod, wait one second", "wave ; wait 1 s", False),
        ("wait, bring the hammer", "bring the hammer to me", False),
    ],
)
def test_a_wait_that_was_said_with_its_length_is_not_lost(
    said: str, plain: str, lost: bool
) -> None:
    goals = tuple(goal for part in plain.split(" ; ") for goal in meant(part))
    assert mismatches.waits_for_nothing(words_in(said), goals) is lost


def test_whose_something_is_and_why_a_thing_is_so_is_in_no_goal() -> None:
    assert mismatches.whose_is_lost(words_in("whose hammer is that"), meant("find the hammer"))
    why = meant("why did you stop")
    assert mismatches.explains_another("why is that bellows so long", why)
    assert not mismatches.explains_another("why is that bellows so long, do you know", why)
    assert not mismatches.explains_another("why did that fail", why)


@pytest.mark.parametrize(
    ("said", "plain", "beside_itself"),
    [
        ("there is a hammer behind the till, bring it", "bring the hammer behind the hammer", True),
        ("bring the hammer behind the other hammer", "bring the hammer behind the hammer", False),
        ("bring the hammer behind the lamp", "bring the hammer behind the lamp", False),
    ],
)
def test_what_is_beside_itself(said: str, plain: str, beside_itself: bool) -> None:
    assert mismatches.is_beside_itself(words_in(said), meant(plain)) is beside_itself
