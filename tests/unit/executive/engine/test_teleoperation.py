"""Driving by hand: bounded, dying out, never beside a task, never after a stop."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace as changed

from executive.engine.loop import PERIOD_S
from executive.engine.teleoperation import (
    AHEAD_M,
    HOLD_S,
    SILENCE_S,
    Velocity,
    bounded,
)
from executive.frontends.composition_root import REALITY
from executive.meaning import request
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from executive.skills.wait import WaitParams
from executive.trees.build import build
from executive.trees.parts import Errand, Series
from robot import messages as m
from robot.se3 import SE3
from tests.fakes.puppet_runtime import PuppetRuntime, SensingPuppet

WHERE = request.setting(REALITY, "empty", robot="juno")
GAIT = WHERE.description.walking
AHEAD = Velocity(0.2, 0.0, 0.0)
FOREVER = Series(name="task", parts=(Errand(name="wait", params=WaitParams()),))


class Live(PuppetRuntime):
    """A runtime whose time goes on while it is paused, as the wall's does."""

    def wake(self):
        """It never sleeps."""


class Rig:
    """A session whose robot is a puppet."""

    def __init__(self, world_map):
        self.puppet = SensingPuppet(WHERE.description, {}, world_map, X_WN=SE3())
        runtime = Live(self.puppet)
        self.session = Session(
            Setup(where=WHERE, kind="fast"),
            Opened(runtime, runtime.planner),
            attended=True,
        )
        self.teleoperation = self.session.teleoperation
        self.executive = self.session.executive
        self.pass_time(1.0)
        self.puppet.sent.clear()

    def pass_time(self, duration_s, *, telling=None):
        """Let time pass; with a velocity, told in every tick."""
        until_s = self.session.now_s + duration_s - 1e-9
        refused = ""
        while self.session.now_s < until_s:
            if telling is not None:
                refused = self.teleoperation.tell(telling, self.session.now_s)
            end_s = self.session.now_s + PERIOD_S - 1e-9
            self.session.run(until=lambda end_s=end_s: self.session.now_s >= end_s)
        return refused

    @property
    def walks(self):
        return [one for one in self.puppet.sent if isinstance(one, m.Walk)]

    @property
    def stands(self):
        return [one for one in self.puppet.sent if isinstance(one, m.Stand)]


@pytest.fixture
def rig():
    made = Rig(WHERE.world_map)
    with made.session:
        yield made


def test_a_velocity_is_walked_once_and_dies_out(rig):
    assert rig.teleoperation.tell(AHEAD, rig.session.now_s) == ""
    rig.pass_time(2.0)
    (walk,) = rig.walks
    assert (walk.forward_m_s, walk.left_m_s, walk.turn_rad_s) == AHEAD
    assert walk.hold_s == HOLD_S
    assert len(rig.stands) == 1
    assert HOLD_S <= rig.stands[0].stamp_s - walk.stamp_s <= HOLD_S + 3 * PERIOD_S


def test_a_stream_of_velocities_is_walked_as_long_as_it_comes(rig):
    assert rig.pass_time(2.0, telling=AHEAD) == ""
    assert len(rig.walks) >= 30 and not rig.stands
    ids = [one.id for one in rig.puppet.sent]
    assert ids == sorted(set(ids))


def test_nothing_is_sent_where_nothing_is_told(rig):
    rig.pass_time(2.0)
    assert not rig.walks and not rig.stands


@given(st.lists(st.floats(), min_size=3, max_size=3))
@settings(max_examples=200, deadline=None)
def test_whatever_is_told_is_within_what_the_robot_does(values):
    told = Velocity(*values)
    if not all(map(math.isfinite, told)):
        return
    found = bounded(told, WHERE.description, limit_m_s=0.2)
    assert math.hypot(found.forward_m_s, found.left_m_s) <= 0.2 + 1e-9
    assert -GAIT.max_backward_m_s <= found.forward_m_s <= GAIT.max_forward_m_s
    assert abs(found.turn_rad_s) <= GAIT.max_turn_rad_s


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_what_is_no_velocity_is_refused_and_does_not_end_one_that_is(rig, bad):
    rig.pass_time(0.2, telling=AHEAD)
    sent = len(rig.walks)
    assert "no velocity" in rig.teleoperation.tell(Velocity(bad, 0.0, 0.0), rig.session.now_s)
    rig.pass_time(0.1)
    assert len(rig.walks) == sent and not rig.stands


def test_a_task_that_is_under_way_is_not_interfered_with(rig):
    number = rig.executive.submit(lambda stage: build(FOREVER, stage), text="wait")
    rig.pass_time(0.2)
    assert rig.executive.state == "working"
    before = len(rig.walks)
    assert "a task is under way" in rig.pass_time(1.0, telling=AHEAD)
    assert len(rig.walks) == before
    rig.executive.pause()
    rig.pass_time(2.0)
    assert rig.executive.state == "paused"
    assert rig.pass_time(1.0, telling=AHEAD) == ""
    assert len(rig.walks) > before
    assert not next(job for job in rig.executive.jobs if job.number == number).failure


def test_a_stop_ends_it_until_nothing_was_told_for_a_while(rig):
    rig.pass_time(1.0, telling=AHEAD)
    rig.executive.stop("the operator said stop")
    rig.pass_time(0.2, telling=AHEAD)
    before = len(rig.walks)
    assert "told to stop" in rig.pass_time(3.0, telling=AHEAD)  # who goes on is not heeded
    assert len(rig.walks) == before
    rig.pass_time(SILENCE_S + 0.2)
    assert rig.pass_time(0.5, telling=AHEAD) == ""
    assert len(rig.walks) > before


def test_the_emergency_stop_ends_it_and_nothing_makes_it_stand_up(rig):
    rig.pass_time(1.0, telling=AHEAD)
    rig.executive.press_estop("pressed")
    rig.puppet.sent.clear()
    assert "emergency stop" in rig.pass_time(2.0, telling=AHEAD)
    assert not rig.walks


def test_a_robot_that_lies_is_not_driven(rig):
    rig.puppet.mode = "fallen"
    rig.pass_time(0.2)
    rig.puppet.sent.clear()
    assert rig.pass_time(1.0, telling=AHEAD) != ""
    assert not rig.walks


def test_it_does_not_walk_into_what_is_in_the_way_and_turns_away_from_it():
    X_WS = SE3.from_xy_yaw(0.0, 0.0, 0.0)
    radius_m = WHERE.description.body_radius_m
    here = SensingPuppet(WHERE.description, {}, WHERE.world_map, X_WN=SE3()).world().X_WB
    wall = m.Obstacle(
        id="wall", name="wall",
        X_WO=SE3((here.p[0] + radius_m + 0.05 + AHEAD_M[-1], here.p[1], 0.5)) @ X_WS,
        shapes=(m.Shape(kind="box", size_m=(0.1, 4.0, 1.0)),),
    )  # fmt: skip
    rig = Rig(changed(WHERE.world_map, obstacles=(*WHERE.world_map.obstacles, wall)))
    with rig.session:
        assert "in the way" in rig.pass_time(2.0, telling=AHEAD)
        assert rig.walks[-1].forward_m_s == 0.0
        rig.pass_time(PERIOD_S, telling=Velocity(0.2, 0.0, 0.3))
        assert rig.walks[-1].forward_m_s == 0.0 and rig.walks[-1].turn_rad_s == 0.3
        rig.pass_time(1.0, telling=Velocity(-0.1, 0.0, 0.0))
        assert rig.walks[-1].forward_m_s == -0.1
