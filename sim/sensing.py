"""What the plant sends by itself: sensors and oracle messages, each at its own rate."""

from __future__ import annotations

import math
from collections.abc import Callable

import msgspec
import mujoco
import numpy as np

from robot.bus import topics
from robot.messages import Message
from robot.model.description import RobotDescription
from sim.atlas import world_map
from sim.battery import Battery
from sim.oracle import Oracle
from sim.rays import Rays
from sim.schema import World
from sim.sensors import DepthCamera, PlanarLidar

ORACLE_HZ = 10.0
MAP_HZ = 1.0
POWER_HZ = 1.0
SLOWER = 2.0
"""By how much camera and lidar are slower while the controller is pressed for time."""
HEAVY = frozenset({topics.DEPTH.name, topics.LIDAR.name, topics.ORACLE_SIGHTINGS.name})
"""What costs time to make, and to look at."""


class _Source:
    """One topic: how its message is made, and when the next one is due."""

    def __init__(self, topic: str, rate_hz: float, make: Callable[[float], Message]) -> None:
        self.topic, self.make = topic, make
        self.period_s = 1.0 / rate_hz
        self.due_s = 0.0
        self.silent_until_s = -math.inf


class Sensing:
    """All sensors of one plant.

    Attributes:
        oracle: truth, and the oracle messages made of it.
        camera, lidar: the emulated sensors.
        relieved: whether they go slower, because the controller is pressed for time.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        world: World,
        *,
        robot: RobotDescription,
        rng: np.random.Generator,
        pose_error_m: float,
        battery: Battery | None,
    ) -> None:
        """Build every sensor; each draws its noise from its own child of `rng`."""
        seeds = rng.spawn(3)
        self._model, self._data = model, data
        self.camera = DepthCamera(model, data, robot, rng=seeds[0])
        self.lidar = PlanarLidar(model, data, robot, rng=seeds[1])
        self.oracle = Oracle(
            model, data, world, robot=robot, rays=Rays(model, data, body=self.camera.body),
            rng=seeds[2], pose_error_m=pose_error_m,
        )  # fmt: skip
        prior = world_map(world)
        sensors = robot.sensors
        self.relieved = False
        self._sources = [
            _Source(topics.DEPTH.name, sensors.camera.rate_hz, self.camera.capture),
            _Source(topics.LIDAR.name, sensors.lidar.rate_hz, self.lidar.scan),
            _Source(topics.ORACLE_FIX.name, ORACLE_HZ, self.oracle.fix),
            _Source(topics.ORACLE_SIGHTINGS.name, ORACLE_HZ, self.oracle.sightings),
            _Source(
                topics.ORACLE_MAP.name, MAP_HZ,
                lambda stamp_s: msgspec.structs.replace(prior, stamp_s=stamp_s),
            ),
        ]  # fmt: skip
        if battery is not None:
            self._sources.append(_Source(topics.POWER.name, POWER_HZ, battery.report))

    def topics(self) -> list[str]:
        """Every topic that the plant sends."""
        return [source.topic for source in self._sources]

    def silence(self, topic: str, until_s: float) -> None:
        """Let a sensor say nothing until then."""
        for source in self._sources:
            if source.topic == topic:
                source.silent_until_s = until_s

    def due(self, now_s: float) -> list[tuple[str, Message]]:
        """The messages due by now, with their topics."""
        ready = [source for source in self._sources if now_s >= source.due_s - 1e-9]
        if ready:  # positions are those of the last step until this brings them up to date
            mujoco.mj_kinematics(self._model, self._data)
        found: list[tuple[str, Message]] = []
        for source in ready:
            slower = SLOWER if self.relieved and source.topic in HEAVY else 1.0
            source.due_s = max(source.due_s + slower * source.period_s, now_s)
            if now_s >= source.silent_until_s:
                found.append((source.topic, source.make(now_s)))
        return found
