"""Where a thing lives, how many each gets, what has no door, and who stands where."""

import pytest

from tests.unit.intents.hotel_words import assert_means_the_same


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("put the torch away, it lives in the wardrobe", "put the torch in the wardrobe"),
        ("put the scarf back, it belongs in the wardrobe", "put the scarf in the wardrobe"),
        ("a peach for Hans, two for Olga", "bring a peach to Hans, then bring two peaches to Olga"),
        ("bring a cola to Olga and three to me", "bring a cola to Olga, then bring me three colas"),
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
