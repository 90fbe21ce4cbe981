"""Health follows from the ages of messages and from what they say."""

import itertools
import math
from types import SimpleNamespace
from typing import cast

import pytest
from msgspec.structs import replace

from executive.engine.estop import EmergencyStop, StillPressed
from executive.engine.health_monitor import (
    CONCERNS,
    COOL_C,
    GRADES,
    JUMP_REST_S,
    START_UP_S,
    WINDOW_TICKS,
    HealthMonitor,
    _Flow,
)
from executive.engine.sense import Sense
from executive.health import Health, Level
from robot.bus.topics import TOPICS
from robot.failures import CATALOGUE
from robot.messages import CameraState, LoopTiming, MotorAlarm, PowerState, WorldState
from robot.se3 import SE3
from tests.fakes.puppet import Puppet
from tests.fakes.worlds import puppet

RATES = {topic.name: topic.rate_hz for topic in TOPICS if topic.rate_hz}


@pytest.fixture
def robot() -> Puppet:
    return puppet()


def look(robot: Puppet, now_s: float, **ages_s: float):
    stamps = {name: now_s - ages_s.get(name.split("/")[1], 0.0) for name in RATES}
    return HealthMonitor(RATES, start_s=0.0).look(now_s, stamps, body=robot.body(), world=None)


def test_concerns_are_topics_of_the_table_with_a_rate():
    assert set(CONCERNS) <= set(RATES)


def test_fresh_messages_are_well(robot):
    assert look(robot, 100.0).level is Level.OK


@pytest.mark.parametrize(
    ("topic", "age_s", "level", "code"),
    [
        ("lidar", 0.3, Level.OK, None),
        ("lidar", 0.6, Level.HOLD, "sensor_silent"),
        ("depth", 0.6, Level.HOLD, "sensor_silent"),
        ("state", 0.6, Level.SIT, "controller_lost"),
    ],
)
def test_silence_becomes_a_finding(robot, topic, age_s, level, code):
    health = look(robot, 100.0, **{topic: age_s})
    assert health.level is level
    assert (health.failure.code if health.failure else None) == code


@pytest.mark.parametrize(
    "code", ["camera_unplugged", "camera_late", "camera_frozen", "camera_black"]
)
def test_a_camera_that_is_unwell_is_told_and_stops_nothing(robot, code):
    monitor = HealthMonitor(RATES, start_s=0.0)
    camera = CameraState(stamp_s=100.0, code=code, cause="so it is")
    fresh = dict.fromkeys(RATES, 100.0)
    health = monitor.look(100.0, fresh, body=robot.body(), world=None, camera=camera)
    assert (health.level, health.findings[0].failure.code) == (Level.WARN, code)
    well = CameraState(stamp_s=100.1)
    fresh = dict.fromkeys(RATES, 100.1)
    assert not monitor.look(100.1, fresh, body=robot.body(), world=None, camera=well).findings


def test_dead_perception_is_told_before_the_sensors_that_it_published(robot):
    fresh = dict.fromkeys(RATES, 100.0)
    silent = dict.fromkeys(("sensors/lidar", "sensors/depth", "world/state"), 99.0)
    monitor = HealthMonitor(RATES, start_s=0.0)
    health = monitor.look(100.0, {**fresh, **silent}, body=robot.body(), world=None)
    assert len(health.findings) == 3
    assert health.failure.code == "localisation_lost"


def test_before_the_first_message_it_waits_then_gives_up():
    monitor = HealthMonitor(RATES, start_s=5.0)
    none = dict.fromkeys(RATES)
    soon = monitor.look(5.1, none, body=None, world=None)
    late = monitor.look(5.1 + START_UP_S, none, body=None, world=None)
    assert soon.level is Level.HOLD
    assert soon.beginning
    assert not late.beginning
    assert late.level is Level.SIT
    assert late.failure.code == "controller_lost"


def test_a_fall_is_worst_of_all(robot):
    robot.mode = "fallen"
    health = look(robot, 100.0, lidar=2.0)
    assert health.level is Level.DAMP
    assert health.failure.code == "fallen"
    assert [finding.level for finding in health.findings] == [Level.DAMP, Level.HOLD]


