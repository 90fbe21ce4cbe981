"""The owner at work, with motors that are only told of: waits, words, and a person's wish."""

import numpy as np
import pytest

from robot.clock import SimulatedClock
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MIT_MODE, MotorCommand, MotorState
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.driver import OwnedMotors
from robot.drivers.motors.owned.memory import Order, OwnerMemory
from robot.errors import DriverError
from robot.owner.owner import BusOwner
from robot.owner.reactions import AT_MOST_S, HOLDS_S
from robot.owner.serving import GIVES_AFTER_S, WAITS_S, WAITS_SIMULATED_S, Serving
from robot.physics import GRAVITY_M_S2

PERIOD_S = 0.002


class Motors:
    """Motors that do nothing, and keep what they are told."""

    def __init__(self) -> None:
        self.told: list[MotorCommand] = []
        self.resets = 0

    def write(self, command: MotorCommand) -> MotorCommand:
        self.told.append(command)
        return command

    def reset(self) -> None:
        self.resets += 1


class Body:
    """A robot that stands, with such motors; every look is a period later."""

    def __init__(self, body, squat) -> None:
        self.body, self.motors, self.now_s = body, Motors(), 0.0
        self.q = np.array(body.description.posture("nominal"))
        self.q[squat.legs] = squat.q_rad[8]
        self.stands_still = False

    def read(self) -> BodySample:
        self.now_s += 0.0 if self.stands_still else PERIOD_S
        zero = np.zeros(self.body.count)
        state = MotorState(
            self.now_s, self.q, zero, zero, zero, zero, watchdog=False, command_stamp_s=0.0
        )
        ankles = np.zeros((2, 6))
        ankles[:, 2] = 0.5 * GRAVITY_M_S2 * self.body.mass_kg
        up = ImuReading(self.now_s, np.zeros(3), np.array((0.0, 0.0, GRAVITY_M_S2)))
        return BodySample(state, up, ForceReading(self.now_s, ankles, np.zeros((2, 6))))


class Clock(SimulatedClock):
    """Of a wall on which something happens while the owner waits."""

    def __init__(self) -> None:
        super().__init__()
        self.happens = lambda: None

    def sleep_until(self, time_s: float) -> None:
        super().sleep_until(time_s)
        self.happens()


class Rig:
    """An owner at work, and a controller's side of its memory."""

    def __init__(self, body, squat, folder, *, is_simulated: bool) -> None:
        self.body, self.clock, self.lines = Body(body, squat), Clock(), list[str]()
        self.memory = OwnerMemory(body.description, folder, create=True)
        self.controller = OwnerMemory(body.description, folder)
        self.is_pressed = False
        self.owner = BusOwner(body, squat)
        self.serving = Serving(
            self.owner, self.body, self.memory, clock=self.clock, tell=self.lines.append,
            is_simulated=is_simulated, is_pressed=lambda: self.is_pressed,
        )  # fmt: skip
        self.number = 0

    def order(self, *, answers_s: float, tau_nm: float = 1.0) -> None:
        self.number += 1
        zero = np.zeros(self.body.body.count)
        kp, kd = self.body.body.kp, self.body.body.kd
        command = MotorCommand(answers_s, self.body.q, zero, zero + tau_nm, kp, kd)
        self.controller.order(Order(self.number, answers_s + 2 * PERIOD_S, False, command))

    def answer(self) -> None:
        """As a controller does: when a state is there, a command for it."""
        if (state := self.controller.news()) is not None:
            self.order(answers_s=state.stamp_s)

    def work(self, periods: int) -> None:
        for _ in range(periods):
            self.serving.period()

    def begin(self) -> None:
        """A controller has claimed the motors, and commands."""
        assert self.controller.lock()
        self.order(answers_s=self.body.now_s + PERIOD_S)
        self.clock.happens = self.answer
        self.work(10)

    def fall_silent(self) -> None:
        """As when its process dies: the system takes the claim away."""
        self.clock.happens = lambda: None
        self.controller.unlock()


@pytest.fixture(params=[True, False], ids=["simulated", "real"])
def rig(request, body, squat, tmp_path):
    made = Rig(body, squat, tmp_path, is_simulated=request.param)
    yield made
    made.controller.close()
    made.memory.close()


def test_a_command_goes_out_in_the_period_that_it_answers(rig):
    rig.begin()
    rig.work(20)
    assert rig.owner.state.level == Level.OK
    assert rig.body.motors.told[-1].stamp_s == rig.body.now_s
    assert rig.serving.holds == 0


def test_a_late_answer_to_an_older_state_is_waited_past(rig):
    """Else a controller that was late once would stay a period behind for ever."""
    rig.begin()
    rig.clock.happens = lambda: None
    rig.order(answers_s=rig.body.now_s)  # of the period before, as the next one begins
    rig.clock.happens = rig.answer
    rig.work(1)
    assert rig.body.motors.told[-1].stamp_s == rig.body.now_s


