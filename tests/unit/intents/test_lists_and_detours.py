"""What several things share, what is done on the way, and for whom a thing turns out to be."""

import pytest

from intents.goals import to_builtins
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary
from tests.unit.intents.hotel_words import assert_means_the_same, heard

NAMED = Vocabulary.of(
    objects=[
        *(Thing(name=f"{color} crate", category="crate") for color in ("grey", "yellow")),
        *(Thing(name=f"{size} spanner", category="spanner") for size in ("small", "large")),
    ],
    places=["lathe", "rack"],
    people=["Emil"],
    categories={"crate": "crates", "spanner": "spanners"},
)
COLORED = Vocabulary.of(
    objects=[Thing(name="crate", color="gray"), Thing(name="crate", color="yellow")],
    places=["lathe", "rack"],
    people=["Emil"],
)


@pytest.mark.parametrize("words", [NAMED, COLORED])
@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        (
            "bring the yellow crate and the grey one to Emil",
            "bring the yellow crate to Emil, then bring the grey crate to Emil",
        ),
        (
            "put the grey crate and the yellow one on the rack",
            "put the grey crate on the rack, then put the yellow crate on the rack",
        ),
        (
            "put the grey crate on the rack and the yellow one too",
            "put the grey crate on the rack, then put the yellow crate on the rack",
        ),
        ("fetch the yellow crate, no, the grey one", "fetch the grey crate"),
        ("pick up the grey crate. Now the yellow one", "pick up the grey crate and yellow crate"),
    ],
)
def test_the_blue_one_in_a_list_is_another_of_the_same_kind(
    words: Vocabulary, said: str, plainly: str
) -> None:
    one, other = parse(said, words), parse(plainly, words)
    assert isinstance(one, Goals), one
    assert isinstance(other, Goals), other
    assert one.goals == other.goals


def test_names_that_tell_a_size_are_told_apart_by_it() -> None:
    outcome = parse("take the small spanner and the large one to Emil", NAMED)
    assert isinstance(outcome, Goals), outcome
    told = [goal["object"]["name"] for goal in to_builtins(outcome.goals)]
    assert told == ["small spanner", "large spanner"]


@pytest.mark.parametrize(
    "said", ["fetch the grey crate and the pink one", "fetch the grey crate. Now the pink one"]
)
def test_a_colour_that_nothing_has_is_no_other_thing(said: str) -> None:
    assert not isinstance(parse(said, NAMED), Goals)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        (
            "bring me the torch and the scarf to Olga",
            "bring me the torch, then bring the scarf to Olga",
        ),
        (
            "a peach for Ravi and a cola for me, both from the bar",
            "bring a peach from the bar to Ravi, then bring me a cola from the bar",
        ),
        (
            "bring me the cap and the torch, all of them from the suite",
            "bring me the cap from the suite and the torch from the suite",
        ),
    ],
)
def test_things_share_where_they_are_and_each_has_its_receiver(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    [
        "go to the spa, but stop at the bar first",
        "go to the spa and stop by the bar on the way",
        "walk over to the spa, stopping at the bar on your way",
        "go to the spa via the bar",
        "go via the bar to the spa",
        "head to the spa by way of the bar",
        "on your way to the spa, stop at the bar",
        "go to the spa. Go to the bar first.",
        "go to the bar before you go to the spa",
        "go to the bar before heading to the spa",
    ],
)
def test_what_is_done_on_the_way_is_done_first(said: str) -> None:
    assert_means_the_same(said, "go to the bar, then go to the spa")


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        (
            "take the torch to the lobby and pick up the scarf on the way",
            "pick up the scarf, then take the torch to the lobby",
        ),
        ("go to the spa, and on the way close the door", "close the door, then go to the spa"),
        ("switch the heater off before you go to the spa", "switch the heater off, go to the spa"),
        ("go to the spa first, then to the bar", "go to the spa, then go to the bar"),
        ("go to the spa and stop at the bar", "go to the spa, then go to the bar"),
    ],
)
def test_the_order_is_the_one_that_was_said(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize("said", ["go to the spa, then stop", "go to the spa and stop there"])
def test_to_stop_without_a_place_is_to_stop(said: str) -> None:
    outcome = heard(said)
    assert isinstance(outcome, Goals), outcome
    assert to_builtins(outcome.goals)[-1] == {"goal": "stop"}


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("take the torch to Ravi, sorry, to Olga", "take the torch to Olga"),
        ("take the torch to Ravi, no, Olga", "take the torch to Olga"),
        ("bring me the torch, no, to Olga", "bring the torch to Olga"),
        ("take the torch to the bar, no wait, to Olga", "bring the torch to Olga"),
        ("bring the torch to Olga, I mean to the bar", "bring the torch to the bar"),
        ("bring the cap and the torch to Ravi, no, to Olga", "bring the cap and the torch to Olga"),
    ],
)
def test_to_whom_can_be_taken_back(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("fetch the torch from the bar, Hans needs it", "bring the torch from the bar to Hans"),
        ("get the torch, it's for Hans", "bring the torch to Hans"),
        ("torch off the trolley, Hans wants it", "bring the torch from the trolley to Hans"),
        ("get the torch and the cap, Olga asked for them", "bring the torch and the cap to Olga"),
        ("bring me the torch, Hans needs it", "bring me the torch"),
        ("put the torch on the bar, Hans needs it", "put the torch on the bar"),
        ("bring the torch to Olga, it is for Hans", "bring the torch to Olga"),
    ],
)
def test_for_whom_it_is_may_be_told_behind_the_order(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize("keen", ["the hell", "on earth", "tf", "in the world"])
def test_how_keen_one_is_to_know_says_nothing(keen: str) -> None:
    assert_means_the_same(f"where {keen} is my torch", "where is my torch")


def test_who_is_called_behind_an_order_is_still_somebody_else() -> None:
    assert isinstance(heard("fetch the torch, Olga"), Refusal | Question)
