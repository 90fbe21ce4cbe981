"""The executive's only handle on the body: commands down, newest messages up."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from robot.bus import topics
from robot.bus.bus import Bus
from robot.clock import Clock
from robot.messages import (
    BodyCommand,
    BodyState,
    CameraState,
    DepthImage,
    Heard,
    LidarScan,
    LoopTiming,
    PowerState,
    Spoken,
    WorldMap,
    WorldState,
)


class BodyLink(Protocol):
    """What skills and the executive see of the body, whatever carries it."""

    def send(self, command: BodyCommand) -> None:
        """Send one command; `BodyState.activities` answers with its id."""
        ...

    def next_id(self) -> int:
        """A fresh command id, growing."""
        ...

    def now_s(self) -> float:
        """The runtime's clock."""
        ...

    def body(self) -> BodyState | None:
        """The newest state of the body, None before the first."""
        ...

    def world(self) -> WorldState | None:
        """The newest state of the world model, None before the first."""
        ...

    def map(self) -> WorldMap | None:
        """The map: the robot's own where its eyes make one, else the prior; None before it came."""
        ...

    def lidar(self) -> LidarScan | None:
        """The newest lidar scan."""
        ...

    def depth(self) -> DepthImage | None:
        """The newest depth image."""
        ...

    def camera(self) -> CameraState | None:
        """How the camera of pictures is, None while nobody looks through it."""
        ...

    def power(self) -> PowerState | None:
        """The newest state of the battery, None without one."""
        ...

    def timing(self) -> LoopTiming | None:
        """How well the controller keeps its time; None where time is simulated."""
        ...

    def speak(self, text: str) -> None:
        """Let people who stand near hear a text."""
        ...

    def heard(self) -> Sequence[Heard]:
        """What people have said since this was asked last, oldest first."""
        ...


class BusLink:
    """A `BodyLink` over a bus; command ids grow from 1, or from where somebody before ended."""

    def __init__(self, bus: Bus, clock: Clock) -> None:
        self._bus = bus
        self._clock = clock
        self._last_id = 0
        self._body = bus.subscribe(topics.BODY_STATE)
        self._world = bus.subscribe(topics.WORLD_STATE)
        self._map = bus.subscribe(topics.ORACLE_MAP)
        self._own_map = bus.subscribe(topics.WORLD_MAP)
        self._lidar = bus.subscribe(topics.LIDAR)
        self._depth = bus.subscribe(topics.DEPTH)
        self._camera = bus.subscribe(topics.CAMERA_STATE)
        self._power = bus.subscribe(topics.POWER)
        self._heard = bus.subscribe(topics.HEARD)
        self._timing = bus.subscribe(topics.CONTROLLER_TIMING)

    def send(self, command: BodyCommand) -> None:
        """Send one command. Raises BusError if the bus is closed."""
        self._bus.publish(topics.BODY_COMMAND, command)

    def next_id(self) -> int:
        """A fresh command id, growing."""
        if not self._last_id and (body := self.body()) is not None:
            self._last_id = max((one.id for one in body.activities.values()), default=0)
        self._last_id += 1
        return self._last_id

    def now_s(self) -> float:
        """The runtime's clock."""
        return self._clock.now_s()

    def body(self) -> BodyState | None:
        """The newest state of the body, None before the first."""
        return self._body.latest

    def world(self) -> WorldState | None:
        """The newest state of the world model, None before the first."""
        return self._world.latest

    def map(self) -> WorldMap | None:
        """The map: the robot's own where its eyes make one, else the prior; None before it came."""
        return self._own_map.latest or self._map.latest

    def lidar(self) -> LidarScan | None:
        """The newest lidar scan."""
        return self._lidar.latest

    def depth(self) -> DepthImage | None:
        """The newest depth image."""
        return self._depth.latest

    def camera(self) -> CameraState | None:
        """How the camera of pictures is, None while nobody looks through it."""
        return self._camera.latest

    def power(self) -> PowerState | None:
        """The newest state of the battery, None without one."""
        return self._power.latest

    def timing(self) -> LoopTiming | None:
        """How well the controller keeps its time; None where time is simulated."""
        return self._timing.latest

    def speak(self, text: str) -> None:
        """Let people who stand near hear a text. Raises BusError if the bus is closed."""
        self._bus.publish(topics.SPOKEN, Spoken(stamp_s=self._clock.now_s(), text=text))

    def heard(self) -> Sequence[Heard]:
        """What people have said since this was asked last, oldest first."""
        return self._heard.take()
