"""What every driver of motors promises, tried on each row of the registry."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

import msgspec
import numpy as np
import pytest

from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.motor_bus import Capability, MotorBus
from robot.drivers.motors.owned.memory import OwnerMemory, Standing
from robot.drivers.registry import MOTORS, commanded_motors
from robot.drivers.simulation.shared_plant import SILENCE_S, PlantServer, SharedPlant
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.model import description
from tests.fakes import dynamixel_rig, ethernet_rig, pwm_rig
from tests.fakes.can_rig import CanPlant, Rig, can_map
from tests.fakes.dynamixel_rig import ServoPlant
from tests.fakes.ethernet_rig import EthernetPlant
from tests.fakes.motors import FakePlant, hold
from tests.fakes.pwm_rig import PwmPlant

ROBOT = description.load("juno")
COUNT = len(ROBOT.motors)


@dataclass
class Device:
    """A driver of a row, another of the same device, the plant behind, a period between them.

    Frames round to steps, and carry no stamps: what a state may be off, and whether a reader knows
    the stamps of another's commands; by which of a command's fields a motor that holds is known.
    """

    driver: MotorBus
    spare: MotorBus
    clock: SimulatedClock
    plant: FakePlant | CanPlant | ServoPlant | EthernetPlant | PwmPlant
    period: Callable[[], None]
    step: float = 0.0
    stamps: bool = True
    holds: str = "kp"


def simulated_here(tmp_path: Path) -> Device:
    plant = FakePlant(COUNT)
    clock = SimulatedClock()
    wiring = Wiring(robot=ROBOT, clock=clock, bus=LocalBus(), plant=plant)
    driver, spare = (MOTORS.drivers["simulated"](wiring) for _ in range(2))
    return Device(driver, spare, clock, plant, lambda: plant.step(2))


def simulated_elsewhere(tmp_path: Path) -> Device:
    plant = FakePlant(COUNT)
    server = PlantServer(ROBOT, tmp_path)
    server.publish(plant.read())

    def period() -> None:
        if (command := server.take()) is not None:
            plant.write(command)
        plant.step(2)
        server.publish(plant.read())

    def driver(clock: SimulatedClock) -> MotorBus:
        there = SharedPlant(ROBOT, tmp_path, clock=clock)
        wiring = Wiring(robot=ROBOT, clock=clock, bus=LocalBus(), plant=there)
        return MOTORS.drivers["simulated"](wiring)

    clock = SimulatedClock()
    return Device(driver(clock), driver(clock), clock, plant, period)


def owned_elsewhere(tmp_path: Path) -> Device:
    plant = FakePlant(COUNT)
    memory = OwnerMemory(ROBOT, tmp_path, create=True)
    memory.publish(plant.read().motors, Standing())

    def period() -> None:
        if (order := memory.take()) is not None:
            plant.write(order.command)
        plant.step(2)
        memory.publish(plant.read().motors, Standing())

    clock = SimulatedClock()
    wiring = Wiring(robot=ROBOT, clock=clock, bus=LocalBus(), plant=plant, owner=tmp_path)
    driver, spare = (commanded_motors(wiring) for _ in range(2))
    return Device(driver, spare, clock, plant, period)


def on_can(tmp_path: Path) -> Device:
    rig = Rig(can_map(ROBOT))
    plant = CanPlant(rig, (rig.driver, rig.another()))
    return Device(*plant.drivers, rig.clock, plant, lambda: None, step=0.1, stamps=False)


def on_serial_ports(tmp_path: Path) -> Device:
    rig = dynamixel_rig.Rig(dynamixel_rig.servo_map(ROBOT))
    plant = ServoPlant(rig, (rig.driver, rig.another()))
    return Device(
        *plant.drivers, rig.clock, plant, plant.play, step=0.1, stamps=False, holds="tau_ff"
    )


def behind_ethernet(tmp_path: Path) -> Device:
    rig = ethernet_rig.Rig(ethernet_rig.drive_map(ROBOT))
    plant = EthernetPlant(rig, (rig.driver, rig.another()))
    return Device(*plant.drivers, rig.clock, plant, plant.play, step=0.1, stamps=False)


def on_pulses(tmp_path: Path) -> Device:
    rig = pwm_rig.Rig(pwm_rig.pulse_map(ROBOT))
    plant = PwmPlant(rig, (rig.driver, rig.another()))
    return Device(
        *plant.drivers, rig.clock, plant, plant.play, step=0.1, stamps=False, holds="q_des"
    )


BENCHES = {
    "simulated": (simulated_here, simulated_elsewhere, owned_elsewhere),
    "can": (on_can,),
    "dynamixel": (on_serial_ports,),
    "ethernet": (behind_ethernet,),
    "pwm": (on_pulses,),
}


@pytest.fixture(params=[bench for benches in BENCHES.values() for bench in benches])
def device(request: pytest.FixtureRequest, tmp_path: Path) -> Device:
    return request.param(tmp_path)


def test_every_row_is_tried():
    assert set(BENCHES) == set(MOTORS.drivers)


def test_what_it_can_do_is_known_before_it_is_opened(device: Device):
    assert device.driver.capabilities <= set(get_args(Capability))


def test_a_closed_driver_refuses(device: Device):
    driver = device.driver
    for ask in (driver.read, driver.claim, lambda: driver.write(hold(COUNT, 0.0))):
        with pytest.raises(DriverError):
            ask()
    with device.driver:
        pass
    with pytest.raises(DriverError):
        device.driver.read()


def test_the_state_is_the_plants(device: Device):
    with device.driver as driver:
        device.period()
        got, want = driver.read(), device.plant.read().motors
    for name in ("stamp_s", "watchdog", "command_stamp_s"):
        assert getattr(got, name) == getattr(want, name)
    measured = {"temperature": "temperature_c", "torque": "tau"}
    able = {name for capability, name in measured.items() if capability in driver.capabilities}
    for name in {"q", "qd", "age_s", *able}:
        np.testing.assert_allclose(getattr(got, name), getattr(want, name), 0, device.step)
    for name in {*measured.values()} - able:
        assert np.isnan(getattr(got, name)).all()


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
        np.testing.assert_allclose(getattr(got, name), getattr(sent, name), 1e-9, 1e-9)


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
    assert (np.abs(last.qd_des) <= device.step).all()
    assert (np.abs(last.tau_ff) <= device.step).all()
    assert (last.kd > 0.0).all()
    device.driver.close()


def test_one_at_a_time_commands_the_motors(device: Device):
    with device.spare as spare:
        with device.driver as first:
            first.write(hold(COUNT, 0.0))
            assert first.claim()
            assert not spare.claim()
            with pytest.raises(DriverError, match="another controller"):
                spare.write(hold(COUNT, 0.0))
            device.period()
            known_s = 0.0 if device.stamps else -np.inf
            assert spare.read().command_stamp_s == known_s  # reading is free
        assert spare.claim()
        spare.write(hold(COUNT, 0.002))


def test_a_spare_that_leaves_does_not_damp_the_motors_of_another(device: Device):
    with device.driver as first:
        first.write(hold(COUNT, 0.0, 0.3))
        with device.spare:
            pass
        device.period()
        last = device.plant.commands[-1]
        assert getattr(last, device.holds).all()


# --- over shared memory ----------------------------------------------------------------------


@pytest.fixture
def shared(tmp_path: Path) -> Device:
    return simulated_elsewhere(tmp_path)


def test_a_dead_plant_is_an_error_within_a_second(shared: Device):
    with shared.driver as driver:
        shared.period()
        driver.read()
        begun_s, ages_s = shared.clock.now_s(), [0.0]
        with pytest.raises(DriverError, match="silent"):
            while True:
                ages_s.append(driver.read().age_s.min())
        assert SILENCE_S <= shared.clock.now_s() - begun_s <= 1.2 * SILENCE_S
    assert ages_s == sorted(ages_s)
    assert ages_s[-1] == pytest.approx(SILENCE_S, rel=0.1)
    assert len(ages_s) > 100


def test_reading_waits_at_most_a_period(shared: Device):
    with shared.driver as driver:
        shared.period()
        state = driver.read()
        before_s = shared.clock.now_s()
        assert driver.read().stamp_s == state.stamp_s
        assert shared.clock.now_s() - before_s < 0.0025


def other_robots():
    *some, (name, last) = ROBOT.motors.items()
    yield msgspec.structs.replace(ROBOT, name="other")
    yield msgspec.structs.replace(ROBOT, motors={**dict(some), f"{name}_too": last, name: last})


@pytest.mark.parametrize("other", [*other_robots()], ids=["named", "motors"])
def test_another_robot_is_refused(shared: Device, tmp_path: Path, other):
    with pytest.raises(DriverError, match="different robots") as caught:
        SharedPlant(other, tmp_path, clock=SimulatedClock()).open()
    for robot in (ROBOT, other):
        assert robot.digest().hex()[:16] in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"junk", b"HUMOTOR9" + bytes(20000)])
def test_another_layout_is_refused(tmp_path: Path, content: bytes):
    (tmp_path / "motors").write_bytes(content)
    with pytest.raises(DriverError):
        SharedPlant(ROBOT, tmp_path, clock=SimulatedClock()).open()


def test_no_plant_is_an_error_with_the_path(tmp_path: Path):
    with pytest.raises(DriverError, match=str(tmp_path / "motors")):
        SharedPlant(ROBOT, tmp_path, clock=SimulatedClock()).open()


def test_a_process_without_a_plant_has_no_simulated_motors():
    wiring = Wiring(robot=ROBOT, clock=SimulatedClock(), bus=LocalBus())
    with pytest.raises(DriverError, match="simulated plant"):
        MOTORS.make(wiring)
