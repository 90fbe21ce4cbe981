"""A link is lost when the last of its connections is gone, and one did not say goodbye."""

from __future__ import annotations

from itertools import permutations

import pytest

from executive.frontends.remote.tie import Tie
from executive.frontends.remote.wire import LOST_S


@pytest.mark.parametrize("ends", [*set(permutations((True, True, False))), (True, True, True)])
def test_one_that_broke_is_a_lost_link_in_whatever_order_they_end(ends: tuple[bool, ...]):
    tie = Tie(name="anna")
    for _ in ends:
        tie.begin(0.0)
    for left in ends:
        assert not tie.is_lost
        tie.end(left=left)
    assert tie.is_lost == (False in ends)
    tie.begin(1.0)  # joined anew
    tie.end(left=True)
    assert not tie.is_lost


def test_a_link_is_silent_when_no_connection_has_beaten_for_too_long():
    tie = Tie(name="anna")
    assert not tie.is_silent(99.0)  # nobody was there
    tie.begin(1.0)
    tie.begin(1.0)
    tie.beat(2.0)
    assert not tie.is_silent(2.0 + 0.9 * LOST_S)
    assert tie.is_silent(2.0 + 1.1 * LOST_S)


def test_what_was_said_is_taken_once():
    tie = Tie(name="anna")
    tie.jobs.add(3)
    tie.lines.add(("a", 1))
    assert tie.may_move
    assert tie.take() == ({3}, True)
    assert tie.take() == (set(), False)
    assert not tie.may_move
