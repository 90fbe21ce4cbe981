"""A motor breaks: the robot is lowered on what it has left, says why, and takes no more orders."""

from dataclasses import replace

import pytest

from benchmarks.rig import Rig
from robot.messages import GetUp, MotorAlarm, Stand, Walk

BROKEN = MotorAlarm("silent", "left_wrist_roll", "SIT", "silent for 10 periods", "check its cable")


def break_down(rig: Rig, *alarms: MotorAlarm) -> None:
    read = rig.plant.read

    def reading():
        sample = read()
        return replace(sample, motors=replace(sample.motors, alarms=alarms))

    rig.plant.read = reading


@pytest.mark.parametrize("walks", [pytest.param(False, marks=pytest.mark.rest), True])
def test_it_squats_within_seconds_and_stays_there_on_its_feet(walks):
    rig = Rig(seed=2)
    assert rig.run(0.3)
    if walks:
        rig.send(Walk, forward_m_s=0.3, left_m_s=0.0, turn_rad_s=0.0, hold_s=10.0)
        assert rig.run(2.0)
    standing_m = rig.X_WB.p[2]
    break_down(rig, BROKEN)
    assert rig.run(0.02)
    failure = rig.loop.state().failure
    assert "left_wrist_roll" in failure.cause
    assert (failure.code, failure.suggestion) == ("motor_fault", "check its cable")
    assert rig.run(5.0 if walks else 3.0)
    assert rig.X_WB.p[2] < 0.8 * standing_m
    assert rig.run(10.0)  # and there it stays
    assert rig.upright
    assert rig.X_WB.p[2] < 0.8 * standing_m
    assert rig.loop.state().failure == failure


def test_orders_to_the_legs_are_refused_with_the_reason():
    rig = Rig(seed=2)
    assert rig.run(0.3)
    break_down(rig, BROKEN)
    rig.run(0.1)
    for kind, fields in (
        (Walk, {"forward_m_s": 0.3, "left_m_s": 0.0, "turn_rad_s": 0.0, "hold_s": 9.0}),
        (Stand, {}),
        (GetUp, {}),
    ):
        rig.send(kind, **fields)
        legs = rig.loop.state().activities["legs"]
        assert legs.status == "failed"
        assert "left_wrist_roll: silent" in legs.detail


@pytest.mark.parametrize("level", ["WARN", "DERATE", "HOLD"])
def test_a_milder_alarm_is_told_and_lowers_nobody(level):
    rig = Rig(seed=2)
    assert rig.run(0.3)
    alarm = MotorAlarm("warm", "left_knee", level, "70 °C of 80: less torque", "let it rest")
    break_down(rig, alarm)
    assert rig.run(0.5)
    assert rig.loop.state().alarms == (alarm,)
    assert rig.loop.state().failure is None
