"""Whose name somebody has: never one that another has, never one that is not told."""

import numpy as np
import pytest

from robot.perception.company.naming import Names
from robot.perception.company.tracking import Somebody


def track(number, x, y, *, believed_s=0.0):
    return Somebody(
        number=number, state=np.array([x, y, 0.0, 0.0]), covariance=0.01 * np.eye(4), nats=3.0,
        seen_s=0.0, is_believed=True, believed_s=believed_s,
    )  # fmt: skip


def named(told, tracks, *, now_s=5.0, away=()):
    names = Names()
    names.tell(told)
    for id in away:
        names.empty(id)
    names.settle(tracks, now_s)
    return [names.of(one) for one in tracks]


def test_the_only_one_told_is_whoever_is_there_and_the_second_is_nobody_known():
    tracks = [track(1, 5.0, 5.0), track(2, 0.0, 0.0)]
    assert named({"anna": (0.0, 0.0)}, tracks) == ["anna", ""]


def test_of_two_each_is_who_was_told_to_be_there():
    tracks = [track(1, 4.1, 0.0), track(2, 0.1, 0.0)]
    assert named({"anna": (0.0, 0.0), "bob": (4.0, 0.0)}, tracks) == ["bob", "anna"]


def test_between_two_places_nobody_is_guessed():
    assert named({"anna": (0.0, 0.0), "bob": (1.0, 0.0)}, [track(1, 0.5, 0.0)]) == [""]


def test_who_is_elsewhere_is_the_only_one_who_is_not_at_their_place():
    told = {"anna": (0.0, 0.0), "bob": (4.0, 0.0)}
    assert named(told, [track(1, 2.0, 5.0)], away=["bob"]) == ["bob"]
    assert named(told, [track(1, 2.0, 5.0)]) == [""]
    assert named(told, [track(1, 2.0, 5.0, believed_s=4.9)], away=["bob"]) == [""]


def test_a_name_stays_with_who_has_it_wherever_they_go_and_comes_back_to_them():
    names = Names()
    names.tell({"anna": (0.0, 0.0), "bob": (4.0, 0.0)})
    anna, bob = track(1, 0.0, 0.0), track(2, 4.0, 0.0)
    names.settle([anna, bob], 1.0)
    anna.state[:2] = (4.5, 0.5)
    names.settle([anna, bob], 2.0)
    assert [names.of(anna), names.of(bob)] == ["anna", "bob"]
    names.left(anna)
    again = track(3, 9.0, 9.0, believed_s=2.0)
    names.settle([bob, again], 5.0)
    assert names.of(again) == "anna"


@pytest.mark.parametrize("seed", range(20))
def test_no_two_ever_have_one_name(seed):
    rng = np.random.default_rng(seed)
    names = Names()
    names.tell({f"p{k}": rng.uniform(-3, 3, 2) for k in range(3)})
    tracks = [track(k, *rng.uniform(-3, 3, 2)) for k in range(5)]
    for k in range(10):
        there = [one for one in tracks if rng.random() < 0.7]
        for one in there:
            one.state[:2] += rng.normal(0.0, 0.5, 2)
        names.settle(there, float(k))
        given = [name for one in there if (name := names.of(one))]
        assert len(given) == len(set(given))
