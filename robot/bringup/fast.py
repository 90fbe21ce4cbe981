"""The `fast` runtime: everything in one process, as fast as the machine goes, repeatable."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from robot.bringup.lockstep import Lockstep
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.control.loop import NEEDS, ControlLoop
from robot.drivers.body_devices import BodyDevices
from robot.drivers.body_sample import BodySample
from robot.drivers.wiring import Wiring
from robot.messages import BodyState
from robot.model import description
from robot.model.description import RobotDescription
from robot.perception.node import PerceptionNode
from robot.reality.contract import Plant, World

PHYSICS_MS = 2  # the motors' firmware runs in the physics step, integrated implicitly; `live`: 1 ms


class FastRuntime(Lockstep):
    """A robot in a world under a simulated clock; same arguments and calls, same run."""

    def __init__(
        self,
        world: World,
        robot: str = "juno",
        *,
        seed: int = 0,
        bus: LocalBus | None = None,
        lidar_map: Path | None = None,
        on_sample: Callable[[BodySample, Plant], None] | None = None,
        trail: Path | None = None,
    ) -> None:
        """Build every part; nothing moves before `advance`.

        Args:
            world: where it is.
            robot: name or path of a robot description.
            seed: of everything random.
            bus: to carry the messages; a new one by default.
            lidar_map: the map that it finds itself in, where its lidar tells it where it is.
            on_sample: hears what the body feels in every period of its controller, for recordings.
            trail: file for how everything truly moves, for people who look on.

        Raises:
            ConfigError: if the robot or the map cannot be used.
        """
        bus = bus or LocalBus()
        body = description.load(robot)
        plant = world.plant(body, seed=seed, physics_ms=PHYSICS_MS)
        self._trail = None if trail is None else plant.leave_trail(trail)
        clock = SimulatedClock()
        wiring = Wiring(robot=body, clock=clock, bus=bus, plant=plant)
        states = bus.subscribe(topics.BODY_STATE)
        camera = plant.camera(renderer="rays") if world.eyes == "camera" else None
        self._camera = None if camera is None else camera.__enter__()
        super().__init__(
            plant,
            lambda: _controller(body, states.latest),
            PerceptionNode(
                wiring,
                eyes=world.eyes,
                take=None if camera is None else camera.take,
                localisation=world.localisation,
                lidar_map=lidar_map,
            ),
            body=BodyDevices(
                wiring,
                needs=NEEDS,
                on_sample=None if on_sample is None else lambda sample: on_sample(sample, plant),
            ),
            bus=bus,
            clock=clock,
        )

    def close(self) -> None:
        """Damp the motors, and close the camera and the bus."""
        super().close()
        if self._trail is not None:
            self._trail.close()
        if self._camera is not None:
            self._camera.close()


def _controller(body: RobotDescription, before: BodyState | None) -> ControlLoop:
    """A controller that knows what the one before it said last."""
    loop = ControlLoop(body)
    loop.recall(before)
    return loop