def test_a_controller_that_lives_is_waited_for_and_no_longer_than_a_period_allows(rig):
    rig.begin()
    rig.clock.happens = lambda: None
    begun_s = rig.clock.now_s()
    rig.work(1)
    waited_s = rig.clock.now_s() - begun_s
    wanted_s = WAITS_SIMULATED_S if rig.serving._is_simulated else WAITS_S
    assert waited_s == pytest.approx(wanted_s, abs=2e-4)
    assert rig.owner.state.level == Level.HOLD


def test_one_that_died_is_not_waited_for_but_in_a_simulation_and_nobody_after_the_hold(rig):
    rig.begin()
    rig.fall_silent()
    begun_s = rig.clock.now_s()
    rig.work(4)
    waited_s = rig.clock.now_s() - begun_s
    wanted_s = 4 * WAITS_SIMULATED_S if rig.serving._is_simulated else 0.0
    assert waited_s == pytest.approx(wanted_s, abs=1e-3)
    assert rig.owner.state.level == Level.SIT
    begun_s = rig.clock.now_s()
    rig.work(20)
    assert rig.clock.now_s() == begun_s


def test_before_anybody_commands_nobody_is_waited_for_and_nothing_is_sent(rig):
    begun_s = rig.clock.now_s()
    rig.work(50)
    assert rig.clock.now_s() == begun_s
    assert rig.body.motors.told == []


def test_where_time_stands_still_until_the_first_command_that_one_is_carried_out(rig):
    rig.work(1)
    rig.body.stands_still = True
    for _ in range(3):
        rig.controller.news()
        rig.work(1)
        assert rig.controller.news() is not None  # it says that it is there
    assert rig.controller.lock()
    rig.order(answers_s=rig.body.now_s)
    rig.work(1)
    assert len(rig.body.motors.told) == 1
    rig.work(3)
    assert len(rig.body.motors.told) == 1  # once a period


def test_what_is_done_alone_is_told_with_its_hold_and_seen_by_controllers(rig):
    rig.begin()
    rig.fall_silent()
    rig.work(6)
    said = rig.controller.said()
    assert [(one.level, one.code) for one in said.changes] == [
        (Level.HOLD, "late"), (Level.SIT, "controller_lost"),
    ]  # fmt: skip
    assert said.changes[1].stamp_s - said.changes[0].stamp_s == pytest.approx(0.006)
    assert [line.split(": ")[1] for line in rig.lines] == ["late", "controller_lost"]
    (alarm,) = rig.controller.news().alarms
    assert (alarm.who, alarm.level, alarm.code) == ("bus owner", "SIT", "controller_lost")
    assert rig.controller.standing().level == Level.SIT


def test_a_hold_that_a_command_ends_is_counted_and_not_told(rig):
    rig.begin()
    rig.clock.happens = lambda: None
    rig.work(2)
    rig.order(answers_s=rig.body.now_s + PERIOD_S)
    rig.work(1)
    assert rig.owner.state.level == Level.OK
    assert (rig.serving.holds, rig.lines) == (1, [])


def test_only_a_sit_under_way_keeps_it_from_ending(rig):
    assert not rig.serving.is_lowering
    rig.begin()
    assert not rig.serving.is_lowering
    rig.fall_silent()
    rig.work(4)
    assert rig.serving.is_lowering
    rig.work(2000)
    assert rig.owner.state.level == Level.DAMP
    assert not rig.serving.is_lowering


def test_a_wish_on_the_way_down_is_refused_with_its_cause_and_one_at_the_end_is_taken(rig):
    rig.begin()
    rig.fall_silent()
    rig.work(10)
    wish = rig.controller.wish_reset()
    rig.work(1)
    standing = rig.controller.standing()
    assert standing.answered == wish
    assert "still give torque" in standing.refused
    rig.work(3000)
    assert rig.owner.state.level == Level.OFF
    wish = rig.controller.wish_reset()
    rig.work(1)
    standing = rig.controller.standing()
    assert (standing.answered, standing.refused, standing.level) == (wish, "", Level.OK)
    assert rig.body.motors.resets == 1
    told = len(rig.body.motors.told)
    rig.work(10)
    assert len(rig.body.motors.told) == told  # nothing, until a controller commands
    rig.begin()
    assert rig.owner.state.level == Level.OK
    assert len(rig.body.motors.told) > told


def test_a_wish_made_right_after_the_stop_was_released_is_taken(rig):
    rig.begin()
    rig.is_pressed = True
    rig.work(10)
    rig.is_pressed = False
    rig.controller.wish_reset()
    rig.work(1)
    assert rig.controller.standing().level == Level.OK


def test_pressed_there_is_no_torque_in_the_next_period_and_no_reset(rig):
    rig.begin()
    rig.is_pressed = True
    rig.work(1)
    last = rig.body.motors.told[-1]
    assert not any((last.kp.any(), last.kd.any(), last.tau_ff.any()))
    rig.controller.wish_reset()
    rig.work(1)
    assert "pressed" in rig.controller.standing().refused
    rig.is_pressed = False
    rig.work(10)
    assert rig.owner.state.level == Level.OFF
    rig.controller.wish_reset()
    rig.work(1)
    assert rig.controller.standing().level == Level.OK


# --- a spare that follows -------------------------------------------------------------------------


