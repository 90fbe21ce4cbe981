"""The skills on the whole stack under them: physics, controller, perception, planners."""

import math

import msgspec
import pytest

from executive.skills.balance import BalanceParams
from executive.skills.catalogue import make
from executive.skills.context import SkillContext
from executive.skills.inspect import InspectParams
from executive.skills.motions.support import tilt
from executive.skills.navigate import FloorPose, NavigateParams, Step
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from robot.bringup.fast import FastRuntime
from robot.model.description import load
from robot.planning.inline import InlinePlanner
from robot.reality import faults
from robot.se3 import SE3
from sim.faults import apply
from sim.simulation import SimulatedWorld, Simulation
from sim.world import load as load_world
from sim.world_schema import Start

JUNO = load("juno")
TICK_S = 0.05


@pytest.fixture(scope="module")
def planner():
    return InlinePlanner(JUNO)


def carry_out(runtime, context, parameters, *, limit_s=180.0, each_tick=None):
    """Run one skill to its end; the report. `each_tick` is called with the phase."""
    skill = make(parameters, context)
    skill.start(runtime.clock.now_s())
    end_s = runtime.clock.now_s() + limit_s
    while runtime.clock.now_s() < end_s:
        runtime.advance(TICK_S)
        report = skill.step(runtime.clock.now_s())
        if each_tick is not None:
            each_tick(report.phase)
        if report.status != "running":
            return report
    raise AssertionError(f"still {report.phase!r} after {limit_s} s")


def stance(runtime):
    return (runtime.link.world().X_WN @ runtime.link.body().X_NS).flat()


def test_walk_turn_and_postures(planner):
    with FastRuntime(Simulation().world("empty"), seed=3) as runtime:
        runtime.advance(0.5)
        context = SkillContext(link=runtime.link, planner=planner, description=JUNO, seed=3)
        goal = NavigateParams(pose=FloorPose(x_m=0.8, y_m=-0.4, yaw_rad=0.6))
        assert carry_out(runtime, context, goal).status == "succeeded"
        X_WB = runtime.plant.oracle.X_WB()
        assert math.dist(X_WB.p[:2], (0.8, -0.4)) < 0.06  # the base leans a little off the stance
        assert (
            carry_out(runtime, context, NavigateParams(by=Step(forward_m=-0.3))).status
            == "succeeded"
        )
        report = carry_out(runtime, context, BalanceParams(mode="squat", duration_s=1.0))
        assert report.status == "succeeded"
        report = carry_out(runtime, context, BalanceParams(mode="one_leg", duration_s=1.5))
        assert report.status == "succeeded", report
        assert runtime.link.body().mode == "stand"


def seen_share(runtime, place_id):
    """How much of a surface the world model has seen."""
    (looked,) = (one for one in runtime.link.world().looked if one.place_id == place_id)
    return sum(map(math.isfinite, looked.seen_s)) / len(looked.seen_s)


@pytest.mark.slow
def test_boards_that_are_looked_over_have_been_seen_and_a_glance_from_afar_is_none(planner):
    with FastRuntime(Simulation().world("kitchen"), seed=1) as runtime:
        runtime.advance(0.5)
        context = SkillContext(link=runtime.link, planner=planner, description=JUNO, seed=1)
        boards = ("shelf_lower", "shelf_middle")
        assert all(seen_share(runtime, board) == 0.0 for board in boards)
        report = carry_out(runtime, context, InspectParams(place_ids=boards))
        assert report.status == "succeeded", report
        assert all(seen_share(runtime, board) > 0.8 for board in boards)
        begin_s = runtime.clock.now_s()
        assert carry_out(runtime, context, InspectParams(place_ids=boards)).status == "succeeded"
        assert runtime.clock.now_s() - begin_s < 1.0


@pytest.mark.slow
def test_a_cup_is_picked_from_the_table_and_put_on_the_shelf(planner):
    with FastRuntime(Simulation().world("kitchen"), seed=1) as runtime:
        runtime.advance(0.5)
        context = SkillContext(link=runtime.link, planner=planner, description=JUNO, seed=1)
        before = runtime.plant.oracle.X_WO("red_cup")
        report = carry_out(runtime, context, PickParams(object_id="red_cup"))
        assert report.status == "succeeded", report
        held = context.holdings.find("red_cup")
        cup = runtime.plant.oracle.X_WO("red_cup")
        hand = runtime.link.world().X_WN @ runtime.link.body().hands[held.side].X_NG
        assert math.dist(cup.p, before.p) > 0.1, "it left the table"
        assert math.dist((hand @ held.X_GO).p, cup.p) < 0.015, "it is where the hand thinks it is"

        report = carry_out(
            runtime, context, PlaceParams(object_id="red_cup", place_id="shelf_middle")
        )
        assert report.status == "succeeded", report
        runtime.advance(1.0)
        cup = runtime.plant.oracle.X_WO("red_cup")
        shelf = next(p for p in runtime.link.map().places if p.id == "shelf_middle")
        x_m, y_m, z_m = shelf.X_WP.inverse().apply(cup.p)
        assert abs(x_m) < shelf.size_m[0] / 2
        assert abs(y_m) < shelf.size_m[1] / 2
        assert z_m == pytest.approx(0.05, abs=0.01)
        assert tilt(cup) < 0.1
        assert runtime.link.body().mode == "stand"
        assert context.holdings.all() == ()


