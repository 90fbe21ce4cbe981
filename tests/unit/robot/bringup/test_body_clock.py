import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.bringup.body_clock import BodyClock
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from tests.fakes.messages_for_tests import body_state


def make():
    bus, wall = LocalBus(), SimulatedClock(100.0)
    return bus, wall, BodyClock(bus, wall)


def test_it_stands_at_zero_before_the_first_state():
    _, wall, clock = make()
    wall.set(105.0)
    assert clock.now_s() == 0.0


def test_it_follows_a_slow_simulation():
    bus, wall, clock = make()
    for k in range(500):
        wall.set(100.0 + 0.02 * k)
        bus.publish(topics.BODY_STATE, body_state(0.01 * k))
        clock.now_s()
    assert clock.now_s() == pytest.approx(4.99, abs=0.03)


def test_it_goes_on_when_the_body_is_silent():
    bus, wall, clock = make()
    bus.publish(topics.BODY_STATE, body_state(3.0))
    assert clock.now_s() == pytest.approx(3.0)
    wall.set(102.5)
    assert clock.now_s() == pytest.approx(5.5)


@given(steps=st.lists(st.tuples(st.floats(0.0, 0.1), st.floats(0.0, 0.1)), max_size=50))
def test_it_never_goes_back(steps):
    bus, wall, clock = make()
    stamp_s, seen = 0.0, []
    for wall_s, body_s in steps:
        wall.set(wall.now_s() + wall_s)
        stamp_s += body_s
        bus.publish(topics.BODY_STATE, body_state(stamp_s))
        seen.append(clock.now_s())
    assert seen == sorted(seen)


def test_sleeping_takes_wall_time():
    bus, wall, clock = make()
    bus.publish(topics.BODY_STATE, body_state(3.0))
    clock.sleep_until(3.5)
    assert wall.now_s() == pytest.approx(100.5)
