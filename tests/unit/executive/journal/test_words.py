"""What a journal holds, in words that people read."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.journal import words


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (0.1 + 0.2, "0.3"), (1 / 3, "0.333"), (-1e-9, "0"), (2.0, "2"), (123456.789012, "123457"),
        (7, "7"), (True, "True"), (None, "None"), ("a cup", "a cup"), ({}, "nothing"),
        ([1 / 3, {"x_m": 2 / 3}], "0.333, x_m: 0.667"), (math.inf, "inf"), (math.nan, "nan"),
    ],
)  # fmt: skip
def test_values_are_as_fine_as_what_is_measured(value, shown):
    assert words.told(value) == shown


@given(st.floats(-1e12, 1e12))
def test_no_number_is_a_string_of_noise(value):
    shown = words.told(value)
    assert len(shown.partition(".")[2]) <= 3
    assert abs(float(shown) - value) <= (0.0005 if abs(value) < 1000.0 else 0.5) + 1e-9


@pytest.mark.parametrize("kind", ["fault", "unheard of"])
def test_events_are_told_without_noise(kind):
    assert words.sentence(kind, {"strength_n_s": 0.1 + 0.2}).endswith(
        "strength_n_s 0.3)" if kind == "fault" else "strength_n_s 0.3"
    )


def test_evidence_has_units_and_no_noise():
    measured = {"gap_m": 1 / 3, "tries": 3, "at": [0.1 + 0.2, 1.0]}
    assert words.evidence(measured) == "gap 0.333 m, tries 3, at 0.3, 1"
