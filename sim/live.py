"""The plant on the wall clock: paced, patient with a late controller, open to faults."""

from __future__ import annotations

from collections.abc import Callable

from robot.bus import topics
from robot.bus.bus import Bus
from robot.bus.timing import Lateness
from robot.clock import Clock
from robot.drivers.simulation.shared_plant import PlantServer
from robot.errors import ConfigError
from robot.reality.faults import FAULT
from sim import faults
from sim.plant import Plant
from sim.plant_buses import PlantBuses
from sim.ray_sensors import developed
from sim.scene_memory import SceneMemory

PERIOD_MS = 2
PERIOD_S = PERIOD_MS / 1000.0
PATIENCE_S = 0.010  # wall time that one period waits for the controller
CATCH_UP_S = 0.050  # further behind the wall clock than this, simulated time just runs late
REST = 0.2
"""Share of a period that is left to others where simulated time runs late: plant and controller run
before all that is not real-time, and a planner beside them had a tenth of a core."""
POLL_S = 0.0001
TIMING_S = 1.0


class LivePlant:
    """Runs a plant in step with the wall clock, as far as controller and machine keep up.

    Each period publishes what the body feels and waits for a command that answers it, a few
    milliseconds at most: on a slow machine simulated time then runs slower than the wall's
    (`PLANT_TIMING` says by how much) instead of letting the robot fall. Once the motors'
    watchdog has tripped, nothing is waited for. Time stands still until the first command.

    Attributes:
        refused: faults that named what is not there.
    """

    def __init__(
        self,
        plant: Plant,
        body: PlantServer,
        bus: Bus,
        *,
        clock: Clock,
        scene: SceneMemory | None = None,
        buses: PlantBuses | None = None,
    ) -> None:
        """Put the parts together; nothing runs before `run`.

        Args:
            plant: to run.
            body: how the controller reaches it.
            bus: for what is not urgent.
            clock: of the wall.
            scene: for who takes pictures of it, where somebody does.
            buses: by which its motors are commanded, where that is not by its memory.
        """
        self._scene, self._picture_s = scene, 0.0
        self._picture_period_s = 1.0 / plant.robot.sensors.camera.pictures().rate_hz
        self.refused: list[str] = []
        self._plant, self._body, self._bus, self._clock = plant, body, bus, clock
        self._faults = bus.subscribe(FAULT)
        self._spoken = bus.subscribe(topics.SPOKEN)
        self._controller = bus.subscribe(topics.CONTROLLER_TIMING)
        self._buses = buses
        self._period_s = PERIOD_S if buses is None else buses.period_ms / 1000.0
        self._lateness = Lateness("plant", self._period_s)
        self._due_s = clock.now_s()
        self._report_s = 0.0
        self._begun = False

    def run(self, stop: Callable[[], bool]) -> None:
        """Go on until `stop` says so. Raises DriverError if the physics diverged."""
        self._due_s = self._clock.now_s()
        while not stop():
            self.period()

    def period(self) -> None:
        """One exchange with the controller, and the physics of a period."""
        plant, began_s = self._plant, self._clock.now_s()
        for fault in self._faults.take():
            try:
                faults.apply(plant, fault)
            except ConfigError as error:
                self.refused.append(str(error))
        for spoken in self._spoken.take():
            plant.hear(spoken.text)
        sample = plant.read()
        self._body.publish(sample)
        if (timing := self._controller.latest) is not None:
            plant.sending.relieved = timing.pressed
        for topic, message in plant.sense():
            self._bus.publish(topic, developed(message))
        if self._scene is not None and plant.time_s >= self._picture_s - 1e-9:
            self._picture_s += self._picture_period_s
            self._scene.write(plant.time_s, plant.data)
        if self._buses is not None:
            self._begun = self._buses.period(sample, patience_s=PATIENCE_S)
        else:
            waits = self._begun and not sample.motors.watchdog
            self._exchange(patience_s=PATIENCE_S if waits else 0.0)
            if self._begun:
                plant.step(PERIOD_MS)
        self._pace(began_s)

    def _exchange(self, *, patience_s: float) -> None:
        """Take the controller's answer to the state just published, waiting for it if need be.

        A late answer to an older state is taken as well, but waited past: else the controller
        would stay a period behind for ever.
        """
        asked_s = self._plant.time_s
        until_s = self._clock.now_s() + patience_s
        while True:
            if (command := self._body.take()) is not None:
                self._plant.write(command)
                self._begun = True
                if command.stamp_s >= asked_s:
                    return
            now_s = self._clock.now_s()
            if now_s >= until_s:
                return
            self._clock.sleep_until(now_s + POLL_S)

    def _pace(self, began_s: float) -> None:
        """Sleep until the next period is due, and report once a second."""
        now_s = self._clock.now_s()
        self._due_s += self._period_s
        if self._due_s < now_s - CATCH_UP_S:  # it will not catch up
            self._due_s = now_s - CATCH_UP_S
            self._clock.sleep_until(now_s + REST * (now_s - began_s))
        else:
            self._clock.sleep_until(self._due_s)
        now_s = self._clock.now_s()
        self._lateness.tick(now_s)
        if self._begun and now_s >= self._report_s:
            self._report_s = now_s + TIMING_S
            report = self._lateness.report(self._plant.time_s, now_s)
            self._bus.publish(topics.PLANT_TIMING, report)
