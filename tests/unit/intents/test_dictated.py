"""What dictation writes: words that sound alike, "yeah" in between, clauses begun again."""

import pytest

from intents.outcomes import Goals
from tests.unit.intents.hotel_words import assert_means_the_same, heard

SAME = [
    # begun again
    ("put the soccer I mean put the saucer in the bin", "put the saucer in the bin"),
    ("bring the torch no bring the hammer to Hans", "bring the hammer to Hans"),
    ("hand the menu to ole gah I mean Olga", "hand the menu to Olga"),
    ("the saucer, no, the teapot, put it on the bar", "put the teapot on the bar"),
    # assent that only keeps talk going
    ("take the cola to the bar yeah and close the minibar",
     "take the cola to the bar and close the minibar"),
    ("so the scarf yeah put it on the trolley", "put the scarf on the trolley"),
    # words that sound alike
    ("bring me the read cap", "bring me the red cap"),
    ("take the cap of the luggage rack and put it on the bar",
     "take the cap off the luggage rack and put it on the bar"),
    ("weight for ten seconds", "wait for ten seconds"),
    ("wood you bring the menu two the terrace", "bring the menu to the terrace"),
    ("get a peach four me", "get a peach for me"),
    ("I can't sea my scarf anywhere can you find it", "find my scarf"),
    # a device taken back
    ("shut the wardrobe, or rather, the minibar", "shut the minibar"),
    ("turn on the heater, I mean the desk lamp", "turn on the desk lamp"),
    # what is seen is only told; where it goes is known
    ("see the scissors on the counter? Put them in the wardrobe",
     "put the scissors from the counter in the wardrobe"),
    ("the saucer, put it next to the teapot on the bar",
     "put the saucer next to the teapot on the bar"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), SAME)
def test_dictation_means_what_was_said(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


def test_words_that_sound_alike_are_told() -> None:
    outcome = heard("bring me the read cap")
    assert isinstance(outcome, Goals)
    assert outcome.reason == "I took “read” for “red”."


@pytest.mark.parametrize(
    ("said", "kept"),
    [("tell Hans yeah I will come", "yeah I will come"), ("say the read book is his", "read book")],
)
def test_what_is_to_be_said_stays_as_it_is(said: str, kept: str) -> None:
    outcome = heard(said)
    assert isinstance(outcome, Goals)
    assert kept in str(outcome.goals)


def test_owner_is_no_place_to_take_it_off() -> None:
    outcome = heard("put the cap of Hans on the bar")
    assert isinstance(outcome, Goals)
    assert "off" not in (outcome.reason or "")


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("there are bath towels on the trolley, put them in the wardrobe",
         "put all the bath towels from the trolley in the wardrobe"),
        ("the teapots are on the bar, bring them to Hans", "bring all teapots on the bar to Hans"),
        ("go to the spa and see if Lucia is there", "go to the spa, find Lucia in the spa"),
        ("go to the spa and count how many are sitting there",
         "go to the spa and count the people sitting there"),
        ("out of the row of teapots on the bar I want the smallest one",
         "of the teapots on the bar, bring me the smallest one"),
    ],
)  # fmt: skip
def test_what_was_told_of_several_is_of_all(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)
