"""A place is looked over until what is asked is known, and no longer."""

import math

import pytest
from msgspec.structs import replace

from executive.behaviours.run_skill import DEFAULT_LIMIT_S
from executive.skills.inspect import RECENT_S, InspectParams
from executive.skills.motions.look_closer import SIDES
from executive.skills.motions.look_over import VIEW_M
from executive.skills.motions.object_search import GLIMPSED_S
from executive.skills.pick import PickParams
from executive.skills.search import SearchParams
from executive.skills.skill import Lasting
from robot.messages import Look, Shape, Stand, Unnamed, Walk
from robot.planning.requests import BasePathRequest, LookPlan, LookRequest
from robot.se3 import SE3
from tests.fakes.stage import Stage

ON_COUNTER = SE3((2.0, 2.6, 0.75))


@pytest.fixture
def stage():
    stage = Stage()
    cup = stage.puppet.things["cup"]
    cup.known, cup.seen_s = False, -math.inf
    return stage


def share(stage, place_id: str) -> float:
    (looked,) = (one for one in stage.puppet.world().looked if one.place_id == place_id)
    return sum(math.isfinite(seen_s) for seen_s in looked.seen_s) / len(looked.seen_s)


def test_all_of_a_place_is_looked_at(stage):
    assert stage.run(InspectParams(place_ids=("counter",))).status == "succeeded"
    assert share(stage, "counter") == 1.0


def planned_view(stage) -> tuple[float, float]:
    (asked,) = (r for r in stage.planner.requests if isinstance(r, BasePathRequest))
    return asked.goal[:2]


def test_a_view_is_not_stepped_onto_to_the_centimetre(stage):
    stage.puppet.X_WS = SE3((-1.0, -2.5, 0.0))
    assert stage.run(InspectParams(place_ids=("counter",))).status == "succeeded"
    off_m = math.dist(stage.puppet.X_WS.p[:2], planned_view(stage))
    assert stage.puppet.description.walking.exact_steps.tolerance_m < off_m <= VIEW_M
    assert stage.puppet.mode == "stand"


def test_who_has_seen_all_of_a_place_in_passing_does_not_go_there(stage, monkeypatch):
    puppet, tick = stage.puppet, stage.puppet.tick
    puppet.X_WS = SE3((-1.0, -2.5, 0.0))

    def passing() -> None:
        tick()
        if puppet.time_s > 4.0:
            puppet._looked["counter"] = [puppet.time_s] * len(puppet._looked["counter"])

    monkeypatch.setattr(puppet, "tick", passing)
    assert stage.run(InspectParams(place_ids=("counter",))).status == "succeeded"
    assert math.dist(puppet.X_WS.p[:2], planned_view(stage)) > 1.0
    assert puppet.mode == "stand"


def test_what_was_looked_over_lately_is_not_looked_at_again(stage):
    stage.run(InspectParams(place_ids=("counter",)))
    before = len(stage.commands(Look))
    assert stage.run(InspectParams(place_ids=("counter",))).status == "succeeded"
    assert len(stage.commands(Look)) == before
    stage.puppet.time_s += 2.0 * RECENT_S
    stage.run(InspectParams(place_ids=("counter",)))
    assert len(stage.commands(Look)) > before


def test_it_ends_when_one_of_the_things_is_seen_there(stage):
    stage.puppet.things["cup"].X_WO = ON_COUNTER
    asked = InspectParams(place_ids=("counter", "table"), object_ids=("cup",))
    assert stage.run(asked).status == "succeeded"
    assert stage.puppet.things["cup"].seen_s == pytest.approx(stage.puppet.time_s, abs=1.0)


def test_nothing_is_looked_at_when_all_things_were_just_seen_elsewhere(stage):
    cup = stage.puppet.things["cup"]
    cup.known, cup.seen_s = True, 0.0
    asked = InspectParams(place_ids=("counter",), object_ids=("cup",))
    assert stage.run(asked).status == "succeeded"
    assert not stage.commands(Look)


def test_without_a_place_it_only_looks_around(stage):
    assert stage.run(InspectParams()).status == "succeeded"
    assert not stage.commands(Walk)
    assert stage.commands(Look)


def test_a_place_that_cannot_be_seen_is_no_empty_place(stage):
    stage.planner._look = lambda request: LookPlan(
        stance=None, cut_off=tuple(range(len(request.points_W)))
    )
    report = stage.run(InspectParams(place_ids=("counter",), object_ids=("cup",)))
    assert report.failure.code == "place_not_seen"
    assert "no way leads to the counter" in report.failure.cause