class Spare:
    """A controller that waits for its turn, and begins with a command some periods later."""

    def __init__(self, rig: Rig, folder, *, thinks: int = 1) -> None:
        self.rig, self.thinks, self.commands = rig, thinks, 0
        robot = rig.body.body.description
        self.motors = OwnedMotors(robot, folder, clock=SimulatedClock(), capabilities=MIT_MODE)

    def act(self) -> None:
        """What it does in one period."""
        if not self.motors.claim():
            return
        self.thinks -= 1
        if self.thinks < 0:
            state, body = self.motors.read(), self.rig.body.body
            zero = np.zeros(body.count)
            self.motors.write(
                MotorCommand(state.stamp_s, self.rig.body.q, zero, zero + 3.0, body.kp, body.kd)
            )
            self.commands += 1


@pytest.fixture
def spare(rig, tmp_path):
    rig.work(1)
    made = Spare(rig, tmp_path)
    with made.motors:
        yield made


def play(rig: Rig, spare: Spare, periods: int) -> list[Level]:
    """Periods in which the spare does what it does once each; the levels after them."""
    levels: list[Level] = []
    for _ in range(periods):
        spare.act()
        rig.work(1)
        levels.append(rig.owner.state.level)
    return levels


@pytest.mark.parametrize("thinks", range(5))
def test_a_spare_that_follows_goes_on_for_one_that_died_however_long_its_first_tick_takes(
    rig, spare, thinks
):
    rig.begin()
    spare.thinks = thinks
    play(rig, spare, 5)
    rig.fall_silent()
    levels = play(rig, spare, 40)
    assert max(levels) <= Level.HOLD
    assert levels.count(Level.HOLD) <= thinks + 1
    assert levels[-1] == Level.OK
    assert rig.body.motors.told[-1].tau_ff[0] == 3.0


def test_a_spare_gets_the_turn_of_one_that_still_has_its_lock_as_while_it_is_taken_apart(
    rig, spare
):
    rig.begin()
    play(rig, spare, 5)
    rig.clock.happens = lambda: None  # nothing more of it; the lock stays its own
    levels = play(rig, spare, 40)
    assert max(levels) == Level.HOLD
    held_s = levels.count(Level.HOLD) * PERIOD_S
    assert GIVES_AFTER_S < held_s < AT_MOST_S
    assert levels[-1] == Level.OK


def test_what_one_says_that_lost_its_turn_is_not_carried_out(rig, spare):
    rig.begin()
    play(rig, spare, 5)
    rig.clock.happens = lambda: None
    play(rig, spare, 20)
    rig.body.motors.told.clear()
    rig.clock.happens = rig.answer  # it goes on, as after SIGCONT
    for _ in range(30):
        spare.act()
        rig.work(1)
    assert all(one.tau_ff[0] == 3.0 for one in rig.body.motors.told)


def test_a_controller_that_is_late_for_less_keeps_its_turn(rig, spare):
    rig.begin()
    play(rig, spare, 5)
    rig.clock.happens = lambda: None
    play(rig, spare, round(GIVES_AFTER_S / PERIOD_S))
    rig.clock.happens = rig.answer
    assert play(rig, spare, 20)[-1] == Level.OK
    assert spare.commands == 0


def test_a_spare_that_does_not_run_is_given_nothing(rig, spare):
    rig.begin()
    play(rig, spare, 5)
    rig.work(10)  # it has seen no state meanwhile
    rig.fall_silent()
    rig.work(round(HOLDS_S / PERIOD_S) + 2)
    assert rig.owner.state.code == "controller_lost"


def test_a_spare_that_was_given_the_turn_and_says_nothing_is_not_waited_for_longer(rig, spare):
    rig.begin()
    spare.thinks = 1000
    play(rig, spare, 5)
    rig.fall_silent()
    play(rig, spare, round(AT_MOST_S / PERIOD_S) + 2)
    assert rig.owner.state.code == "controller_silent"


def test_the_second_spare_goes_on_for_the_first(rig, spare, tmp_path):
    second = Spare(rig, tmp_path)
    with second.motors:
        rig.begin()
        play(rig, spare, 5)
        rig.fall_silent()
        for _ in range(20):
            spare.act()
            rig.work(1)
        levels = play(rig, second, 30)  # the first one is heard no more
        assert max(levels) == Level.HOLD
        assert levels[-1] == Level.OK
        assert second.commands > 10
        assert not spare.motors.claim()
        with pytest.raises(DriverError, match="another controller"):
            spare.motors.write(rig.body.motors.told[-1])


def test_after_a_persons_reset_the_lock_says_whose_turn_it_is(rig, spare):
    rig.begin()
    play(rig, spare, 5)
    rig.fall_silent()
    play(rig, spare, 20)
    rig.is_pressed = True
    rig.work(3)
    assert rig.owner.state.level == Level.OFF
    rig.is_pressed = False
    rig.controller.wish_reset()
    rig.work(2)
    assert rig.owner.state.level == Level.OK
    assert rig.controller.standing().turn == 0
    before = spare.commands
    play(rig, spare, 5)
    assert spare.commands > before  # it has the lock
