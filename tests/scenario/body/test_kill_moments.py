"""Processes die at random moments of a walk: nothing worse follows than docs/safety.md says."""

import pytest

from benchmarks.kill_moments import FOLLOWED, KILLED, LOWERED, MAY, MOST, OWNER, STOPPED, once


@pytest.mark.parametrize(
    ("struck", "seed"),
    [
        (KILLED, 1),
        (FOLLOWED, 1),
        (STOPPED, 1),
        (OWNER, 1),
        *(
            pytest.param(struck, seed, marks=pytest.mark.rest)
            for struck in MAY
            for seed in range(500, 510)
        ),
    ],
)
def test_what_follows_is_what_the_page_lets(struck: str, seed: int):
    row = once(seed, struck, robot="juno", reality="real")
    assert row.outcome in MAY[struck], row
    assert row.most <= MOST, row


def test_in_the_middle_of_a_walk_it_is_lowered_on_its_feet():
    row = once(1, KILLED, robot="juno", reality="real")
    assert row.walked
    assert row.codes[1] == "controller_lost_in_a_step"
    assert row.outcome == LOWERED
