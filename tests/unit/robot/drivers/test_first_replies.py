"""Joints whose first replies are lost stand nowhere, in every family alike, and never at 0."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robot.drivers.motors.life import FIRST_PERIODS
from robot.errors import DriverError
from sim.devices.can_motor import CanMotor
from tests.fakes import ethernet_rig
from tests.fakes.few_motors import (
    AnyRig,
    boards,
    can,
    moteuses,
    motors_of,
    robstrides,
    servos,
)

MAKERS = {
    "can": can, "robstride": robstrides, "moteus": moteuses, "dynamixel": servos,
    "ethernet": boards,
}  # fmt: skip
FOR_EVER = 1_000_000
NEAR_RAD = 0.03
losses = st.lists(st.integers(0, 7), min_size=4, max_size=4)
places = st.lists(st.floats(0.3, 1.9), min_size=4, max_size=4)


every_family = pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)


def still(make: Callable[[], AnyRig], angles: list[float]) -> AnyRig:
    """Motors at rest, each somewhere else."""
    rig = make()
    for motor, angle in zip(motors_of(rig).values(), angles, strict=True):
        motor.shaft.q_rad, motor.shaft.qd_rad_s, motor.shaft._spring_nm_rad = angle, 0.0, 0.0
    return rig


def lose(rig: AnyRig, counts: list[int]) -> None:
    """Of the next replies of each joint, or of its board, so many."""
    for name, motor, count in zip(motors_of(rig), motors_of(rig).values(), counts, strict=True):
        if isinstance(rig, ethernet_rig.Rig):
            rig.cable(name).trouble.loses = count
        else:
            setattr(motor.trouble, "loses" if isinstance(motor, CanMotor) else "spoils", count)


def lose_once_asked(rig: AnyRig, counts: list[int]) -> None:
    """When the interview is over, and the first period begins."""
    begin, periods = rig.driver._periods.begin, rig.driver._periods

    def begins() -> None:
        begin()
        lose(rig, counts)
        periods.begin = begin

    periods.begin = begins


def stand(rig: AnyRig) -> np.ndarray:
    joints, motors = rig.joints.joints, motors_of(rig)
    return np.array([one.joint_rad(motors[name].shaft.q_rad) for name, one in joints.items()])


@every_family
@settings(max_examples=12, deadline=None)
@given(counts=losses, angles=places)
def test_what_was_never_heard_did_not_move_and_is_held_where_it_stands(make, counts, angles):
    rig = still(make, angles)
    begin = stand(rig)
    lose_once_asked(rig, counts)
    with rig.driver as driver:
        for _ in range(2):
            state = driver.read()
            heard = np.isfinite(state.age_s)
            np.testing.assert_allclose(state.q[heard], begin[heard], atol=NEAR_RAD)
        for _ in range(60):
            command = rig.hold(kp=4.0)
            command.q_des[:] = begin
            command.stamp_s = rig.clock.now_s()
            driver.write(command)
            np.testing.assert_allclose(stand(rig), begin, atol=NEAR_RAD)
            state = driver.read()
            np.testing.assert_allclose(state.q, begin, atol=NEAR_RAD)
            assert {alarm.code for alarm in state.alarms} <= {"silent", "noisy"}
        assert not driver.speeds.moved.any()


@every_family
@settings(max_examples=10, deadline=None)
@given(counts=losses, angles=places)
def test_a_first_command_finds_joints_where_they_stand_though_no_reply_to_it_came(
    make, counts, angles
):
    rig = still(make, angles)
    begin = stand(rig)
    with rig.driver as driver:
        assert driver.claim()  # and nothing that came before is believed
        lose_once_asked(rig, counts)
        command = rig.hold(kp=4.0)
        command.q_des[:] = begin
        try:
            driver.write(command)
        except DriverError:  # not waited for any longer, and nothing was commanded
            assert max(counts) >= FIRST_PERIODS
            assert all(motor.tau_nm == 0.0 for motor in motors_of(rig).values())
            return
        assert np.isfinite(driver.reception.heard_s).all()
        driver.read()
        np.testing.assert_allclose(stand(rig), begin, atol=NEAR_RAD)
        assert not driver.speeds.moved.any()


@pytest.mark.parametrize("make_servos_or_boards", [servos, boards], ids=["dynamixel", "ethernet"])
def test_who_says_nothing_from_being_armed_on_is_not_waited_for_and_gets_no_torque(
    make_servos_or_boards,
):
    rig = still(make_servos_or_boards, [1.0] * 4)
    with rig.driver as driver:
        assert driver.claim()
        lose_once_asked(rig, [FOR_EVER, FOR_EVER, 0, 0])
        begun_s = rig.clock.now_s()
        with pytest.raises(DriverError, match="joint0_0"):
            driver.write(rig.hold())
        assert rig.clock.now_s() - begun_s < 2.0
        lose(rig, [0] * 4)
        assert all(motor.tau_nm == 0.0 for motor in motors_of(rig).values())