@pytest.mark.slow
def test_somebody_in_the_way_is_walked_around(planner):
    with FastRuntime(Simulation().world("kitchen"), seed=4) as runtime:
        runtime.advance(0.5)
        context = SkillContext(link=runtime.link, planner=planner, description=JUNO)
        phases = []

        def step_in(phase):
            phases.append(phase)
            if len(phases) == 60:
                anna = faults.Move(target="anna", X_WO=SE3.from_xy_yaw(0.6, -1.5, math.pi))
                apply(runtime.plant, anna)

        goal = NavigateParams(pose=FloorPose(x_m=2.3, y_m=-1.5, yaw_rad=0.0))
        report = carry_out(runtime, context, goal, each_tick=step_in)
        assert report.status == "succeeded", report
        assert {"stopping for something in the way", "stopping for anna"} & set(phases)
        assert math.dist(stance(runtime).p[:2], (2.3, -1.5)) < 0.03


@pytest.mark.slow
def test_a_cup_pulled_out_of_the_hand_is_noticed(planner):
    with FastRuntime(Simulation().world("kitchen"), seed=4) as runtime:
        runtime.advance(0.5)
        context = SkillContext(link=runtime.link, planner=planner, description=JUNO)
        pulled = []

        def pull(phase):
            if "stepping back" in phase and not pulled:
                pulled.append(phase)
                down = faults.Push(impulse_n_s=(0.0, 0.0, -6.0), target="red_cup")
                apply(runtime.plant, down)

        report = carry_out(runtime, context, PickParams(object_id="red_cup"), each_tick=pull)
        assert report.failure.code == "object_dropped"
        assert context.holdings.all() == ()
        assert runtime.link.body().mode == "stand"


@pytest.mark.slow
@pytest.mark.rest
def test_a_cup_that_is_pulled_at_is_held_by_gripping_harder(planner):
    """Otherwise it would be gone (docs/control.md); a pull of 60 N takes it, see above."""
    world = msgspec.structs.replace(load_world("kitchen"), start=Start(at_m=(0.6, 0.1)))
    with FastRuntime(SimulatedWorld(world), seed=1) as runtime:
        runtime.advance(0.5)
        context = SkillContext(link=runtime.link, planner=planner, description=JUNO, seed=1)
        report = carry_out(runtime, context, PickParams(object_id="red_cup"))
        assert report.status == "succeeded", report
        (held,) = context.holdings.all()
        name = JUNO.hands[held.side].motor
        motor, limit_n = JUNO.motor_names.index(name), JUNO.motors[name].torque_limit_nm
        assert runtime.link.body().hands[held.side].pulls == 0
        down = faults.Push(impulse_n_s=(0.0, 0.0, -6.0), duration_s=0.3, target="red_cup")
        apply(runtime.plant, down)
        for _ in range(100):
            runtime.advance(0.02)
            assert abs(runtime.link.body().tau_nm[motor]) < 1.02 * limit_n
        hand = runtime.link.body().hands[held.side]
        assert hand.opening_m == pytest.approx(held.gap_m, abs=0.005)
        assert hand.pulls == 1


@pytest.mark.slow
@pytest.mark.rest
def test_a_cup_that_is_knocked_over_is_taken_as_it_lies(planner):
    world = msgspec.structs.replace(
        load_world("kitchen"), start=Start(at_m=(1.1, -0.6), yaw_deg=90)
    )
    with FastRuntime(SimulatedWorld(world), seed=2) as runtime:
        runtime.advance(0.5)
        context = SkillContext(link=runtime.link, planner=planner, description=JUNO, seed=2)
        hit = []

        def knock(phase):
            if phase.startswith("stepping up") and not hit:
                hit.append(phase)
                apply(runtime.plant, faults.KnockOver(target="red_cup", towards_deg=194.0))

        report = carry_out(runtime, context, PickParams(object_id="red_cup"), each_tick=knock)
        assert report.status == "succeeded", report
        assert not context.holdings.find("red_cup").upright
        assert tilt(runtime.plant.oracle.X_WO("red_cup")) > 1.0
        assert runtime.link.world().tracks[0].held_by == context.holdings.find("red_cup").side
