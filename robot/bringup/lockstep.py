"""Plant, controller and perception in one thread under a simulated clock, in a fixed order."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from typing import Protocol, Self

from robot.bringup.processes import CONTROLLER
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.closing import Closing
from robot.drivers.body_devices import BodyDevices
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.errors import ConfigError, DriverError
from robot.failures import Failure, failure
from robot.link import BusLink
from robot.messages import BodyCommand, BodyState
from robot.reality.contract import Plant
from robot.reality.faults import Fault, Kill

CONTROL_PERIOD_MS = 2
STATE_PERIOD_MS = 20
TAKE_OVER_MS = 10
"""How long nobody commands the motors when the controller is killed, as in `live`."""


class Controller(Protocol):
    """The body's controller: see `robot.control.loop.ControlLoop`."""

    def handle(self, command: BodyCommand) -> None:
        """Take one command."""
        ...

    def tick(self, sample: BodySample) -> MotorCommand:
        """One period of the motor bus."""
        ...

    def state(self) -> BodyState:
        """What it believes."""
        ...


class Perception(AbstractContextManager[object], Protocol):
    """Opens its sensors, reads them and the bus, and publishes the world state."""

    def step(self) -> None:
        """Work off what came."""
        ...


class Lockstep(Closing):
    """The `fast` order of events; the same parts and calls give the same run, bit for bit.

    Every 2 ms: commands, read, controller, write, physics. Every 20 ms, before the physics: body
    state, then what the sensors have due, then perception if they had anything.

    Attributes:
        plant: the plant; tests, benchmarks and the judge reach it, the product does not.
        clock: the simulated clock.
        link: the executive's handle on the body.
        restarted: what was started again, in order, a sentence each.
    """

    def __init__(
        self,
        plant: Plant,
        control: Callable[[], Controller],
        perception: Perception,
        *,
        body: BodyDevices,
        bus: LocalBus,
        clock: SimulatedClock,
    ) -> None:
        """Put the parts together; `control` makes a controller, and another when one was killed.

        `body` is what the controller has of the plant; `clock` is moved on from here.
        """
        self.restarted: list[str] = []
        self.plant = plant
        self.clock = clock
        self.link = BusLink(bus, self.clock)
        self._bus = bus
        self._control = control
        self._controller: Controller | None = control()
        self._perception = perception
        self._commands = bus.subscribe(topics.BODY_COMMAND)
        self._spoken = bus.subscribe(topics.SPOKEN)
        self._body = body
        self._opened = ExitStack()
        self._time_ms = 0
        self._failure: Failure | None = None
        self._lost = False
        self._starts_s = [0.0]
        self._back_ms = math.inf

    def __enter__(self) -> Self:
        """Open motors and sensors."""
        with ExitStack() as stack:
            stack.enter_context(self._perception)
            stack.enter_context(self._body)
            self._opened = stack.pop_all()
        return self

    def close(self) -> None:
        """Damp the motors and close the bus."""
        self._opened.close()
        self._bus.close()

    def failure(self) -> Failure | None:
        """Why the run cannot go on, None while it can."""
        return self._failure

    def advance(self, duration_s: float) -> None:
        """Let `duration_s` pass, to the nearest control period.

        When the plant is lost, `failure` says so and only the clock goes on.
        """
        periods = round(duration_s * 1000.0 / CONTROL_PERIOD_MS)
        end_ms = self._time_ms + periods * CONTROL_PERIOD_MS
        if not self._lost:
            try:
                self._run_until(end_ms)
            except DriverError as error:
                self._lost = True
                self._failure = failure("plant_lost", str(error), time_s=self._time_ms / 1000.0)
        self._time_ms = end_ms
        self.clock.set(end_ms / 1000.0)

    def inject(self, fault: Fault) -> None:
        """Make a fault happen now. Raises ConfigError if it names what is not there."""
        match fault:
            case Kill(process="controller"):
                self._kill_controller()
            case Kill():
                raise ConfigError(f"the {fault.process} is no process of its own in a fast run")
            case _:
                self.plant.suffer(fault)

    def _kill_controller(self) -> None:
        """Another one takes over, unless that happened too often."""
        self._controller, self._back_ms = None, math.inf
        now_s = self._time_ms / 1000.0
        if CONTROLLER.may_start_again(self._starts_s, now_s):
            self._starts_s.append(now_s)
            self._back_ms = self._time_ms + TAKE_OVER_MS
            self.restarted.append("the controller was killed; started again")
        else:
            self._failure = failure("controller_lost", "the controller was killed")

    def _run_until(self, end_ms: int) -> None:
        commands, body = self._commands, self._body
        step = self.plant.step
        while self._time_ms < end_ms:
            if self._controller is None and self._time_ms >= self._back_ms:
                self._controller = self._control()
            if (controller := self._controller) is not None:
                for command in commands.take():
                    controller.handle(command)
                body.write(controller.tick(body.read()))
            if self._time_ms % STATE_PERIOD_MS == 0:
                self._report()
            step(CONTROL_PERIOD_MS)
            self._time_ms += CONTROL_PERIOD_MS

    def _report(self) -> None:
        """Publish what is due at this instant."""
        now_s = self._time_ms / 1000.0
        self.clock.set(now_s)
        if self._controller is not None:
            self._bus.publish(topics.BODY_STATE, self._controller.state())
        for spoken in self._spoken.take():
            self.plant.hear(spoken.text)
        sensed = list(self.plant.sense(now_s))
        for topic, message in sensed:
            self._bus.publish(topic, message)
        self._body.relay()
        if sensed:
            self._perception.step()
