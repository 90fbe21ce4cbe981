"""Where a thing lives, how many each gets, what has no door, and who stands where."""

import pytest

from intents.outcomes import Goals
from tests.unit.intents.hotel_words import assert_means_the_same, heard


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("put the torch away, it lives in the wardrobe", "put the torch in the wardrobe"),
        ("put the scarf back, it belongs in the wardrobe", "put the scarf in the wardrobe"),
        ("a peach for Hans, two for Olga", "bring a peach to Hans, then bring two peaches to Olga"),
        ("bring a cola to Olga and three to me", "bring a cola to Olga, then bring me three colas"),
        ("find the torch, but leave it there", "find the torch"),
        ("see if somebody left a cap in the spa", "see if there is a cap in the spa"),
        (
            "if someone has left a cap in the spa, bring it to me",
            "if there is a cap in the spa, bring it to me",
        ),
        (
            "put the torches away, they all belong in the wardrobe",
            "put the torches in the wardrobe",
        ),
        (
            "count the saucers on the bar and tell Olga how many there are",
            "count the saucers on the bar and tell Olga how many",
        ),
        ("close the desk lamp", "switch the desk lamp off"),
        ("shut the heater up", "switch the heater off"),
        ("open the desk lamp", "switch the desk lamp on"),
        ("did I leave my cap in the spa", "find the cap in the spa"),
        ("I think I left my cap in the spa, could you check", "find the cap in the spa"),
        ("what's that on the bar", "what is on the bar"),
        ("stand next to Olga", "go to Olga"),
        ("see who is at the bar", "who is at the bar"),
        ("I have need of the torch", "I need the torch"),
    ],
)
def test_it_means_the_same(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("bring the torch to Hans and Olga", "bring the torch to Hans, bring the torch to Olga"),
        ("a cola to Hans, Olga and me", "bring a cola to Hans, to Olga, then bring me a cola"),
        ("ask Olga to come to the bar", "tell Olga to come to the bar"),
        ("open the minibar and tell me what's inside",
         "open the minibar and tell me what is in the minibar"),
        ("which room is Olga in", "find Olga"),
        ("how many saucers are still on the bar", "how many saucers are on the bar"),
        ("bring Olga her scissors, they are on the bar", "bring Olga the scissors from the bar"),
        ("two peaches for Hans and one for Olga, from the bar",
         "bring two peaches from the bar to Hans, then bring one peach from the bar to Olga"),
    ],
)  # fmt: skip
def test_for_several_and_about_places(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    [
        "turn left at the bar",
        "search the spa and the lobby for my cap",
        "everything on the trolley that isn't a torch goes in the bin",
        "follow Olga to the spa but stay outside",
    ],
)
def test_what_no_goal_says_is_asked_about(said: str) -> None:
    assert not isinstance(heard(said), Goals)