@pytest.mark.parametrize(("mode", "rests"), [("stand", True), ("fallen", False), ("rising", False)])
def test_a_pose_that_jumps_matters_only_to_who_is_on_his_feet(robot, mode, rests):
    monitor = HealthMonitor({}, start_s=0.0)
    body = replace(robot.body(), mode=mode)
    world = replace(robot.world(), fix_age_s=9.0)
    monitor.look(1.0, {}, body=body, world=world)
    health = monitor.look(1.1, {}, body=body, world=replace(world, jumps=1))
    assert health.calls_for(Level.HOLD) is rests


@pytest.mark.parametrize(("hot_c", "level"), [(79, Level.OK), (81, Level.DERATE), (101, Level.SIT)])
def test_a_hot_motor_is_named(robot, hot_c, level):
    body = replace(robot.body(), temperature_c=(25.0, float(hot_c)))
    monitor = HealthMonitor({}, start_s=0.0, motors=("hip", "knee"))
    health = monitor.look(1.0, {}, body=body, world=None)
    assert health.level is level
    assert level is Level.OK or "knee" in health.failure.cause


def monitor(**more):
    return HealthMonitor({}, start_s=0.0, speed_m_s=0.5, **more)


def test_grades_are_in_order_and_their_codes_are_known():
    for scale in GRADES.values():
        assert scale.code in CATALOGUE
        levels = [grade.level for grade in scale.grades]
        assert levels == sorted(levels)
        at = [grade.at for grade in scale.grades]
        assert at == sorted(at, reverse=scale.falling)


def test_a_warm_motor_slows_the_walk_in_proportion(robot):
    speeds = []
    for hot_c in (79.0, 85.0, 90.0, 99.9):
        body = replace(robot.body(), temperature_c=(hot_c,))
        speeds.append(monitor().look(1.0, {}, body=body, world=None).speed_m_s)
    assert speeds[0] == float("inf")
    assert speeds[1:] == pytest.approx([0.425, 0.35, 0.2], abs=0.01)


def test_a_motor_that_tripped_has_to_cool_down_first(robot):
    watch = monitor(motors=("knee",))
    levels = []
    for hot_c in (101.0, 90.0, COOL_C + 1, COOL_C - 1, 79.0):
        body = replace(robot.body(), temperature_c=(hot_c,))
        levels.append(watch.look(1.0, {}, body=body, world=None).level)
    assert levels == [Level.SIT, Level.SIT, Level.SIT, Level.OK, Level.OK]


@pytest.mark.parametrize(
    ("charge", "level", "speed_m_s"),
    [
        (0.5, Level.OK, float("inf")),
        (0.2, Level.WARN, float("inf")),
        (0.09, Level.RETURN, 0.25),
        (0.05, Level.SIT, float("inf")),
    ],
)
def test_a_battery_runs_down(charge, level, speed_m_s):
    power = PowerState(stamp_s=1.0, charge=charge, power_w=100.0, source="emulated")
    health = monitor().look(1.0, {}, body=None, world=None, power=power)
    assert health.level is level
    assert health.speed_m_s == speed_m_s


def where(now_s, jumps):
    return WorldState(stamp_s=now_s, X_WN=SE3(), X_WB=SE3(), fix_age_s=0.0, tracks=(), jumps=jumps)


def test_a_pose_that_jumped_has_to_be_steady_before_it_is_walked_on():
    watch = monitor()
    levels = {}
    for n in range(100):
        now_s = n / 20
        jumps = 3 + (now_s > 1.0) + (now_s > 1.5)
        levels[now_s] = watch.look(now_s, {}, body=None, world=where(now_s, jumps)).level
    held = [now_s for now_s, level in levels.items() if level is Level.HOLD]
    assert held[0] == pytest.approx(1.05)
    assert held[-1] == pytest.approx(1.55 + JUMP_REST_S, abs=0.06)


def timing(missed_share: float, *, pressed: bool = False, **others) -> LoopTiming:
    return LoopTiming(
        stamp_s=0.0, process="controller", period_s=0.002, count=1000, late=0, p50_s=0.0,
        p99_s=0.0, p999_s=0.0, max_s=0.0, missed_share=missed_share, pressed=pressed, **others,
    )  # fmt: skip


