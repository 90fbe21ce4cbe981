"""A word of English means itself, however near a word of the grammar or a name it is."""

import pytest

from intents.english.words.dictionary import is_english
from intents.english.words.text import Text
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Vocabulary

HOME = Vocabulary.of(
    objects=["cup", "bottle", "box", "blanket", "screwdriver"],
    places=["table", "shelf", "counter", "workbench"],
    rooms=["kitchen", "dining room"],
    people=["Ada"],
)


@pytest.mark.parametrize(
    "word",
    [
        "took",
        "raining",
        "channel",
        "peek",
        "nap",
        "lick",
        "wash",
        "paint",
        "book",
        "mail",
        "tale",
        "sable",
        "blank",
        "bench",
        "candle",
    ],
)
def test_a_word_of_english_is_never_corrected(word: str) -> None:
    text = Text(f"{word} the cup", HOME)
    assert text.words[0] == word
    assert text.corrections == []


@pytest.mark.parametrize(
    "word",
    [
        "colour",
        "color",
        "neighbor",
        "theatre",
        "theater",
        "organize",
        "kilometers",
        "catalog",
        "pyjamas",
        "mom",
    ],
)
def test_both_spellings_are_english(word: str) -> None:
    assert is_english(word)


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("brng the botle to the kitchn", "bring the bottle to the kitchen"),
        ("put the scredriver on the wrkbench", "put the screwdriver on the workbench"),
        ("pik up teh redd cup", "pick up the red cup"),
    ],
)
def test_what_is_no_word_is_corrected_and_said(said: str, meant: str) -> None:
    one, other = parse(said, HOME), parse(meant, HOME)
    assert isinstance(one, Goals)
    assert isinstance(other, Goals)
    assert one.goals == other.goals
    assert one.reason is not None and one.reason.startswith("I took")


def test_a_real_word_that_is_like_a_name_is_asked_about_or_refused() -> None:
    assert not isinstance(parse("go to the dinning room", HOME), Goals)
