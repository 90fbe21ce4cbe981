"""The resource table says what the skills really take."""

from __future__ import annotations

from typing import get_args

import pytest

from executive.skills import parameters as p
from executive.skills.catalogue import make
from executive.skills.resources import NEEDS, conflicts, needed, needed_by
from tests.fakes.stage import Stage

EXAMPLES = (
    p.NavigateParams(place_id="table"),
    p.PickParams(object_id="cup"),
    p.PlaceParams(object_id="cup", place_id="table"),
    p.LookParams(place_id="table"),
    p.SearchParams(object_id="cup"),
    p.BalanceParams(mode="squat"),
    p.GiveParams(object_id="cup", person_id="ann"),
    p.FollowParams(person_id="ann"),
    p.GestureParams(kind="wave"),
    p.GestureParams(kind="nod"),
    p.SayParams(text="hello"),
    p.WaitParams(duration_s=1.0),
    p.StopParams(),
)


def test_every_skill_has_a_row_and_an_example_here():
    assert set(NEEDS) == set(get_args(p.SkillParams)) == {type(example) for example in EXAMPLES}


@pytest.mark.parametrize("params", EXAMPLES, ids=lambda params: type(params).__name__)
def test_a_row_says_what_the_skill_takes(params):
    assert needed(params) == make(params, Stage().context).resources


def test_branches_conflict_where_two_want_the_same_part():
    walk, nod, speak = (needed(EXAMPLES[index]) for index in (0, 9, 10))
    assert conflicts([walk, speak]) == frozenset()
    assert conflicts([walk, speak, nod]) == {"head"}
    assert needed_by([EXAMPLES[9], lambda _board: EXAMPLES[10]]) == {"head", "voice"}
