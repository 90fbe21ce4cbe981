"""The pieces that drivers of real motors are made of: periods, life, holding, news, jumps."""

import math
import os
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.clock import SimulatedClock
from robot.closing import Closing
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.alarms import Alarm, Alarms, Level, News
from robot.drivers.motors.claim import Claim
from robot.drivers.motors.holding import Holding
from robot.drivers.motors.jumps import JUMPS_BELIEVED, Jumps
from robot.drivers.motors.life import Life
from robot.drivers.motors.naps import MOST_SLEPT_S, POLL_S, SLEPT_SHARE
from robot.drivers.motors.periods import Periods
from robot.drivers.motors.plant_behind import PlantClock
from robot.drivers.motors.speed_check import SpeedCheck
from robot.errors import DriverError

# --- the time of a plant in another process -------------------------------------------------------


class SlowPlant:
    """A period of 2 ms after every `takes_s` of the wall; counts who looks."""

    def __init__(self, wall: SimulatedClock, takes_s: float) -> None:
        self.wall, self.takes_s, self.looks = wall, takes_s, 0

    @property
    def sample(self):
        self.looks += 1
        periods = math.floor(self.wall.now_s() / self.takes_s + 1e-9)
        return SimpleNamespace(motors=SimpleNamespace(stamp_s=0.002 * periods))


@pytest.mark.parametrize("takes_s", [0.0005, 0.002, 0.004, 0.05])
def test_who_waits_for_a_plant_is_there_soon_after_it_and_looks_seldom_before(takes_s):
    wall = SimulatedClock()
    plant = SlowPlant(wall, takes_s)
    clock = PlantClock(plant, wall=wall)
    for period in range(1, 50):
        looks = plant.looks
        clock.sleep_until(0.002 * period)
        assert clock.now_s() == pytest.approx(0.002 * period)
        assert wall.now_s() - period * takes_s < 1.5 * POLL_S
        if period > 1:
            slept_s = min(SLEPT_SHARE * takes_s, MOST_SLEPT_S) - 2.0 * POLL_S
            assert plant.looks - looks <= (takes_s - slept_s) / POLL_S + 4


# --- periods -------------------------------------------------------------------------------------


def test_periods_in_time_stay_on_their_grid_however_long_a_look_takes():
    clock = SimulatedClock(10.0)
    periods = Periods(clock, 0.01)
    periods.begin()
    looks = []
    for k in range(1, 200):
        clock.sleep_until(clock.now_s() + 0.0013 * (k % 3))  # what is done between two
        periods.wait(lambda: looks.append(clock.now_s()))
        assert clock.now_s() == pytest.approx(10.0 + 0.01 * k)
    assert periods.late == 0
    assert len(looks) >= 2 * 199


def test_a_period_that_is_late_by_more_than_one_is_counted_and_moves_the_grid():
    clock = SimulatedClock(0.0)
    periods = Periods(clock, 0.01)
    periods.begin()
    clock.sleep_until(0.019)  # late by less is not counted
    periods.wait(lambda: None)
    assert periods.late == 0
    assert clock.now_s() == pytest.approx(0.024)
    periods.wait(lambda: None)
    assert clock.now_s() == pytest.approx(0.034)
    clock.sleep_until(0.057)
    periods.wait(lambda: None)
    assert periods.late == 1
    assert clock.now_s() == pytest.approx(0.057 + 0.005)  # what was asked last can be answered
    periods.wait(lambda: None)
    assert clock.now_s() == pytest.approx(0.072)
    assert periods.late == 1


@given(st.lists(st.floats(0.0, 0.03), min_size=1, max_size=40))
def test_who_asks_after_the_end_of_a_period_is_given_the_time_for_an_answer(busy_s):
    """However long is worked between two periods: an answer that takes a quarter is heard."""
    clock = SimulatedClock(0.0)
    periods = Periods(clock, 0.01)
    periods.begin()
    for span_s in busy_s:
        clock.sleep_until(clock.now_s() + span_s)
        asked_s, ends_s = clock.now_s(), periods._ends_s
        periods.wait(lambda: None)
        waited_s = clock.now_s() - asked_s
        assert waited_s <= 0.01 + 1e-9
        if asked_s >= ends_s:
            assert waited_s == pytest.approx(0.005)


# --- life ----------------------------------------------------------------------------------------


class Line(Closing):
    """Says what became of it."""

    def __init__(self) -> None:
        self.story: list[str] = []

    def __enter__(self):
        self.story.append("opened")
        return self

    def close(self) -> None:
        self.story.append("closed")


def fail(*_) -> None:
    raise DriverError("it does not")


@pytest.fixture
def claim(request):
    made = Claim([f"pieces-{os.getpid()}-{request.node.name}"])
    yield made
    made.release()


def other(claim: Claim) -> Claim:
    """That of another program."""
    made = Claim([])
    made._bytes = claim._bytes
    return made


def test_motors_are_asked_unless_another_program_commands_them(claim):
    line = Line()
    life = Life(lambda: line, claim)
    assert life.open(lambda lines: lines.story.append("asked"))
    assert line.story == ["opened", "asked"]
    busy = other(claim)
    assert busy.take()
    assert not Life(Line, claim).open(fail)
    busy.release()


def test_a_motor_that_is_not_what_the_map_says_leaves_the_lines_closed(claim):
    line = Line()
    life = Life(lambda: line, claim)
    with pytest.raises(DriverError, match="it does not"):
        life.open(fail)
    assert line.story == ["opened", "closed"]
    with pytest.raises(DriverError, match="not open"):
        life.check()


