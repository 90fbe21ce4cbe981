"""What the plant sends by itself: sensors and oracle messages, each at its own rate."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Generic, TypeVar

import msgspec
import mujoco
import numpy as np

from robot.bus import topics
from robot.bus.topics import Topic
from robot.drivers.simulation.plant_sensors import emulated
from robot.messages import EyesBy, LocalisedBy, Message
from robot.model.description import RobotDescription
from robot.se3 import SE3
from sim.atlas import world_map
from sim.battery import Battery
from sim.oracle import Oracle
from sim.ray_sensors import DepthCamera, PlanarLidar
from sim.rays import Rays
from sim.realities import Camera, Lidar
from sim.world_schema import World

M = TypeVar("M", bound=Message)
SLOWER = 2.0
"""By how much camera and lidar are slower while the controller is pressed for time."""
HEAVY = (topics.DEPTH, topics.LIDAR, topics.ORACLE_SIGHTINGS)
"""What costs time to make, and to look at."""


class _Source(Generic[M]):
    """One topic: how its message is made, and when the next one is due.

    What a sensor measures goes to the sensor's driver, which publishes it.
    """

    def __init__(self, topic: Topic[M], make: Callable[[float], M]) -> None:
        if topic.rate_hz is None:
            raise ValueError(f"{topic.name} has no rate to send it at")
        self.name, self.make = topic.name, make
        self.topic = topic if topic.source == "plant" else emulated(topic)
        self.heavy = topic in HEAVY
        self.period_s = 1.0 / topic.rate_hz
        self.due_s = 0.0
        self.silent_until_s = -math.inf


class Sending:
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
        eyes: EyesBy = "oracle",
        localisation: LocalisedBy = "oracle",
    ) -> None:
        """Build every sensor; each draws its noise from its own child of `rng`.

        Where the robot's own eyes find things and people (`eyes`), the oracle sights none of them,
        and the map tells no more of things than their names do. Where its own lidar finds the robot
        (`localisation`), no fix is made, and the map does not tell where it began.
        """
        seeds = rng.spawn(3)
        self._model, self._data = model, data
        self.camera = DepthCamera(model, data, robot, rng=seeds[0])
        self.lidar = PlanarLidar(model, data, robot, rng=seeds[1])
        self.oracle = Oracle(
            model, data, world, robot=robot, rays=Rays(model, data, body=self.camera.body),
            rng=seeds[2], pose_error_m=pose_error_m,
        )  # fmt: skip
        prior = world_map(world) if eyes == "oracle" else world_map(world).told()
        self.relieved = False
        if localisation != "oracle":
            prior = msgspec.structs.replace(prior, start_X_WS=SE3())
        self._sources: list[_Source[Any]] = [
            _Source(topics.DEPTH, self.camera.capture),
            _Source(topics.LIDAR, self.lidar.scan),
            _Source(topics.ORACLE_FIX, self.oracle.fix),
            _Source(topics.ORACLE_SIGHTINGS, self.oracle.sightings),
            _Source(
                topics.ORACLE_MAP, lambda stamp_s: msgspec.structs.replace(prior, stamp_s=stamp_s)
            ),
        ]
        if battery is not None:
            self._sources.append(_Source(topics.POWER, battery.report))
        untold = () if localisation == "oracle" else (topics.ORACLE_FIX.name,)
        if eyes != "oracle":
            untold = (*untold, topics.ORACLE_SIGHTINGS.name)
        self._told = [source for source in self._sources if source.name not in untold]

    def spoil(self, lidar: Lidar, camera: Camera) -> None:
        """From now on they are as good as that."""
        self.lidar.flaws, self.camera.flaws = lidar, camera

    def topics(self) -> list[str]:
        """Names of the topics that the plant, or a driver of its sensors, sends."""
        return [source.name for source in self._sources]

    def silence(self, topic: str, until_s: float) -> None:
        """Let a sensor say nothing until then."""
        for source in self._sources:
            if source.name == topic:
                source.silent_until_s = until_s

    def due(self, now_s: float) -> list[tuple[Topic[Any], Message]]:
        """The messages due by now, with the topics to send them on."""
        ready = [source for source in self._told if now_s >= source.due_s - 1e-9]
        if ready:  # positions are those of the last step until this brings them up to date
            mujoco.mj_kinematics(self._model, self._data)
        found: list[tuple[Topic[Any], Message]] = []
        for source in ready:
            slower = SLOWER if self.relieved and source.heavy else 1.0
            source.due_s = max(source.due_s + slower * source.period_s, now_s)
            if now_s >= source.silent_until_s:
                found.append((source.topic, source.make(now_s)))
        return found
