"""Numbers and quantities in words."""

from math import pi

import pytest

from intents.english.words.measures import measure, number


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("seven", 7), ("twenty one", 21), ("one hundred and eighty", 180), ("2.5", 2.5),
        ("two and a half", 2.5), ("half a", 0.5), ("a couple of", 2), ("two thousand", 2000),
    ],
)  # fmt: skip
def test_numbers(text: str, value: float) -> None:
    found = number(text.split(), 0)
    assert found is not None
    assert found.value == value
    assert found.end == len(text.split())


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("two metres", "length", 2.0), ("30 cm", "length", 0.3), ("half a meter", "length", 0.5),
        ("a metre and a half", "length", 1.5), ("ninety degrees", "angle", pi / 2),
        ("a quarter turn", "angle", pi / 2), ("1 rad", "angle", 1.0), ("5 s", "time", 5.0),
        ("one and a half minutes", "time", 90.0), ("twice", "times", 2.0),
        ("three times", "times", 3.0),
    ],
)  # fmt: skip
def test_measures_are_in_si(text: str, kind: str, value: float) -> None:
    found = measure(text.split(), 0)
    assert found is not None
    assert found.kind == kind
    assert found.value == pytest.approx(value)
    assert found.end == len(text.split())


@pytest.mark.parametrize("text", ["red cup", "two cups", "metres", "", "a cup"])
def test_what_has_no_unit_is_no_measure(text: str) -> None:
    assert measure(text.split(), 0) is None
