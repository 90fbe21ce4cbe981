"""A page that sends more than a person does is heeded no more, but for a stop."""

from __future__ import annotations

import pytest

from executive.frontends.console.desk import Order
from executive.frontends.console.pace import LONGEST_CRY, Pace

WORDS = Order(line="what are you doing")


def test_a_page_is_heeded_as_far_as_a_person_types():
    pace = Pace(burst=3, per_s=10.0)
    assert [pace.heeds(WORDS, 0.0) for _ in range(5)] == [True, True, True, False, False]
    assert pace.refused == 2
    assert [pace.heeds(WORDS, 0.1) for _ in range(2)] == [True, False]
    assert pace.refused == 1
    assert [pace.heeds(WORDS, 100.0) for _ in range(4)] == [True, True, True, False]


@pytest.mark.parametrize(
    "cry", [Order(do="stop"), Order(do="estop"), Order(line="stop!"), Order(line="oh no, stop it")]
)
def test_a_cry_is_heeded_however_much_was_sent(cry):
    pace = Pace(burst=1, per_s=1e-9)
    assert pace.heeds(WORDS, 0.0)
    assert not any(pace.heeds(WORDS, 0.0) for _ in range(1000))
    assert all(pace.heeds(cry, 0.0) for _ in range(1000))


def test_a_long_line_is_not_searched_while_too_much_is_sent():
    pace = Pace(burst=1, per_s=1e-9)
    cry = Order(line="stop " * LONGEST_CRY)
    assert pace.heeds(cry, 0.0)
    assert not pace.heeds(cry, 0.0)
