"""The example of a driver of motors: every promise of the contract, and the row of the registry."""

from types import SimpleNamespace

import msgspec
import pytest

from examples.motor_driver_loopback import Joints, LoopbackMotors, make
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.body_devices import BodyDevices
from robot.drivers.motor_bus import MIT_MODE
from robot.drivers.registry import MOTORS
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError, DriverError
from tests.contract.test_motor_bus import (  # noqa: F401 - run here on the bench below
    COUNT,
    ROBOT,
    Device,
    test_a_closed_driver_refuses,
    test_a_command_arrives_as_it_was_sent,
    test_a_spare_that_leaves_does_not_damp_the_motors_of_another,
    test_a_wrong_shape_is_refused,
    test_leaving_damps_every_motor,
    test_one_at_a_time_commands_the_motors,
    test_states_go_on_and_belong_to_the_reader,
    test_the_state_is_the_plants,
    test_what_is_not_finite_is_refused_and_nothing_is_sent,
    test_what_it_can_do_is_known_before_it_is_opened,
)

ON_LOOPBACK = msgspec.structs.replace(ROBOT, drivers={"motors": "loopback"})


class Behind:
    """The joints as the contract looks at what is behind a driver."""

    def __init__(self, joints: Joints, clock: SimulatedClock) -> None:
        self._joints = joints
        self._judge = LoopbackMotors(joints, clock).__enter__()

    @property
    def q(self):
        return self._joints.q

    @property
    def commands(self):
        return [self._joints.command]

    def read(self):
        return SimpleNamespace(motors=self._judge.read())


@pytest.fixture
def device() -> Device:
    clock, joints = SimulatedClock(), Joints(COUNT)
    driver, spare = LoopbackMotors(joints, clock), LoopbackMotors(joints, clock)
    return Device(
        driver, spare, clock, Behind(joints, clock), lambda: clock.set(clock.now_s() + 0.002)
    )


@pytest.fixture
def row(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(MOTORS.drivers, "loopback", make)


def wiring() -> Wiring:
    return Wiring(robot=ON_LOOPBACK, clock=SimulatedClock(), bus=LocalBus())


def test_the_description_names_it(row):
    assert isinstance(MOTORS.make(wiring()), LoopbackMotors)


def test_without_its_row_it_is_refused():
    with pytest.raises(ConfigError, match="unknown driver 'loopback'"):
        MOTORS.make(wiring())


def test_a_controller_that_needs_torque_refuses_it_before_anything_opens(row):
    with pytest.raises(DriverError, match="temperature, torque"):
        BodyDevices(wiring(), needs=MIT_MODE)
