"""What a terminal would obey is written out, and everything else is left alone."""

import json
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.printable import (
    is_printable,
    printable,
    printable_data,
    printable_json,
    printable_line,
)

ANY = st.text(st.characters())


@given(ANY)
def test_nothing_that_a_terminal_obeys_is_left(text: str) -> None:
    left = printable(text)
    assert is_printable(left)
    assert all(unicodedata.category(one) not in ("Cc", "Cs") for one in left if one not in "\n\t")


@given(ANY)
def test_what_is_fit_stays_as_it_is(text: str) -> None:
    assert (printable(text) == text) == is_printable(text)


@given(ANY)
def test_a_line_is_one_line(text: str) -> None:
    assert len(printable_line(text).splitlines()) <= 1


@given(st.recursive(ANY, lambda inner: st.lists(inner) | st.dictionaries(ANY, inner)))
def test_data_is_printable_throughout(data: object) -> None:
    made = printable_data(data)
    assert printable_data(made) == made
    assert is_printable(json.dumps(made, ensure_ascii=False))


@given(ANY)
def test_json_means_the_same(text: str) -> None:
    made = printable_json(json.dumps(text, ensure_ascii=False))
    assert is_printable(made)
    assert json.loads(made) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b[31mred", r"\x1b[31mred"),
        ("\x9b31m", r"\x9b31m"),
        ("\x1b]0;title\x07", r"\x1b]0;title\x07"),
        ("cup\u202egnp", r"cup\u202egnp"),
        ("a\rb", r"a\x0db"),
        ("\ufffe", r"\ufffe"),
        ("st\u200bop", r"st\u200bop"),
        ("cup\u3164", r"cup\u3164"),
        ("a\U000e0041", r"a\U000e0041"),
        ("grüße, 杯子 👋🏽\n\tnext", "grüße, 杯子 👋🏽\n\tnext"),
    ],
)
def test_what_it_looks_like(text: str, shown: str) -> None:
    assert printable(text) == shown
