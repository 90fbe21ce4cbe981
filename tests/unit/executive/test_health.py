"""Health follows from the ages of messages and from what they say."""

import pytest
from msgspec.structs import replace

from executive.health import CONCERNS, START_UP_S, HealthMonitor
from executive.ladder import Level
from robot.bus.topics import TOPICS
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


def test_before_the_first_message_it_waits_then_gives_up():
    monitor = HealthMonitor(RATES, start_s=5.0)
    none = dict.fromkeys(RATES)
    soon = monitor.look(5.1, none, body=None, world=None)
    late = monitor.look(5.1 + START_UP_S, none, body=None, world=None)
    assert soon.level is Level.HOLD
    assert late.level is Level.SIT
    assert late.failure.code == "controller_lost"


def test_a_fall_is_worst_of_all(robot):
    robot.mode = "fallen"
    health = look(robot, 100.0, lidar=2.0)
    assert health.level is Level.DAMP
    assert health.failure.code == "fallen"
    assert [finding.level for finding in health.findings] == [Level.DAMP, Level.HOLD]


@pytest.mark.parametrize(("hot_c", "level"), [(79, Level.OK), (81, Level.WARN), (101, Level.SIT)])
def test_a_hot_motor_is_named(robot, hot_c, level):
    body = replace(robot.body(), temperature_c=(25.0, float(hot_c)))
    monitor = HealthMonitor({}, start_s=0.0, motors=("hip", "knee"))
    health = monitor.look(1.0, {}, body=body, world=None)
    assert health.level is level
    assert level is Level.OK or "knee" in health.failure.cause
