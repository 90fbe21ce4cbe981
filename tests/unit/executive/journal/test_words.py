"""What a journal holds, in words that people read."""

import ast
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import executive
from executive.journal import words


def recorded():
    """What is written into journals: a kind of event, and the names of its data."""
    for path in Path(executive.__file__).parent.rglob("*.py"):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Attribute):
                continue
            if call.func.attr == "record" and call.args and isinstance(call.args[0], ast.Constant):
                names = [one.arg for one in call.keywords]
                if None not in names:  # else some are known only as it runs
                    yield call.args[0].value, names


def test_whatever_is_recorded_has_words_of_its_own():
    kinds = [(kind, names) for kind, names in recorded() if kind not in words.DRAWN]
    assert len(kinds) > 15
    unworded = words.sentence("unheard of", {"took": "x"})
    assert unworded == "unheard of, took x"
    for kind, names in kinds:
        told = words.sentence(kind, dict.fromkeys(names, "x"))
        assert not told.startswith(f"{kind}, "), f"{kind} has no words for {names}: {told}"


@pytest.mark.parametrize(("took", "answer"), [("then", "yes"), ("else", "no")])
def test_a_branch_is_told_by_its_answer(took, answer):
    told = words.sentence("branch", {"id": "1.1", "step": "is it there already", "took": took})
    assert told == f"is it there already: {answer}"


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
