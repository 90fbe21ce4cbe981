"""What a skill is said to take is what it takes."""

from __future__ import annotations

import pytest

from executive.skills.ask import AskParams
from executive.skills.balance import BalanceParams
from executive.skills.catalogue import SKILLS, make
from executive.skills.follow import FollowParams
from executive.skills.gesture import GestureParams
from executive.skills.give import GiveParams
from executive.skills.inspect import InspectParams
from executive.skills.look import LookParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.resources import conflicts, needed, needed_by
from executive.skills.say import SayParams
from executive.skills.search import SearchParams
from executive.skills.stop import StopParams
from executive.skills.wait import WaitParams
from tests.fakes.stage import Stage

WALK = NavigateParams(place_id="table")
NOD = GestureParams(kind="nod")
SPEAK = SayParams(text="hello")
EXAMPLES = (
    WALK,
    PickParams(object_id="cup"),
    PlaceParams(object_id="cup", place_id="table"),
    LookParams(place_id="table"),
    SearchParams(object_id="cup"),
    BalanceParams(mode="squat"),
    GiveParams(object_id="cup", person_id="ann"),
    FollowParams(person_id="ann"),
    GestureParams(kind="wave"),
    NOD,
    SPEAK,
    AskParams(text="Are you well?", person_id="ann"),
    WaitParams(duration_s=1.0),
    StopParams(),
    InspectParams(place_ids=("table",)),
)


def test_every_skill_has_an_example_here_and_its_own_file_name_and_words():
    assert {skill.takes for skill in SKILLS} == {type(example) for example in EXAMPLES}
    for skill in SKILLS:
        assert skill.__module__ == skill.takes.__module__ == f"executive.skills.{skill.name}"
        assert skill.summary.strip()
    assert len({skill.name for skill in SKILLS}) == len(SKILLS)


@pytest.mark.parametrize("params", EXAMPLES, ids=lambda params: type(params).__name__)
def test_a_skill_takes_what_it_says_and_no_more_than_at_most(params):
    skill = make(params, Stage().context)
    assert needed(params) == skill.resources <= type(skill).resources


def test_branches_conflict_where_two_want_the_same_part():
    walk, nod, speak = needed(WALK), needed(NOD), needed(SPEAK)
    assert conflicts([walk, speak]) == frozenset()
    assert conflicts([walk, speak, nod]) == {"head"}
    assert needed_by([NOD, lambda _board: SPEAK]) == {"head", "voice"}
