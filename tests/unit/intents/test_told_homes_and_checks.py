"""Where things belong and the wish around it, what is done if a check fails, and lost things."""

import pytest

from intents.outcomes import Goals
from tests.unit.intents.hotel_words import assert_means_the_same, heard

HOMES = [
    (
        "the saucer and the teapot on the trolley belong in the minibar, can you put them away",
        "put the saucer from the trolley in the minibar, "
        "put the teapot from the trolley in the minibar",
    ),
    ("the bath towels belong in the wardrobe, please put them away",
     "put all bath towels in the wardrobe"),
    ("the scarf belongs in the wardrobe, could you put it back", "put the scarf in the wardrobe"),
    ("two pillows on the side table go in the wardrobe, put them where they belong",
     "put two pillows from the side table in the wardrobe"),
    ("the caps should be on the luggage rack, please take them there",
     "put all caps on the luggage rack"),
]  # fmt: skip
TIDIED = [
    ("please clear up the wine glasses in the lobby, they all go on the bar",
     "put all wine glasses from the lobby on the bar"),
    ("tidy away the saucers in the spa, they belong on the counter",
     "put all saucers from the spa on the counter"),
    ("clear up the saucer on the side table, it goes on the counter",
     "put the saucer from the side table on the counter"),
    ("pick up the pillows in the spa, they should go in the wardrobe",
     "put all pillows from the spa in the wardrobe"),
    ("put the caps away, they should all go on the luggage rack",
     "put all caps on the luggage rack"),
    ("clean up the suite a bit: all the wine glasses in there go on the bar",
     "put all wine glasses from the suite on the bar"),
    ("tidy the spa, the bath towels there belong in the wardrobe",
     "put all bath towels from the spa in the wardrobe"),
]  # fmt: skip
CHECKED = [
    ("check whether the menu is on the counter, and if it isn't put it there",
     "if the menu is not on the counter, put it on the counter"),
    ("see if the scarf is in the wardrobe and if it is bring it to Olga",
     "if the scarf is in the wardrobe, bring it to Olga"),
    ("look whether the saucers are on the bar, and if not put them there",
     "check whether the saucers are on the bar, and if they are not, put them there"),
]  # fmt: skip
LOST = [
    ("someone left a black scarf behind, please find it and leave it on the counter",
     "find a black scarf and put it on the counter"),
    ("somebody left two caps lying about, find them and put them on the luggage rack",
     "find two caps and put them on the luggage rack"),
    ("one of the guests has forgotten a cap somewhere, please bring it to Olga",
     "bring a cap to Olga"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), HOMES)
def test_a_wish_behind_where_things_belong_says_no_more(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(("said", "plainly"), TIDIED)
def test_what_is_tidied_is_put_where_it_is_told_to_go(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(("said", "plainly"), CHECKED)
def test_an_order_follows_a_check_without_a_comma(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(("said", "plainly"), LOST)
def test_what_was_left_behind_is_it(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    ["clean up the suite", "tidy up the spa a bit", "clean the bar, the cap goes in the bin"],
)
def test_tidying_alone_is_asked_about(said: str) -> None:
    assert not isinstance(heard(said), Goals)
