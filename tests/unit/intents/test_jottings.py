"""Orders without a verb, in pieces; things named first and handled by a verb that comes later."""

import pytest
from hotel_words import HOTEL, heard

from intents.english.phrases.referents import Scope
from intents.english.trouble import ReadingError
from intents.english.words.text import Text
from intents.grammar import read
from intents.outcomes import Goals, Outcome
from intents.wording import in_words


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("One cola, for Olga, from the minibar", "bring Olga a cola from the minibar"),
        ("Scarf, wardrobe, now", "put the scarf on the wardrobe"),
        ("Terrace: two saucers", "put two saucers on the terrace"),
        ("Saucers, four pieces, from trolley to bar", "put four saucers from the trolley on bar"),
        ("Suitcases, red, onto the luggage rack", "put the red suitcase on the luggage rack"),
        ("Scissors! From the counter!", "bring me the scissors from the counter"),
        ("Back to the wardrobe with that scarf", "put the scarf on the wardrobe"),
        ("tea, Ravi, suite", "bring a tea to Ravi in the suite"),
        ("Cap: wardrobe. Torch: bar", "put the cap on the wardrobe and the torch on the bar"),
        ("Scarf from the trolley, me", "bring me the scarf from the trolley"),
        ("hammer, counter, bring it here", "bring me the hammer from the counter"),
        ("the scarf take to Olga", "take the scarf to Olga"),
        ("saucer bring", "bring the saucer"),
        ("get me a saucer out the wardrobe", "get me a saucer out of the wardrobe"),
    ],
)  # fmt: skip
def test_it_is_read_as_what_is_said_plainly(said: str, plainly: str) -> None:
    assert _told(heard(said)) == _told(heard(plainly))


@pytest.mark.parametrize(
    "said",
    [
        "the menu for Ravi",  # which may be all that is spoken of
        "Olga's scarf from the spa",  # hers, or for who speaks
        "the scarf on the trolley, lobby",
        "Olga, the scarf",
        "scarf, wardrobe, juggle it",
    ],
)
def test_what_may_be_no_order_is_none_of_the_grammar(said: str) -> None:
    text = Text(said, HOTEL)
    with pytest.raises(ReadingError):
        read(text, Scope(text.index))


def _told(outcome: Outcome) -> str:
    assert isinstance(outcome, Goals), outcome
    told = in_words(outcome.goals)
    return told.replace(" a ", " the ").replace(" to the operator", "")
