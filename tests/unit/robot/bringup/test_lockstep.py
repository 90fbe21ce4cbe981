"""The order of events in `fast`, and that nothing is lost when the plant is."""

import pytest

from robot.bringup.lockstep import TAKE_OVER_MS, Lockstep
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.closing import Closing
from robot.drivers.body_devices import BodyDevices
from robot.drivers.motor_bus import MIT_MODE
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError
from robot.messages import PoseFix, Stand
from robot.model import description
from robot.reality.faults import Kill, Remove
from robot.se3 import SE3
from tests.fakes.messages_for_tests import body_state
from tests.fakes.motors import FakePlant, hold


class Controller:
    def __init__(self):
        self.handled, self.ticks = [], []

    def handle(self, command):
        self.handled.append((len(self.ticks), command))

    def tick(self, sample):
        self.ticks.append(sample.motors.stamp_s)
        return hold(3, sample.motors.stamp_s)

    def state(self):
        return body_state(self.ticks[-1])


class Perception(Closing):
    def __init__(self, plant):
        self.steps_ms, self._plant = [], plant

    def step(self):
        self.steps_ms.append(self._plant.time_ms)

    def close(self):
        pass


def lockstep(plant, control, perception, bus):
    clock = SimulatedClock()
    wiring = Wiring(robot=description.load("juno"), clock=clock, bus=bus, plant=plant)
    body = BodyDevices(wiring, needs=MIT_MODE)
    return Lockstep(plant, control, perception, body=body, bus=bus, clock=clock)


@pytest.fixture
def parts():
    plant, controller, bus = FakePlant(), Controller(), LocalBus()
    perception = Perception(plant)
    with lockstep(plant, lambda: controller, perception, bus) as runtime:
        yield runtime, plant, controller, perception, bus


def test_time_goes_on_by_what_was_asked(parts):
    runtime, plant, controller, _, _ = parts
    for k in range(1, 11):
        runtime.advance(0.05)
        assert runtime.clock.now_s() == pytest.approx(0.05 * k)
    assert plant.time_ms == 500
    assert controller.ticks == pytest.approx([0.002 * k for k in range(250)])


def test_every_state_is_answered_before_physics_goes_on(parts):
    runtime, plant, _, _, _ = parts
    runtime.advance(0.1)
    calls = [call for call in plant.calls if call != "sense"]
    assert calls == ["write", "step 2"] * 50
    assert [command.stamp_s for command in plant.commands] == pytest.approx(
        [0.002 * k for k in range(50)]
    )


def test_body_states_come_at_their_promised_rate(parts):
    runtime, _, _, _, bus = parts
    states = bus.subscribe(topics.BODY_STATE)
    runtime.advance(1.0)
    stamps = [state.stamp_s for state in states.take()]
    assert stamps == pytest.approx([0.02 * k for k in range(50)])
    assert runtime.link.body().stamp_s == pytest.approx(0.98)


def test_a_command_acts_in_the_next_period(parts):
    runtime, _, controller, _, _ = parts
    runtime.advance(0.05)
    command = Stand(stamp_s=0.05, id=runtime.link.next_id())
    runtime.link.send(command)
    assert controller.handled == []
    runtime.advance(0.002)
    assert controller.handled == [(25, command)]


def test_perception_runs_when_sensors_spoke(parts):
    runtime, plant, _, perception, bus = parts
    fixes = bus.subscribe(topics.ORACLE_FIX)
    runtime.advance(0.05)
    assert perception.steps_ms == []
    plant.due = [(topics.ORACLE_FIX, PoseFix(stamp_s=0.06, X_WB=SE3(), source="oracle"))]
    runtime.advance(0.05)
    assert perception.steps_ms == [60]
    assert len(fixes.take()) == 1


def test_a_lost_plant_is_a_failure_and_time_goes_on():
    plant, bus = FakePlant(diverge_at_s=0.03), LocalBus()
    with lockstep(plant, Controller, Perception(plant), bus) as runtime:
        runtime.advance(0.02)
        assert runtime.failure() is None
        runtime.advance(0.05)
        assert runtime.failure().code == "plant_lost"
        assert "diverged" in runtime.failure().cause
        written = len(plant.commands)
        runtime.advance(0.05)
        assert runtime.clock.now_s() == pytest.approx(0.12)
        assert len(plant.commands) == written


def kill(runtime):
    runtime.inject(Kill(process="controller"))


def test_a_killed_controller_is_followed_by_another_a_little_later():
    plant, bus, made = FakePlant(), LocalBus(), []

    def control():
        made.append(Controller())
        return made[-1]

    with lockstep(plant, control, Perception(plant), bus) as runtime:
        runtime.advance(0.1)
        kill(runtime)
        runtime.advance(0.1)
        assert len(made) == 2
        assert made[0].ticks[-1] == pytest.approx(0.098)
        assert made[1].ticks[0] == pytest.approx(0.1 + TAKE_OVER_MS / 1000.0)
        assert runtime.failure() is None
        assert runtime.restarted == ["the controller was killed; started again"]


def test_the_third_death_of_a_controller_within_a_minute_is_the_last(parts):
    runtime, plant, _, _, _ = parts
    for k in range(3):
        assert runtime.failure() is None
        kill(runtime)
        runtime.advance(1.0)
        assert len(runtime.restarted) == min(k + 1, 2)
    assert runtime.failure().code == "controller_lost"
    written = len(plant.commands)
    runtime.advance(1.0)
    assert len(plant.commands) == written


def test_leaving_damps(parts):
    runtime, plant, _, _, _ = parts
    runtime.advance(0.01)
    runtime.close()
    assert not plant.commands[-1].kp.any()


def test_a_fault_is_the_plants_to_suffer_but_a_killed_process_is_not(parts):
    runtime, plant, _, _, _ = parts
    runtime.inject(Remove(target="red_cup"))
    assert plant.suffered == [Remove(target="red_cup")]
    with pytest.raises(ConfigError, match="no process of its own"):
        runtime.inject(Kill(process="perception"))
    assert len(plant.suffered) == 1