def test_whatever_goes_wrong_at_the_end_the_claim_is_free_and_the_lines_are_closed(claim):
    line, left = Line(), []
    life = Life(lambda: line, claim)
    life.open(lambda _: None)
    began = []
    assert life.claim(began.append)
    assert life.claim(began.append)
    assert began == [line]
    assert not other(claim).is_free()
    with pytest.raises(DriverError, match="it does not"):
        life.close(fail, lambda: left.append("left"))
    assert (line.story, left) == (["opened", "closed"], ["left"])
    assert other(claim).is_free()
    life.close(fail, lambda: left.append("again"))  # it is closed: nothing is left to do
    assert left == ["left"]


# --- holding -------------------------------------------------------------------------------------


def command(stamp_s: float, q: float, kp: float) -> MotorCommand:
    return MotorCommand(
        stamp_s, np.full(2, q), np.ones(2), np.full(2, 3.0), np.array([kp, 0.0]), np.full(2, 0.5)
    )


def test_at_hold_the_last_targets_are_kept_and_a_limp_joint_stays_where_it_is():
    holding, q = Holding(), np.array([0.1, 0.2])
    obeyed = command(1.0, 0.7, 20.0)
    for k in range(3):
        asked = command(2.0 + k, 5.0 + k, 99.0)
        held = holding.decided(asked, Level.HOLD, obeyed=obeyed if k == 0 else asked, q=q + k)
        np.testing.assert_array_equal(held.q_des, [0.7, 0.2])
        np.testing.assert_array_equal(held.kp, [20.0, 0.0])
        assert not held.qd_des.any()
        assert held.stamp_s == asked.stamp_s
    assert holding.decided(asked, Level.SIT, obeyed=obeyed, q=q) is asked
    later = holding.decided(asked, Level.HOLD, obeyed=asked, q=q)  # a new alarm: new targets
    np.testing.assert_array_equal(later.q_des, [7.0, 0.2])


@pytest.mark.parametrize("level", [level for level in Level if level != Level.HOLD])
def test_at_every_other_level_commands_pass(level: Level):
    asked = command(2.0, 5.0, 99.0)
    assert Holding().decided(asked, level, obeyed=None, q=np.zeros(2)) is asked


def test_who_was_never_told_anything_damps_at_hold():
    held = Holding().decided(command(2.0, 5.0, 99.0), Level.HOLD, obeyed=None, q=np.zeros(2))
    assert not held.kp.any()
    assert (held.kd > 0.0).all()


# --- news ----------------------------------------------------------------------------------------


def test_an_alarm_is_told_once_again_when_it_gets_worse_and_again_when_it_comes_back():
    alarms, lines = Alarms(), list[str]()
    news = News(alarms, lines.append)
    mild = Alarm("silent", "knee", Level.HOLD, "silent for 3 periods", "look at its cable")
    alarms.sound(mild)
    for _ in range(3):
        news.say(1.0)
    assert lines == ["1.000 s, HOLD: knee: silent for 3 periods (look at its cable)"]
    alarms.sound(mild._replace(level=Level.SIT, cause="silent for 10 periods"))
    news.say(2.0)
    assert lines[1:] == ["2.000 s, SIT: knee: silent for 10 periods (look at its cable)"]
    alarms.reset()
    news.say(3.0)
    alarms.sound(mild)
    news.say(4.0)
    assert len(lines) == 3


# --- jumps ---------------------------------------------------------------------------------------


def test_a_far_position_is_believed_only_if_its_motor_insists():
    jumps = Jumps(np.array([10.0, 10.0]))
    both, since_s = np.array([0, 1]), np.full(2, 0.002)
    assert jumps.calm(both, np.array([0.01, -0.01]), since_s) is None
    for k in range(1, JUMPS_BELIEVED + 1):
        calm = jumps.calm(both, np.array([1.0, 0.0]), since_s)
        assert calm is not None
        assert calm.tolist() == [False, True]
        assert jumps.count.tolist() == [k, 0]
    calm = jumps.calm(both, np.array([1.0, 0.0]), since_s)
    assert calm is not None
    assert calm.all()
    assert jumps.count.tolist() == [0, 0]


def test_the_longer_nothing_was_heard_the_farther_a_motor_may_have_turned():
    jumps = Jumps(np.array([10.0]))
    one = np.array([0])
    assert jumps.calm(one, np.array([1.0]), np.array([0.1])) is None
    assert jumps.calm(one, np.array([1.0]), np.array([np.inf])) is None  # never heard before


def test_speeds_are_not_judged_by_what_nobody_told():
    """A joint swings while its replies stop for 60 ms, again and again: its scale is right."""
    check, q, qd, misses = SpeedCheck(1), np.zeros(1), np.zeros(1), np.zeros(1, np.intp)
    wrong = 0
    for k in range(3000):
        now_s = 0.002 * k
        if k % 50 < 20:
            q, qd = np.array([np.sin(6.0 * now_s)]), np.array([6.0 * np.cos(6.0 * now_s)])
            misses = 0 * misses
        else:
            misses = misses + 1
        check.feel(now_s, q, qd, misses)
        wrong += bool(check.wrong[0])
    assert not wrong
    assert not check.moved.any() or abs(check.ratio[0] - 1.0) < 0.1
