"""What a controller has of its body: opened together, read together, let go together."""

import dataclasses

import msgspec
import pytest

from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers import registry
from robot.drivers.body_devices import BodyDevices
from robot.drivers.motor_bus import MIT_MODE
from robot.drivers.simulation.plant_sensors import emulated
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.messages import PowerState
from robot.model import description
from tests.fakes.motors import FakePlant, hold


@pytest.fixture
def wiring():
    robot, plant = description.load("juno"), FakePlant()
    return Wiring(robot=robot, clock=SimulatedClock(), bus=LocalBus(), plant=plant)


def test_a_sample_is_of_one_instant_where_the_plant_is_in_this_process(wiring):
    with BodyDevices(wiring, needs=MIT_MODE) as body:
        for _ in range(3):
            wiring.plant.step(2)
            sample = body.read()
            stamps = {sample.motors.stamp_s, sample.imu.stamp_s, sample.force.stamp_s}
            assert stamps == {wiring.plant.time_ms / 1000.0}


class Mute:
    """A sensor that speaks from a time on, and then no more."""

    frame, calibration = "", None

    def __init__(self, clock, speaks_s: float) -> None:
        self._clock, self._speaks_s, self.reading = clock, speaks_s, object()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def read(self):
        if self._clock.now_s() < self._speaks_s:
            return ()
        self._speaks_s = float("inf")
        return (self.reading,)


def with_imu(monkeypatch, wiring, imu) -> Wiring:
    """The same wiring of a robot whose IMU is this one."""
    monkeypatch.setitem(registry.IMU.drivers, "mute", lambda _: imu)
    robot = msgspec.structs.replace(wiring.robot, drivers={"imu": "mute"})
    return dataclasses.replace(wiring, robot=robot)


def test_a_first_reading_is_waited_for_and_then_the_last_one_counts(monkeypatch, wiring):
    mute = Mute(wiring.clock, 3.0)
    with BodyDevices(with_imu(monkeypatch, wiring, mute), needs=MIT_MODE) as body:
        assert body.read().imu is mute.reading
        assert wiring.clock.now_s() == pytest.approx(3.0, abs=0.01)
        assert body.read().imu is mute.reading


def test_a_sensor_that_never_speaks_is_an_error(monkeypatch, wiring):
    mute = Mute(wiring.clock, 30.0)
    body = BodyDevices(with_imu(monkeypatch, wiring, mute), needs=MIT_MODE)
    with body, pytest.raises(DriverError, match="the IMU gave nothing for 10 s"):
        body.read()


def test_motors_that_cannot_do_what_is_needed_are_refused_before_anything_opens(
    monkeypatch, wiring
):
    class Servos:
        capabilities = frozenset({"position"})

    monkeypatch.setitem(registry.MOTORS.drivers, "servos", lambda _: Servos())
    robot = msgspec.structs.replace(wiring.robot, drivers={"motors": "servos"})
    with pytest.raises(DriverError, match="'juno' lack what its controller needs: gains, torque"):
        BodyDevices(
            dataclasses.replace(wiring, robot=robot),
            needs=frozenset({"position", "torque", "gains"}),
        )


def test_it_publishes_the_sensors_that_are_the_controllers(wiring):
    heard = wiring.bus.subscribe(topics.POWER)
    power = PowerState(stamp_s=1.0, charge=0.5, power_w=90.0, source="emulated")
    with BodyDevices(wiring, needs=MIT_MODE) as body:
        wiring.bus.publish(emulated(topics.POWER), power)
        body.relay()
        body.relay()
    assert heard.take() == [power]


def test_leaving_damps_the_motors(wiring):
    with BodyDevices(wiring, needs=MIT_MODE) as body:
        body.write(hold(3, 0.0))
    assert not wiring.plant.commands[-1].kp.any()
    assert (wiring.plant.commander, wiring.plant.opened) == (None, 0)
    with pytest.raises(DriverError):
        body.read()


def test_what_was_opened_is_let_go_when_the_next_is_not_there(monkeypatch, wiring):
    class Gone(Mute):
        def __enter__(self):
            raise DriverError("unplugged")

    body = BodyDevices(with_imu(monkeypatch, wiring, Gone(wiring.clock, 0.0)), needs=MIT_MODE)
    with pytest.raises(DriverError, match="unplugged"):
        body.__enter__()
    assert (wiring.plant.commander, wiring.plant.opened) == (None, 0)
