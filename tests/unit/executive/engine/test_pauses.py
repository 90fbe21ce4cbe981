"""Pauses as tables of ticks: when it is one, and what it costs."""

from __future__ import annotations

import pytest

from executive.engine.jobs import Limits
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.search import SearchParams
from robot.messages import LidarScan
from tests.fakes.rig import PICK, TICK_S, WALK, Rig
from tests.fakes.scripted_skills import Script

LONG = 10**9


def test_a_pause_is_one_only_when_the_body_stands():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=10)]})
    rig.begin(WALK).tick(5)
    rig.executive.pause()
    rig.tick(10)
    assert rig.executive.state == "pausing"
    rig.tick(5)
    assert rig.executive.state == "paused"
    assert rig.states == {1: "paused"}
    assert rig.troupe.names() == ["navigate", "stop"]
    rig.tick(100)
    assert rig.troupe.names() == ["navigate", "stop"]
    rig.executive.resume()
    rig.tick(2)
    assert rig.executive.state == "working"
    assert rig.troupe.names() == ["navigate", "stop", "navigate"]


def test_a_pause_in_a_recovery_goes_on_with_the_same_try():
    rig = Rig(
        {
            PickParams: [Script(code="grasp_missed"), Script(steps=10), Script(steps=10)],
            SearchParams: [Script(steps=10)],
        }
    )
    rig.begin(PICK).tick(5)
    assert rig.troupe.names() == ["pick", "search"]
    rig.executive.pause()
    rig.tick(5)
    rig.executive.resume()
    rig.tick(15)
    rig.executive.pause()
    rig.tick(5)
    rig.executive.resume()
    assert rig.run() is True
    names = [name for name in rig.troupe.names() if name != "stop"]
    assert names == ["pick", "search", "search", "pick", "pick"]
    attempts = [skill.attempt for skill in rig.troupe.made if isinstance(skill.params, PickParams)]
    assert attempts == [0, 1, 1]
    assert rig.executive.outcome.recoveries == 1


def test_pausing_twice_and_resuming_twice_is_once():
    rig = Rig({NavigateParams: [Script(steps=10)]})
    rig.begin(WALK).tick(3)
    for _ in range(2):
        rig.executive.pause()
        rig.tick(4)
    for _ in range(2):
        rig.executive.resume()
        rig.tick(1)
    assert rig.run() is True
    assert len(rig.at("pause")) == len(rig.at("resume")) == 1


def test_resuming_before_the_body_stands_waits_for_it():
    rig = Rig({NavigateParams: [Script(steps=5, stop_steps=20)]})
    rig.begin(WALK).tick(3)
    rig.executive.pause()
    rig.tick(3)
    rig.executive.resume()
    assert rig.run() is True
    first, second = (skill for skill in rig.troupe.made if skill.calls)
    assert first.calls.count("stop") == 21
    assert second.calls.count("step") == 6


def test_paused_time_is_no_part_of_a_step_or_of_a_jobs_limit():
    rig = Rig({NavigateParams: [Script(steps=40)]})
    rig.submit(WALK, limits=Limits(duration_s=5.0))
    rig.tick(3)
    rig.executive.pause()
    rig.tick(6000)
    rig.executive.resume()
    assert rig.run() is True


def test_a_job_that_takes_too_long_ends_with_timeout_and_at_rest():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=8)]})
    rig.submit(WALK, limits=Limits(duration_s=1.0))
    verdict = rig.run()
    assert verdict.code == "timeout"
    assert rig.now_s == pytest.approx(1.0 + 8 * TICK_S, abs=0.16)
    assert rig.stage.quiet


def test_a_paused_robot_does_not_lose_its_jobs_when_a_sensor_falls_silent():
    rig = Rig({NavigateParams: [Script(steps=20)]}, rates_hz={"sensors/lidar": 10.0})
    rig.link.messages["lidar"] = scan(0.0)
    rig.begin(WALK).tick(5)
    rig.executive.pause()
    rig.tick(1000)
    assert rig.executive.state == "paused"
    assert rig.states == {1: "paused"}
    rig.executive.resume()
    rig.tick(20)
    assert rig.events("hold") == ["hold"]
    rig.link.messages["lidar"] = scan(1e6)
    assert rig.run() is True


def test_a_pause_while_a_sensor_is_silent_is_one_too():
    rig = Rig({NavigateParams: [Script(steps=20)]}, rates_hz={"sensors/lidar": 10.0})
    rig.link.messages["lidar"] = scan(0.0)
    rig.begin(WALK).tick(30)
    assert rig.events("hold") == ["hold"]
    rig.executive.pause()
    rig.tick(10)
    assert rig.executive.state == "paused"


def scan(stamp_s):
    return LidarScan(stamp_s=stamp_s, angle_min_rad=0, angle_step_rad=0.1, ranges_m=())
