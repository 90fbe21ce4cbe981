"""What every driver of motors promises, tried on each."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from robot.clock import SimulatedClock
from robot.drivers.motors import MotorBus
from robot.drivers.shared_memory import SILENCE_S, MotorServer, SharedMotors
from robot.drivers.simulated import SimulatedMotors
from robot.errors import DriverError
from tests.fakes.motors import FakePlant, hold

COUNT = 3


@dataclass
class Device:
    """A driver, the plant behind it, and what lets a period pass between them."""

    driver: MotorBus
    plant: FakePlant
    period: Callable[[], None]


def simulated(tmp_path: Path) -> Device:
    plant = FakePlant(COUNT)
    return Device(SimulatedMotors(plant), plant, lambda: plant.step(2))


def shared(tmp_path: Path) -> Device:
    plant, clock = FakePlant(COUNT), SimulatedClock()
    server = MotorServer(tmp_path / "motors", count=COUNT, configuration=b"a" * 32)
    server.publish(plant.read())

    def period() -> None:
        if (command := server.take()) is not None:
            plant.write(command)
        plant.step(2)
        server.publish(plant.read())

    driver = SharedMotors(tmp_path / "motors", count=COUNT, configuration=b"a" * 32, clock=clock)
    return Device(driver, plant, period)


@pytest.fixture(params=[simulated, shared])
def device(request: pytest.FixtureRequest, tmp_path: Path) -> Device:
    return request.param(tmp_path)


def test_a_closed_driver_refuses(device: Device):
    with pytest.raises(DriverError):
        device.driver.read()
    with pytest.raises(DriverError):
        device.driver.write(hold(COUNT, 0.0))
    with device.driver:
        pass
    with pytest.raises(DriverError):
        device.driver.read()


def test_the_state_is_the_plants(device: Device):
    with device.driver as driver:
        device.period()
        got, want = driver.read(), device.plant.read()
    for name in ("stamp_s", "watchdog", "command_stamp_s"):
        assert getattr(got, name) == getattr(want, name)
    for name in (
        "q", "qd", "tau", "temperature_c", "gyro_rad_s", "accel_m_s2", "ankle_wrench",
        "wrist_wrench",
    ):  # fmt: skip
        np.testing.assert_array_equal(getattr(got, name), getattr(want, name))


def test_states_go_on_and_belong_to_the_reader(device: Device):
    with device.driver as driver:
        stamps = []
        for _ in range(5):
            device.period()
            state = driver.read()
            stamps.append(state.stamp_s)
            state.q[:] = 99.0
            assert not (driver.read().q == 99.0).all() or not (device.plant.q == 99.0).any()
        assert stamps == sorted(set(stamps))


def test_a_command_arrives_as_it_was_sent(device: Device):
    with device.driver as driver:
        sent = driver.write(hold(COUNT, 0.5, 0.25))
        device.period()
        assert driver.read().command_stamp_s == sent.stamp_s == 0.5
        got = device.plant.commands[-1]
    for name in ("q_des", "qd_des", "tau_ff", "kp", "kd"):
        np.testing.assert_array_equal(getattr(got, name), getattr(sent, name))


@pytest.mark.parametrize("field", ["q_des", "qd_des", "tau_ff", "kp", "kd"])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_refused_and_nothing_is_sent(device: Device, field: str, bad: float):
    with device.driver as driver:
        driver.write(hold(COUNT, 0.1))
        device.period()
        command = hold(COUNT, 0.2)
        getattr(command, field)[1] = bad
        with pytest.raises(DriverError):
            driver.write(command)
        device.period()
        assert device.plant.commands[-1].stamp_s == 0.1


def test_a_wrong_shape_is_refused(device: Device):
    with device.driver as driver, pytest.raises(DriverError):
        driver.write(hold(COUNT + 1, 0.1))


@pytest.mark.parametrize("error", [None, RuntimeError("in the loop")])
def test_leaving_damps_every_motor(device: Device, error: Exception | None):
    try:
        with device.driver as driver:
            driver.write(hold(COUNT, 0.1))
            device.period()
            if error is not None:
                raise error
    except RuntimeError as caught:
        assert caught is error
    device.period()
    last = device.plant.commands[-1]
    assert not last.kp.any()
    assert not last.qd_des.any()
    assert not last.tau_ff.any()
    assert (last.kd > 0.0).all()
    device.driver.close()


def test_a_dead_plant_is_an_error_within_a_second(tmp_path: Path):
    device = shared(tmp_path)
    clock = SimulatedClock()
    driver = SharedMotors(tmp_path / "motors", count=COUNT, configuration=b"a" * 32, clock=clock)
    with driver:
        device.period()
        driver.read()
        with pytest.raises(DriverError, match="silent"):
            while True:
                driver.read()
        assert SILENCE_S <= clock.now_s() <= 1.2 * SILENCE_S
        assert driver.repeats > 100


def test_reading_waits_at_most_a_period(tmp_path: Path):
    device = shared(tmp_path)
    clock = SimulatedClock()
    driver = SharedMotors(tmp_path / "motors", count=COUNT, configuration=b"a" * 32, clock=clock)
    with driver:
        device.period()
        state = driver.read()
        before_s = clock.now_s()
        assert driver.read().stamp_s == state.stamp_s
        assert clock.now_s() - before_s < 0.0025


@pytest.mark.parametrize(
    ("count", "configuration", "match"),
    [(COUNT, b"b" * 32, "different robots"), (COUNT + 1, b"a" * 32, "different robots")],
)
def test_another_configuration_is_refused(tmp_path: Path, count, configuration, match):
    shared(tmp_path)
    driver = SharedMotors(
        tmp_path / "motors", count=count, configuration=configuration, clock=SimulatedClock()
    )
    with pytest.raises(DriverError, match=match) as caught:
        driver.__enter__()
    if configuration == b"b" * 32:
        assert (b"a" * 8).hex() in str(caught.value)
        assert (b"b" * 8).hex() in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"junk", b"HUMOTOR9" + bytes(2000)])
def test_another_layout_is_refused(tmp_path: Path, content: bytes):
    (tmp_path / "motors").write_bytes(content)
    driver = SharedMotors(
        tmp_path / "motors", count=COUNT, configuration=b"a" * 32, clock=SimulatedClock()
    )
    with pytest.raises(DriverError):
        driver.__enter__()


def test_no_plant_is_an_error_with_the_path(tmp_path: Path):
    driver = SharedMotors(
        tmp_path / "motors", count=COUNT, configuration=b"a" * 32, clock=SimulatedClock()
    )
    with pytest.raises(DriverError, match="motors"):
        driver.__enter__()


def test_one_process_at_a_time_commands_shared_motors(tmp_path: Path):
    device = shared(tmp_path)
    clock = SimulatedClock()
    spare = SharedMotors(tmp_path / "motors", count=COUNT, configuration=b"a" * 32, clock=clock)
    with spare:
        with device.driver as first:
            first.write(hold(COUNT, 0.0))
            assert not spare.claim()
            with pytest.raises(DriverError, match="another controller"):
                spare.write(hold(COUNT, 0.0))
            device.period()
            assert spare.read().command_stamp_s == 0.0  # reading is free
        assert spare.claim()
        spare.write(hold(COUNT, 0.002))


def test_a_spare_that_leaves_does_not_damp_the_motors_of_another(tmp_path: Path):
    device = shared(tmp_path)
    clock = SimulatedClock()
    with device.driver as first:
        first.write(hold(COUNT, 0.0))
        with SharedMotors(tmp_path / "motors", count=COUNT, configuration=b"a" * 32, clock=clock):
            pass
        device.period()
    assert device.plant.commands[-1].kp.all()
