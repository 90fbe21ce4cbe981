"""A dry run asks the planner, so that what it calls feasible is, and takes about so long."""

import pytest
from msgspec.structs import replace

from executive.meaning import request
from executive.missions.pacing import walking_s
from executive.missions.plan import forecast
from robot.model.description import load
from robot.planning.requests import BasePath
from sim.reality import SimulatedWorld, Simulation
from sim.world import load as load_world

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
    assert seconds(way((4.0, 0.0, 0.0))) > straight + 4.0
    assert seconds(way((2.0, 0.0, 0.0), (2.0, 0.0, 3.0))) > straight + 3.0
    assert seconds(way((1.0, 0.0, 0.0), (1.7, 0.7, 1.5))) > straight
    assert seconds(way((2.0, 0.0, 0.0), clearance_m=0.2)) > straight + 1.0
    assert seconds(way((2.0, 0.0, 0.0)), carrying=True) > straight


def test_a_pick_and_a_place_are_planned_with_the_hand_and_from_where_the_robot_is_by_then():
    plan = forecast(TASK, KITCHEN)
    assert plan.problems == 0
    assert plan.total_s == pytest.approx(64.0, rel=0.15)  # the run with seed 0


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
