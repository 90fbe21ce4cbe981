"""The plant on a clock: waits for the first command, is patient, then lets the motors damp."""

import pytest
from msgspec.structs import replace

from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.bus.timing import Lateness
from robot.clock import SimulatedClock
from robot.drivers.motors.simulated import SimulatedMotors
from robot.drivers.simulation.plant_sensors import emulated
from robot.drivers.simulation.shared_plant import PlantServer, SharedPlant
from robot.reality import faults
from robot.reality.faults import FAULT
from sim import world
from sim.live import PATIENCE_S, REST, LivePlant
from sim.plant import Plant


@pytest.fixture
def parts(robot, tmp_path):
    plant = Plant(world.load("kitchen"), robot, seed=0)
    bus, clock = LocalBus(), SimulatedClock()
    with PlantServer(robot, tmp_path) as server:
        live = LivePlant(plant, server, bus, clock=clock)
        live.period()
        with SimulatedMotors(SharedPlant(robot, tmp_path, clock=clock)) as motors:
            yield plant, live, motors, bus, clock


def test_time_stands_still_until_the_first_command(parts, hold):
    plant, live, motors, _, _ = parts
    live.period()
    assert plant.time_s == 0.0
    motors.write(hold(0.0))
    live.period()
    assert plant.time_s == pytest.approx(0.002)


def test_a_dead_controller_is_waited_for_then_the_motors_damp(parts, hold):
    plant, live, motors, _, clock = parts
    motors.write(hold(0.0))
    live.period()
    begun_s = clock.now_s()
    for _ in range(12):
        live.period()
    assert plant.read().motors.watchdog
    waited_s = clock.now_s() - begun_s
    assert 9 * PATIENCE_S < waited_s < 12 * PATIENCE_S
    before_s = clock.now_s()
    for _ in range(10):
        live.period()
    assert clock.now_s() - before_s < 0.03  # no longer waited for


def test_an_answering_controller_keeps_the_wall_clock(parts, hold, monkeypatch):
    plant, live, motors, _, clock = parts
    begun_s = clock.now_s()
    sleep, answered = clock.sleep_until, []

    def answer_after_half_a_millisecond(time_s):
        sleep(time_s)
        if not answered or plant.time_s > answered[-1]:
            answered.append(plant.time_s)
            sleep(clock.now_s() + 0.0005)
            motors.write(hold(plant.time_s))

    monkeypatch.setattr(clock, "sleep_until", answer_after_half_a_millisecond)
    for _ in range(100):
        live.period()
    assert plant.time_s == pytest.approx(0.2, abs=0.003)
    assert clock.now_s() - begun_s == pytest.approx(0.2, abs=0.005)
    assert plant.read().motors.command_stamp_s >= plant.time_s - 0.003


@pytest.mark.parametrize("took_s", [0.003, 0.03])
def test_a_simulation_that_runs_late_leaves_a_share_to_others(parts, hold, monkeypatch, took_s):
    """It never sleeps otherwise, and all that is not real-time waits."""
    plant, live, motors, _, clock = parts
    sleep, slept_s = clock.sleep_until, []

    def note(time_s):
        slept_s.append(time_s - clock.now_s())
        sleep(time_s)

    def answered(period_ms, step=plant.step):
        step(period_ms)
        motors.write(hold(plant.time_s))
        sleep(clock.now_s() + took_s)

    motors.write(hold(0.0))
    monkeypatch.setattr(clock, "sleep_until", note)
    monkeypatch.setattr(plant, "step", answered)
    for _ in range(100):
        live.period()
    assert plant.time_s == pytest.approx(0.2, abs=0.005)
    assert min(slept_s[-10:]) >= REST * took_s - 1e-9


def test_a_late_answer_is_taken_and_the_next_one_waited_for(parts, hold):
    plant, live, motors, _, clock = parts
    motors.write(hold(plant.time_s))
    live.period()
    before_s = clock.now_s()
    motors.write(hold(plant.time_s - 0.002))
    live.period()
    assert plant.read().motors.command_stamp_s == pytest.approx(plant.time_s - 0.004)
    assert clock.now_s() - before_s >= PATIENCE_S


def test_faults_come_over_the_bus_and_wrong_ones_are_counted(parts):
    plant, live, _, bus, _ = parts
    bus.publish(FAULT, faults.Remove(target="red_cup"))
    bus.publish(FAULT, faults.Remove(target="nothing"))
    live.period()
    assert plant.oracle.X_WO("red_cup").p[0] > 10.0
    assert len(live.refused) == 1


def test_it_reports_its_timing(parts, hold):
    _, live, motors, bus, clock = parts
    heard = bus.subscribe(topics.PLANT_TIMING)
    motors.write(hold(0.0))
    clock.sleep_until(clock.now_s() + 2.0)
    live.period()
    assert heard.latest is not None
    assert heard.latest.process == "plant"


def test_camera_and_lidar_go_slower_while_the_controller_is_pressed_for_time(parts, hold):
    _, live, motors, bus, _ = parts
    readers = [bus.subscribe(topic) for topic in (emulated(topics.LIDAR), topics.ORACLE_FIX)]

    def counted(duration_s: float) -> list[int]:
        for reader in readers:
            reader.take()
        for _ in range(round(duration_s / 0.002)):
            motors.write(hold(0.0))
            live.period()
        return [len(reader.take()) for reader in readers]

    def press(*, pressed: bool) -> None:
        report = Lateness("controller", 0.002).report(0.0, 0.0)
        bus.publish(topics.CONTROLLER_TIMING, replace(report, pressed=pressed))

    assert counted(0.8) == pytest.approx([8, 8], abs=1)
    press(pressed=True)
    counted(0.2)
    assert counted(0.8) == pytest.approx([4, 8], abs=1)
    press(pressed=False)
    counted(0.2)
    assert counted(0.8) == pytest.approx([8, 8], abs=1)
