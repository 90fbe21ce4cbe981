"""Cries to stop: none is missed, whatever it looks like, and none takes long."""

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.stopping import is_stop

CRIES = (
    "stop", "STOP!", "Stop!!! Stop!!!", "stpo", "sotp", "stopp", "STOOOOP", "s t o p", "S.T.O.P",
    "ＳＴＯＰ", "st\u00f3p", "halt", "Halt!", "haaalt", "freeze", "freez", "frezze", "emergency",
    "emergancy", "e-stop", "arrête", "arretez-vous", "¡alto!", "fermati", "стоп", "стой",
    "停", "ストップ", "stopp jetzt", "don't move", "whoa", "for heaven's sake, stop",
    "would you please stop", "you have to stop right now", "I said stop", "can you stop",
    "bring me the mug. no, stop", "bring me the old green mug no stop now",
    "robot would you just stop moving already, thank you",
)  # fmt: skip
OTHERS = (
    "", "step back", "go to the shop", "take the top one", "put it on the stove", "freezer",
    "stop by the garage", "why did you stop?", "when did you stop", "don't stop",
    "go to the bus stop", "walk to the sofa, then stop", "walk until I say stop", "pick up a stool",
)  # fmt: skip


@pytest.mark.parametrize("cry", CRIES)
def test_cries_are_heard(cry: str) -> None:
    assert is_stop(cry)


@pytest.mark.parametrize("text", OTHERS)
def test_other_words_are_not_cries(text: str) -> None:
    assert not is_stop(text)


@given(
    st.sampled_from(["stop", "halt", "freeze"]),
    st.sampled_from(["", "!", "!!!", "...", "?!"]),
    st.sampled_from([str.lower, str.upper, str.title]),
    st.text(" \t\n", max_size=4),
)
def test_case_signs_and_blanks_do_not_matter(word: str, sign: str, case, blanks: str) -> None:  # type: ignore[no-untyped-def]
    assert is_stop(blanks + case(word) + sign + blanks)


@given(st.text(max_size=300), st.sampled_from([". stop", "! Halt", "\nSTOP!!"]))
def test_a_cry_of_its_own_at_the_end_is_heard(before: str, cry: str) -> None:
    assert is_stop(before + cry)


@pytest.mark.parametrize(
    "text",
    ["x" * 100_000, "please " * 20_000, "a, " * 50_000, "\u0301" * 100_000, "stop " * 20_000],
    ids=lambda t: ascii(t[:6]),
)
def test_no_text_takes_long(text: str) -> None:
    is_stop(text)
    took_s = []
    for _ in range(5):
        began = time.perf_counter()
        is_stop(text)
        took_s.append(time.perf_counter() - began)
    assert min(took_s) < 0.005
