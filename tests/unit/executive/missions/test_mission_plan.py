"""A dry run asks the planner, so that what it calls feasible is, and takes about so long."""

import math
from typing import get_args

import pytest
from msgspec.structs import replace

from executive.meaning import request
from executive.missions.plan import Plan, Row, forecast, lines
from executive.missions.rehearsal import Rehearsal
from executive.skills.catalogue import skill_of
from executive.skills.gesture import Gesture, GestureKind, GestureParams
from executive.skills.motions.pacing import walking_s
from executive.skills.navigate import NavigateParams, Step
from executive.skills.wait import WaitParams
from executive.trees import parts as p
from executive.trees.parts import errands
from robot.model.description import load
from robot.planning.requests import BasePath
from sim.simulation import SimulatedWorld, Simulation
from sim.world import load as load_world
from tests.fakes.missions import check

JUNO = load("juno")
KITCHEN = request.setting(Simulation(), "kitchen", robot="juno")
TASK = request.request("pick up the red cup and put it on the shelf", KITCHEN).task


def way(*waypoints, clearance_m=1.0):
    return BasePath(waypoints=waypoints, length_m=1.0, clearance_m=clearance_m)


def seconds(path, *, carrying=False):
    return walking_s((0.0, 0.0, 0.0), path, JUNO, carrying=carrying)


def test_a_way_takes_longer_that_is_longer_bends_or_is_narrow():
    straight = seconds(way((2.0, 0.0, 0.0)))
    assert 6.0 < straight < 14.0
    assert seconds(way((4.0, 0.0, 0.0))) > straight + 2.0 / JUNO.walking.max_forward_m_s
    assert seconds(way((2.0, 0.0, 0.0), (2.0, 0.0, 3.0))) > straight + 3.0
    assert seconds(way((1.0, 0.0, 0.0), (1.7, 0.7, 1.5))) > straight
    assert seconds(way((2.0, 0.0, 0.0), clearance_m=0.2)) > straight + 1.0
    assert seconds(way((2.0, 0.0, 0.0)), carrying=True) > straight


def test_a_pick_and_a_place_are_planned_with_the_hand_and_from_where_the_robot_is_by_then():
    plan = forecast(TASK, KITCHEN)
    assert plan.problems == 0
    assert plan.total_s == pytest.approx(46.5, rel=0.15)  # the run with seed 0


def test_what_no_hand_reaches_is_told():
    entries = load_world("kitchen")
    moved = tuple(
        replace(thing, on="doorway", at_m=(0.0, 0.0)) if thing.id == "red_cup" else thing
        for thing in entries.objects
    )
    where = replace(KITCHEN, world=SimulatedWorld(replace(entries, objects=moved)))
    pick, place = (row for row in forecast(TASK, where).rows if row.kind == "step")
    assert "short of the red cup" in pick.problem
    assert place.problem == ""  # nothing is known against it


def steps(text):
    task = request.request(text, KITCHEN).task
    return [row for row in forecast(task, KITCHEN).rows if row.kind == "step"]


@pytest.mark.parametrize(
    ("text", "ran_s"),  # the runs in `--fast`, seed 0
    [
        ("wave at anna", 9.8),
        ("nod at anna", 1.9),
        ("follow anna", 12.4),
        ("bow", 2.3),
        ("point at the table", 3.7),
    ],
)
def test_what_is_between_robot_and_people_takes_as_long_as_in_a_run(text, ran_s):
    (step,) = steps(text)
    assert step.problem == ""
    assert step.takes_s == pytest.approx(ran_s, rel=0.15)


def test_a_sign_takes_longer_when_the_body_has_to_turn_first():
    (ahead,) = steps("point at the table")
    _, behind = steps("turn around, then point at the table")
    assert behind.takes_s > ahead.takes_s + 1.0


def test_what_is_given_away_is_brought_to_the_person_and_gone_from_the_hand():
    outlook = Rehearsal(KITCHEN)
    assert outlook.place_of("red_cup").name == "table"
    for errand in errands(request.request("give the red cup to anna", KITCHEN).task):
        told = skill_of(errand.params).forecast(errand.params, outlook)
        assert told.problem == ""
        assert told.takes_s > 10.0
    anna = outlook.map.person("anna")
    assert math.dist(outlook.X_WS.p[:2], anna.X_WO.p[:2]) == pytest.approx(
        JUNO.handy.giving.before_person_m
    )
    assert outlook.place_of("red_cup") is None
    assert not outlook.carrying


def test_whoever_is_followed_is_taken_to_go_on_to_the_place():
    (there,), (here,) = steps("follow anna to the shelf"), steps("follow anna to the table")
    assert there.takes_s > here.takes_s + 5.0


@pytest.mark.parametrize("kind", get_args(GestureKind))
def test_every_sign_takes_time(kind):
    target = {"person_id": "anna"} if kind == "point" else {}
    assert Gesture.forecast(GestureParams(kind=kind, **target), Rehearsal(KITCHEN)).takes_s > 1.0


def test_what_takes_a_moment_is_not_said_to_take_no_time():
    told = lines(Plan(rows=(Row(path="1", depth=0, name="say 'hi'", kind="step", takes_s=0.1),),
                      total_s=0.1, problems=0))  # fmt: skip
    assert "under 1 s" in told[0]
    assert " 0 s" not in told[0]


def test_a_step_out_of_the_map_is_told_and_the_rest_goes_on_from_where_it_began():
    there = p.Errand(name="out", params=NavigateParams(by=Step(forward_m=7.0)))
    back = p.Errand(name="in", params=NavigateParams(by=Step(forward_m=0.5)))
    out, on = forecast(p.Series(name="all", parts=(there, back)), KITCHEN).rows
    assert "outside this world" in out.problem
    assert on.problem == ""


def test_a_limit_that_is_shorter_than_the_forecast_is_told():
    wait = p.Errand(name="wait", params=WaitParams(duration_s=9.0))
    limited = p.Timeout(name="wait", part=wait, limit_s=8.0)
    made = forecast(
        p.Timeout(name="all", part=p.Series(name="all", parts=(limited,)), limit_s=5.0), KITCHEN
    )
    assert [row.problem for row in made.rows] == ["it has 8 s, and takes about 9 s"]
    assert lines(made)[-1] == "  will not work: it has 5 s, and takes about 9 s"


def test_every_step_has_its_row_and_a_turn_its_angle(tmp_path):
    path = tmp_path / "it.yaml"
    path.write_text("""name: it
steps: [{go_to: {by: {turn_deg: 720}}}, {for_each: x, in: [], do: [wave]}]
""")
    made = forecast(check(path).task, KITCHEN)
    assert [(row.path, row.name) for row in made.rows] == [
        ("1", "turn 720° left"), ("2", "for each x, of which there is none")
    ]  # fmt: skip