@pytest.mark.parametrize(("believed_there", "code"), [(False, ""), (True, "place_not_seen")])
def test_a_thing_may_stand_where_a_little_stays_hidden_near_to_where_it_was(
    stage, believed_there, code
):
    corner, *others = next(p for p in stage.puppet.map().places if p.id == "counter").samples()
    stage.puppet.hidden, stage.puppet.blind = tuple(corner.tolist()), True
    cup = stage.puppet.things["cup"]
    cup.known, cup.X_WO = True, SE3(tuple(corner if believed_there else others[-1]))
    report = stage.run(InspectParams(place_ids=("counter",), object_ids=("cup",)))
    assert (report.failure.code if report.failure else "") == code


@pytest.mark.parametrize("full", [False, True])
def test_what_the_home_itself_hides_is_told_so(stage, monkeypatch, full):
    """A board above the eyes: nobody is asked to clear it, unless something stands on it."""
    monkeypatch.setattr("executive.skills.inspect.HIDDEN", 0.0)
    corner, *others = next(p for p in stage.puppet.map().places if p.id == "counter").samples()
    stage.puppet.hidden = tuple(corner.tolist())
    if full:
        stage.puppet.things["cup"].X_WO = SE3(tuple(others[-1]))
    report = stage.run(InspectParams(place_ids=("counter",)))
    assert report.failure.code == "place_not_seen"
    assert ("looked" in report.failure.evidence) is not full


def test_a_search_goes_on_where_another_skill_has_looked(stage):
    """What is known of the surfaces outlives the skill, the try and the job."""
    stage.puppet.blind = True
    stage.run(InspectParams(place_ids=("counter", "table")))
    asked = len(stage.planner.requests)
    report = stage.run(SearchParams(object_id="cup"))
    assert report.failure.code == "object_not_seen"
    assert "looked on the table and the counter" in report.failure.cause
    assert len(stage.planner.requests) == asked


def test_a_search_after_one_in_vain_looks_again(stage):
    stage.puppet.blind = True
    assert stage.run(SearchParams(object_id="cup")).failure.evidence["looked"] == "everywhere"
    stage.puppet.blind = False
    stage.puppet.things["cup"].X_WO = ON_COUNTER
    assert stage.run(SearchParams(object_id="cup")).status == "succeeded"
    assert any(isinstance(asked, LookRequest) for asked in stage.planner.requests)


def test_what_looks_for_things_may_take_longer_in_a_larger_house(stage):
    def limit_s() -> float:
        skill = stage.make(SearchParams(object_id="cup"))
        assert isinstance(skill, Lasting)
        return skill.limit_s()

    small_s, known = limit_s(), stage.puppet.world_map
    stage.puppet.world_map = replace(known, bounds_m=(-10, -10, 10, 10))
    wide_s = limit_s()
    table = known.places[0]
    more = tuple(
        replace(table, id=f"table_{n}", X_WP=SE3((n, 5.0, 0.7)), of=f"table_{n}") for n in range(9)
    )
    stage.puppet.world_map = replace(stage.puppet.world_map, places=(*known.places, *more))
    assert DEFAULT_LIMIT_S < small_s < wide_s < limit_s()


def test_where_it_was_said_to_be_is_looked_at_first(stage):
    stage.puppet.X_WS = SE3((-1.0, -2.5, 0.0))
    stage.run(SearchParams(object_id="cup", place_ids=("counter",)), until_phase="looking over")
    assert stage.phases[-1] == "looking over the counter"


def shown_at(stage, times_s: tuple[float, ...]) -> None:
    """The cup shows in the pictures of these times, wherever the robot looks."""
    puppet, cup, tick = stage.puppet, stage.puppet.things["cup"], stage.puppet.tick
    left = list(times_s)

    def passing() -> None:
        tick()
        cup.known = cup.seen_s > -math.inf
        if left and puppet.time_s >= left[0]:
            cup.known, cup.seen_s = True, left.pop(0)

    puppet.tick = passing


