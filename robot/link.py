"""The executive's only handle on the body: commands down, newest messages up."""

from __future__ import annotations

from typing import Protocol

from robot.messages import BodyCommand, BodyState, DepthImage, LidarScan, WorldMap, WorldState


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
        """The prior map, None before it came."""
        ...

    def lidar(self) -> LidarScan | None:
        """The newest lidar scan."""
        ...

    def depth(self) -> DepthImage | None:
        """The newest depth image."""
        ...
