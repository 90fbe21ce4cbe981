"""Numbers in words, as people say them."""

import pytest

from intents.english.words.measures import Number, number


@pytest.mark.parametrize(
    ("said", "value", "words"),
    [
        ("zero point seven five", 0.75, 4),
        ("one point twenty five", 1.25, 4),
        ("two point oh four", 2.04, 4),
        ("three point 5", 3.5, 3),
        ("one eighty", 180.0, 2),
        ("two seventy five", 275.0, 3),
        ("one fifteen", 115.0, 2),
        ("one hundred and five", 105.0, 4),
        ("three thousand two hundred and one", 3201.0, 6),
        ("forty five", 45.0, 2),
    ],
)
def test_a_number_is_read_whole(said: str, value: float, words: int):
    assert number(said.split(), 0) == Number(value, words)


@pytest.mark.parametrize(("said", "value"), [("seven five", 7.0), ("twenty ten", 20.0)])
def test_two_numbers_are_not_added_up(said: str, value: float):
    assert number(said.split(), 0) == Number(value, 1)