def test_lateness_is_of_late():
    watch = monitor()
    levels = [
        watch.look(1.0, {}, body=None, world=None, timing=timing(share)).level
        for share in (0.0, 0.04, 0.06, 0.36, 0.95, 0.001)
    ]
    assert levels == [Level.OK, Level.OK, Level.WARN, Level.DERATE, Level.HOLD, Level.OK]


def test_a_controller_that_stays_late_though_all_else_makes_room_ends_in_a_hold():
    watch = monitor()

    def level(now_s: float, share: float, *, pressed: bool = True) -> Level:
        late = timing(share, pressed=pressed)
        health = watch.look(now_s, {}, body=None, world=None, timing=late)
        assert health.pressed == pressed
        return health.level

    assert level(10.0, 0.0) is Level.OK
    assert level(12.9, 0.2) is Level.WARN
    assert level(13.1, 0.2) is Level.HOLD
    assert level(13.2, 0.1) is Level.WARN  # making room has helped
    assert level(16.1, 0.2) is Level.WARN
    assert level(19.3, 0.2, pressed=False) is Level.WARN


def test_periods_that_a_simulation_waited_for_slow_its_time_and_nothing_else():
    watch = monitor()
    told = []
    for n, pace in enumerate((1.0, 0.85, 0.5, 0.9, 0.5, 0.94, 0.96, 0.85)):
        late = timing(0.0, late_share=1.0, waited_for=True, pace=pace)
        health = watch.look(10.0 + 5.0 * n, {}, body=None, world=None, timing=late)
        told.append(health.level)
        assert health.speed_m_s == math.inf
        assert health.pressed == (health.level is Level.WARN)
        if health.failure is not None:
            assert (health.failure.code, "0.5 x" in health.failure.cause) == (
                "overloaded",
                pace == 0.5,
            )
    assert told == [Level.OK] * 2 + [Level.WARN] * 4 + [Level.OK] * 2


def test_periods_that_a_simulation_did_not_wait_for_count_as_on_a_robot_of_metal():
    for share in (0.0, 0.06, 0.36, 0.95):
        there = timing(share, late_share=1.0, waited_for=True, pace=1.0)
        metal = timing(share, late_share=share)
        levels = {
            monitor().look(1.0, {}, body=None, world=None, timing=one).level
            for one in (there, metal)
        }
        assert len(levels) == 1


def test_a_robot_of_metal_is_never_said_to_be_a_slow_simulation():
    slow = timing(0.0, pace=0.5)
    assert monitor().look(1.0, {}, body=None, world=None, timing=slow).level is Level.OK


def test_a_topic_that_thins_out_slows_the_robot_down():
    watch = HealthMonitor({"sensors/lidar": 10.0}, start_s=0.0, speed_m_s=0.5)
    levels = []
    stamp_s = 0.0
    for n in range(8 * WINDOW_TICKS):
        now_s = n / 20
        period_s = 0.1 if now_s < 6.0 else 0.3
        if now_s - stamp_s >= period_s - 1e-9:
            stamp_s = now_s
        levels.append(watch.look(now_s, {"sensors/lidar": stamp_s}, body=None, world=None).level)
    assert set(levels[:110]) == {Level.OK}
    assert set(levels[200:]) == {Level.DERATE}


def test_an_emergency_stop_is_latched_until_released_and_reset():
    estop = EmergencyStop()
    watch = monitor(estop=estop)

    def level():
        return watch.look(1.0, {}, body=None, world=None).level

    assert level() is Level.OK
    estop.press("a person shouted")
    assert level() is Level.SIT
    with pytest.raises(StillPressed):
        estop.reset()
    estop.release()
    assert level() is Level.SIT
    estop.reset()
    assert level() is Level.OK


def test_a_rate_that_wavers_is_told_once():
    """Thin below 0.6 of what is promised, well again from 0.8 on: one finding, not a hail."""
    flow = _Flow(10.0)
    shares = [1.0] * 100 + [0.55, 0.65] * 100 + [1.0] * 100
    thin: list[bool] = []
    came = 0.0
    stamp_s = 0.0
    for tick, share in enumerate(shares):
        came += 0.5 * share  # two ticks a message, if all come
        if came >= 1.0:
            came -= 1.0
            stamp_s = 0.05 * tick
        thin.append(flow.judge("world/state", 0.05 * tick, stamp_s) is not None)
    changes = sum(a != b for a, b in itertools.pairwise(thin))
    assert any(thin)
    assert not thin[-1]
    assert changes == 2


