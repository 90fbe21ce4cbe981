"""The bus owner's memory: what a controller writes the owner reads, and the other way round."""

import numpy as np
import pytest

from robot.clock import SimulatedClock
from robot.drivers.motor_bus import MIT_MODE, MotorCommand, MotorState
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.driver import GOOD_FOR_S, SILENCE_S, OwnedMotors
from robot.drivers.motors.owned.memory import Change, OwnerMemory, Reported, Standing
from robot.errors import DriverError
from robot.messages import MotorAlarm
from robot.model import description

ROBOT = description.load("juno")
COUNT = len(ROBOT.motors)
ALARM = MotorAlarm("silent", "left_knee", "SIT", "silent for 10 periods", "check its cable")


def state(stamp_s: float) -> MotorState:
    rows = np.arange(5.0 * COUNT).reshape(5, COUNT) + stamp_s
    return MotorState(stamp_s, *rows, watchdog=False, command_stamp_s=stamp_s - 0.002)


def command(stamp_s: float) -> MotorCommand:
    return MotorCommand(stamp_s, *(np.arange(5.0 * COUNT).reshape(5, COUNT) - stamp_s))


class Rig:
    """An owner's memory, and controllers that look at it."""

    def __init__(self, folder) -> None:
        self.folder, self.clock = folder, SimulatedClock()
        self.owner = OwnerMemory(ROBOT, folder, create=True)
        self.owner.publish(state(1.0), Standing())

    def controller(self) -> OwnedMotors:
        return OwnedMotors(ROBOT, self.folder, clock=self.clock, capabilities=MIT_MODE)


@pytest.fixture
def rig(tmp_path):
    made = Rig(tmp_path)
    yield made
    made.owner.close()


def test_a_state_is_read_as_it_was_published_once(rig):
    with rig.controller() as motors:
        rig.owner.say(Reported(alarms=(ALARM,)))
        rig.owner.publish(state(2.0), Standing())
        read = motors.read()
        for field in ("q", "qd", "tau", "temperature_c", "age_s"):
            assert getattr(read, field) == pytest.approx(getattr(state(2.0), field))
        assert (read.stamp_s, read.command_stamp_s, read.alarms) == (2.0, 1.998, (ALARM,))
        again = motors.read()
        assert again.stamp_s == 2.0
        assert (again.age_s > read.age_s).all()  # it is no news


def test_a_command_arrives_with_number_and_deadline(rig):
    with rig.controller() as motors:
        motors.write(command(1.0))
        order = rig.owner.take()
        assert (order.number, order.leaves) == (1, False)
        assert order.deadline_s == pytest.approx(1.0 + GOOD_FOR_S)
        assert order.command.q_des == pytest.approx(command(1.0).q_des)
        assert rig.owner.take() is None
        motors.write(command(1.002))
        motors.write(command(1.004))
        assert rig.owner.take().number == 3  # the newest; nothing old is queued


def test_numbers_go_on_with_the_next_controller(rig):
    with rig.controller() as motors:
        motors.write(command(1.0))
    with rig.controller() as motors:
        motors.write(command(1.0))
        assert rig.owner.take().number == 3


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("field", ["q_des", "qd_des", "tau_ff", "kp", "kd"])
def test_what_is_not_finite_is_not_handed_over(rig, field, bad):
    with rig.controller() as motors:
        wrong = command(1.0)
        getattr(wrong, field)[3] = bad
        with pytest.raises(DriverError, match="not finite"):
            motors.write(wrong)
        assert rig.owner.take() is None


def test_one_controller_at_a_time_commands_and_the_next_when_it_has_gone(rig):
    with rig.controller() as second:
        with rig.controller() as first:
            assert first.claim()
            assert rig.owner.is_claimed()
            assert not second.claim()
            with pytest.raises(DriverError):
                second.write(command(1.0))
        assert not rig.owner.is_claimed()
        assert second.claim()


def test_looking_whether_somebody_commands_takes_nobodys_turn(rig):
    with rig.controller() as motors:
        assert not rig.owner.is_claimed()
        assert motors.claim()
        assert rig.owner.is_claimed()
        motors.write(command(1.0))


@pytest.mark.parametrize("level", [Level.SIT, Level.DAMP, Level.OFF])
def test_an_owner_that_acts_alone_lets_no_new_controller(rig, level):
    with rig.controller() as motors:
        rig.owner.publish(state(2.0), Standing(level))
        assert not motors.claim()
        rig.owner.publish(state(2.002), Standing())
        assert motors.claim()


def test_one_that_leaves_says_so_with_damping(rig):
    with rig.controller() as motors:
        motors.write(command(1.0))
    order = rig.owner.take()
    assert order.leaves
    assert not order.command.kp.any()
    assert (order.command.kd > 0.0).all()


def test_one_that_never_commanded_leaves_without_a_word(rig):
    with rig.controller() as motors:
        motors.read()
    assert rig.owner.take() is None


def test_an_owner_that_says_nothing_for_a_second_is_gone(rig):
    with rig.controller() as motors:
        motors.read()
        rig.clock.sleep_until(rig.clock.now_s() + SILENCE_S + 0.1)
        with pytest.raises(DriverError, match="silent"):
            motors.read()


def test_without_an_owner_it_cannot_be_opened(tmp_path):
    alone = OwnedMotors(ROBOT, tmp_path, clock=SimulatedClock(), capabilities=MIT_MODE)
    with pytest.raises(DriverError, match="nobody owns"), alone:
        pass


def test_another_robots_memory_is_refused(rig):
    other = ROBOT.driven_by("can")
    with pytest.raises(DriverError, match="another robot"):
        OwnerMemory(other, rig.folder)


def test_a_wish_for_a_reset_is_seen_once_and_answered_by_its_number(rig):
    person = OwnerMemory(ROBOT, rig.folder)
    number = person.wish_reset()
    assert (rig.owner.wish(), rig.owner.wish()) == (number, None)
    rig.owner.say(Reported(refused="it is pressed"))
    rig.owner.publish(state(2.0), Standing(Level.OFF, 0.2, number))
    assert person.standing() == Standing(Level.OFF, 0.2, number, "it is pressed")
    assert person.wish_reset() == number + 1
    person.close()


def test_more_alarms_than_there_is_room_for_leave_out_the_mildest(rig):
    many = tuple(
        MotorAlarm("silent", f"joint_{index}", "SIT", "c" * 60, "d" * 60) for index in range(60)
    )
    changes = (Change(1.0, Level.SIT, "controller_lost"),)
    rig.owner.say(Reported(alarms=many, changes=changes))
    said = OwnerMemory(ROBOT, rig.folder).said()
    assert 0 < len(said.alarms) < 60
    assert said.alarms == many[: len(said.alarms)]
    assert said.changes == changes


def test_a_torn_state_is_passed_over_and_the_last_standing_counts(rig):
    onlooker = OwnerMemory(ROBOT, rig.folder)
    rig.owner.publish(state(2.0), Standing(Level.SIT))
    assert onlooker.standing().level == Level.SIT
    onlooker._states._header[0] |= 1  # a writer that died half way
    assert onlooker.standing().level == Level.SIT
    assert onlooker.torn == 1
    onlooker.close()
