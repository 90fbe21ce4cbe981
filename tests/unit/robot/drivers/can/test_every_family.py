"""What the driver promises of every emulated family of CAN motors, and of two on one bus."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest

from robot.drivers.motors.alarms import Level
from robot.errors import DriverError
from tests.fakes.can_rig import ARM as DAMIAOS
from tests.fakes.can_rig import (
    MOTEUS,
    MOTEUS_AND_A_DAMIAO,
    ROBSTRIDES,
    ROBSTRIDES_AND_A_DAMIAO,
    Rig,
    arm,
    killed,
)

PERIOD_S = 0.002


class Family(NamedTuple):
    """An arm of such motors; what they say of themselves in their own words."""

    text: str
    wrong_range: str
    wrong_mode: str
    watchdog: Callable[[Any], float]
    """What is written into a motor of it, of 20 ms."""
    units: float = 400
    hot: str = "winding hot"
    over_current: str = "over current"


ROBSTRIDE = Family(
    ROBSTRIDES,
    "its position range is not 12.5664",
    "it is in mode 1, and must be in 0",
    lambda motor: motor.parameters[0x7028],
)
MOTEUSES = Family(
    MOTEUS,
    "its own bounds are nan to 0.001 revolutions",
    "it is in mode 9, and must be in 0",
    lambda motor: motor.command[0x27],
    units=0.02,
    hot="over temperature",
    over_current="motor driver",
)
FAMILIES = {
    "damiao": Family(
        DAMIAOS,
        "position range is 6.25 (register 21), the map expects 12.5",
        "it is in mode 2, and must be in 1",
        lambda motor: motor.registers[9],
    ),
    "robstride": ROBSTRIDE,
    "moteus": MOTEUSES,
    "moteus_and_a_damiao": MOTEUSES._replace(text=MOTEUS_AND_A_DAMIAO),
    "beside_a_damiao": ROBSTRIDE._replace(text=ROBSTRIDES_AND_A_DAMIAO),
}


@pytest.fixture(params=FAMILIES.values(), ids=FAMILIES)
def family(request) -> Family:
    return request.param


@pytest.fixture
def rig(family: Family, tmp_path) -> Rig:
    return Rig(arm(tmp_path, family.text))


def advance(rig: Rig, span_s: float) -> None:
    rig.clock.sleep_until(rig.clock.now_s() + span_s)
    rig.bench.advance(rig.clock.now_s())


def on(rig: Rig) -> list[bool]:
    return [motor.is_on for motor in rig.bench.devices]


def test_joints_go_where_they_are_told_through_signs_offsets_and_gears(rig: Rig):
    with rig.driver:
        state = rig.cycle(1500, q=0.8, kp=40.0, kd=2.0)
    np.testing.assert_allclose(state.q, 0.8, atol=0.03)
    shafts = {name: motor.shaft.q_rad for name, motor in rig.bench.motors.items()}
    assert shafts["shoulder"] == pytest.approx(-(0.8 - 0.3), abs=0.03)
    assert shafts["elbow"] == pytest.approx(1.6, abs=0.06)
    assert rig.driver.alarms.level == Level.OK
    assert rig.driver.late == rig.driver.reception.lost == rig.driver.reception.ignored == 0


def test_replies_come_within_their_period(rig: Rig):
    with rig.driver:
        state = rig.cycle(50)
        assert (state.age_s < PERIOD_S).all()
        assert state.command_stamp_s == pytest.approx(state.stamp_s - PERIOD_S)
        assert not state.watchdog


def test_what_it_says_was_sent_is_what_the_motors_obey(rig: Rig):
    with rig.driver as driver:
        rig.cycle(200)
        sent = driver.write(rig.hold(0.6, kp=33.3, kd=1.23))
        driver.read()
        elbow, wrist = (rig.bench.motors[name]._ordered for name in ("elbow", "wrist"))
    assert elbow.kp == pytest.approx(sent.kp[1] / 4.0)
    assert elbow.q_rad == pytest.approx(2.0 * sent.q_des[1])
    assert wrist.kp == pytest.approx(sent.kp[2])
    assert wrist.q_rad == pytest.approx(sent.q_des[2])
    np.testing.assert_allclose(sent.kp, 33.3, atol=0.3)
    assert 0.5 < sent.q_des[0] < 0.525  # at most 10 rad/s from where it was before


def test_nothing_is_enabled_before_the_first_command_and_then_all_are(rig: Rig, family: Family):
    with rig.driver as driver:
        for _ in range(10):
            state = driver.read()
        assert on(rig) == [False] * 3
        assert state.watchdog
        assert (state.age_s < PERIOD_S).all()  # asked without a command
        driver.write(rig.hold())
        assert on(rig) == [True] * 3
        driver.read()
        assert family.watchdog(rig.bench.motors["wrist"]) == pytest.approx(family.units)


def test_leaving_lets_every_motor_damp_by_itself(rig: Rig):
    with rig.driver:
        rig.cycle(100)
    advance(rig, 1.0)
    assert on(rig) == [True] * 3
    for motor in rig.bench.devices:
        assert (motor._ordered.kp, motor._ordered.tau_nm) == (0.0, pytest.approx(0.0, abs=0.03))
        assert motor._ordered.kd > 0.1


def test_a_killed_controller_leaves_motors_that_let_go_and_the_next_one_takes_over(rig: Rig):
    with rig.driver:
        rig.cycle(100)
        rig.driver._is_armed = False  # it never gets to say goodbye
    advance(rig, 0.2)
    assert on(rig) == [False] * 3
    rig.driver = rig.another()
    with rig.driver:
        rig.cycle(10)
        assert rig.driver.alarms.level == Level.OK


def test_a_spare_commands_the_motors_of_a_killed_controller_before_they_let_go(rig: Rig):
    with rig.driver:
        rig.cycle(300, q=0.5)
        with rig.another() as spare:
            for _ in range(3):
                spare.read()
                rig.cycle(1, q=0.5)
            killed(rig)
            died_s = rig.clock.now_s()
            assert spare.claim()
            state = spare.read()
            assert not state.watchdog
            assert state.command_stamp_s == state.stamp_s  # it takes over: see `took_over`
            np.testing.assert_allclose(state.q, 0.5, atol=0.08)
            spare.write(rig.hold(0.5))
            assert rig.clock.now_s() - died_s <= 2 * PERIOD_S
            rig.driver, first = spare, rig.driver
            state = rig.cycle(200, q=0.5)
            assert on(rig) == [True] * 3
            assert spare.alarms.level == Level.OK
            np.testing.assert_allclose(state.q, 0.5, atol=0.08)
            rig.driver = first


@pytest.mark.parametrize(
    ("flaw", "said"),
    [
        ("silent", "does not answer"),
        ("twin", "2 motors answer as motor 3"),
        ("wrong_range", ""),
        ("wrong_mode", ""),
        ("hot", ""),
        ("low_volts", "under voltage"),
        ("over_current", ""),
    ],
)
def test_it_refuses_motors_that_are_not_as_the_map_says(tmp_path, family: Family, flaw, said: str):
    rig = Rig(arm(tmp_path, family.text), wrist=flaw)
    with pytest.raises(DriverError) as caught:
        rig.driver.__enter__()
    assert (said or getattr(family, flaw)) in str(caught.value)
    assert "wrist" in str(caught.value)
    assert "elbow" not in str(caught.value)
    assert not any(on(rig))
    assert all(
        len(wire.nodes) == sum(motor.wire is wire for motor in rig.bench.devices)
        for wire in rig.bench.wires.values()
    )  # its own adapters are closed


def test_a_motor_without_a_watchdog_is_not_enabled_and_no_other_is(tmp_path, family: Family):
    rig = Rig(arm(tmp_path, family.text), wrist="no_watchdog")
    with rig.driver as driver, pytest.raises(DriverError, match=r"watchdog.*wrist"):
        driver.write(rig.hold())
    assert not any(on(rig))


def test_a_scale_that_is_wrong_is_seen_within_160_ms_of_motion(rig: Rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.5)
        rig.bench.motors["wrist"].suffer("slow_speed")
        unseen = 0
        for k in range(100):
            rig.cycle(1, q=0.5 + 0.4 * np.sin(0.06 * k))
            unseen += not driver.alarms.on
        (alarm,) = driver.alarms.on
        assert (alarm.code, alarm.who, driver.alarms.level) == (
            "speed_mismatch", "wrist", Level.HOLD,
        )  # fmt: skip
        assert unseen * PERIOD_S < 0.16