def test_a_topic_that_begins_late_is_not_thin():
    """A robot that finds itself by its lidar says where it is from 0.8 s on, then as promised."""
    flow = _Flow(10.0)
    begun = 16
    for tick in range(200):
        stamp_s = 0.1 * (tick // 2) if tick >= begun else None
        assert flow.judge("world/state", 0.05 * tick, stamp_s) is None


def test_that_a_run_waits_for_its_first_messages_is_marked_and_where_they_do_not_come_is_not():
    told = []
    monitor = HealthMonitor({"world/state": 10.0}, start_s=0.0)
    sense = SimpleNamespace(
        _health=Health(),
        _told_c={},
        _stage=SimpleNamespace(record=lambda _kind, **data: told.append(data)),
    )
    for now_s, stamp_s in ((0.1, None), (START_UP_S + 0.1, None), (START_UP_S + 0.2, 10.3)):
        stamps = {"world/state": stamp_s}
        Sense._journal(cast(Sense, sense), monitor.look(now_s, stamps, body=None, world=None))
    assert [(one["level"], one.get("beginning", False)) for one in told] == [
        ("HOLD", True),
        ("HOLD", False),
        ("OK", False),
    ]
    assert told[0]["cause"] == "the robot is finding its place"
    assert told[1]["cause"] == "the world model is silent for 10.1 s"


def test_how_hot_a_motor_is_by_now_is_journalled(robot):
    """A page of a run shows what was true by then, not when it came up."""
    told = []
    watch, heat = monitor(), (79.0, 80.0, 81.0, 84.9, 85.0, 86.0, 91.0, 87.0, 85.9, 60.0)
    sense = SimpleNamespace(
        _health=Health(),
        _told_c={},
        _stage=SimpleNamespace(record=lambda _kind, **data: told.append(data)),
    )
    for hot_c in heat:
        body = replace(robot.body(), temperature_c=(hot_c,))
        Sense._journal(cast(Sense, sense), watch.look(1.0, {}, body=body, world=None))
    said = [
        data["evidence"]["temperature_c"] if "evidence" in data else data["level"] for data in told
    ]
    assert said == [80.0, 85.0, 91.0, 85.9, "OK"]


@pytest.mark.parametrize("level", ["WARN", "DERATE", "HOLD", "SIT"])
def test_an_alarm_of_a_motor_is_told_at_its_level_with_joint_cause_and_cure(robot, level):
    alarm = MotorAlarm("silent", "left_knee", level, "silent for 3 periods", "check its cable")
    body = replace(robot.body(), alarms=(alarm,))
    stamps = dict.fromkeys(RATES, 100.0)
    health = HealthMonitor(RATES, start_s=0.0, speed_m_s=1.0).look(
        100.0, stamps, body=body, world=None
    )
    (finding,) = health.findings
    assert (finding.name, finding.level) == ("motor left_knee", Level[level])
    assert finding.failure.code == "motor_fault"
    assert finding.failure.cause == "left_knee: silent for 3 periods"
    assert finding.failure.suggestion == "check its cable"
    assert (health.speed_m_s < 1.0) == (level == "DERATE")


def test_an_imu_that_broke_is_told_as_such_and_ends_the_task(robot):
    alarm = MotorAlarm("imu_frozen", "IMU", "SIT", "it tells the same for 52 ms", "look at it")
    body = replace(robot.body(), alarms=(alarm,))
    stamps = dict.fromkeys(RATES, 100.0)
    health = HealthMonitor(RATES, start_s=0.0, speed_m_s=1.0).look(
        100.0, stamps, body=body, world=None
    )
    (finding,) = health.findings
    assert (finding.name, finding.level, finding.failure.code) == ("IMU", Level.SIT, "imu_fault")


def test_a_robot_that_is_lost_stands_and_says_why():
    watch = HealthMonitor({}, start_s=0.0)
    lost = replace(where(1.0, 0), lost="I am lost: it is dark")
    health = watch.look(1.0, {}, body=None, world=lost)
    assert health.level is Level.HOLD
    assert health.failure.code == "localisation_lost"
    assert health.failure.cause == "I am lost: it is dark"
    assert watch.look(1.1, {}, body=None, world=where(1.1, 0)).level is Level.OK