def test_the_feet_do_not_stop_for_what_shows_often_enough_on_the_way(stage):
    stage.puppet.X_WS = SE3((-2.5, -2.5, 0.0))
    shown_at(stage, (5.0, 5.2, 5.4))
    stage.run(PickParams(object_id="cup"), until_phase="planning")
    assert stage.puppet.time_s == pytest.approx(5.4, abs=0.15)
    assert stage.puppet.mode == "walk", "who takes it sets out again at once"
    assert isinstance([c for c in stage.puppet.sent if isinstance(c, Walk | Stand)][-1], Walk)


def test_who_only_looks_for_it_stands_in_the_end(stage):
    stage.puppet.X_WS = SE3((-2.5, -2.5, 0.0))
    shown_at(stage, (5.0, 5.2, 5.4))
    assert stage.run(SearchParams(object_id="cup")).status == "succeeded"
    assert stage.puppet.mode == "stand"


def test_the_feet_stop_for_what_showed_once(stage):
    stage.puppet.X_WS = SE3((-2.5, -2.5, 0.0))
    shown_at(stage, (5.0,))
    assert stage.run(SearchParams(object_id="cup")).status == "succeeded"
    assert stage.puppet.time_s > 5.0 + GLIMPSED_S
    assert stage.puppet.mode == "stand"


def nameless(*may_be: str, near: bool = True) -> Unnamed:
    shape = Shape(kind="cylinder", size_m=(0.08, 0.08, 0.1))
    return Unnamed(id="unnamed_3", words="white thing of 10 cm", X_WO=ON_COUNTER, shape=shape,
                   seen_s=0.0, may_be=may_be, near=near)  # fmt: skip


@pytest.mark.parametrize("near", [True, False])
def test_what_has_no_name_and_may_be_the_thing_is_not_taken_for_absent(stage, near):
    stage.puppet.unnamed = (nameless("cup", near=near),)
    asked = InspectParams(place_ids=("counter",), object_ids=("cup",))
    report = stage.run(asked)
    assert report.failure.code == "not_made_out"
    assert "white thing of 10 cm on the counter is the" in report.failure.cause
    looks = [r for r in stage.planner.requests if isinstance(r, LookRequest) and r.vain_m]
    assert [r.points_W for r in looks] == [(ON_COUNTER.p,)] * SIDES


def test_it_is_looked_at_closer_though_the_place_was_looked_over_just_now(stage):
    stage.run(InspectParams(place_ids=("counter",)))
    stage.puppet.unnamed = (nameless("cup"),)
    asked = InspectParams(place_ids=("counter",), object_ids=("cup",))
    assert stage.run(asked).failure.code == "not_made_out"


def test_what_stands_elsewhere_or_is_something_else_makes_no_doubt(stage):
    asked = InspectParams(place_ids=("table",), object_ids=("cup",))
    stage.puppet.unnamed = (nameless("cup"),)
    assert stage.run(asked).status == "succeeded"
    stage.puppet.unnamed = (nameless("plate"),)
    asked = InspectParams(place_ids=("counter",), object_ids=("cup",))
    assert stage.run(asked).status == "succeeded"


@pytest.mark.parametrize(("least", "code"), [(None, ""), (1, "not_made_out"), (0, "")])
def test_who_counts_says_it_and_who_asks_for_so_many_does_not_know(stage, least, code):
    stage.puppet.unnamed = (nameless("cup"),)
    asked = InspectParams(place_ids=("counter",), about_ids=("cup",), least=least)
    report = stage.run(asked)
    assert (report.failure.code if report.failure else "") == code


def test_the_search_ends_at_what_is_made_out_from_near_by(stage, monkeypatch):
    puppet, tick = stage.puppet, stage.puppet.tick
    cup = puppet.things["cup"]
    cup.X_WO, puppet.blind = ON_COUNTER, True
    puppet.unnamed = (nameless("cup"),)

    def made_out() -> None:
        tick()
        if stage.skill.body.phase.startswith("looking closer"):
            puppet.blind, puppet.unnamed = False, ()

    monkeypatch.setattr(puppet, "tick", made_out)
    report = stage.run(SearchParams(object_id="cup"))
    assert report.status == "succeeded", report


def test_what_is_in_a_hand_is_looked_for_nowhere():
    stage = Stage()
    assert stage.run(PickParams(object_id="cup")).status == "succeeded"
    stage.puppet.blind = True
    stage.puppet.time_s += 10.0
    before = len(stage.commands(Look))
    assert stage.run(SearchParams(object_id="cup")).status == "succeeded"
    assert len(stage.commands(Look)) == before
