"""Every topic of the robot in one table: its name, what travels on it, how often, who sends it.

Health is derived from this table: a topic with a rate is silent when its newest message is older
than a few periods.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

from robot.errors import BusError
from robot.messages import (
    BodyCommand,
    BodyState,
    DepthImage,
    LidarScan,
    LoopTiming,
    PoseFix,
    PowerState,
    Sightings,
    WorldMap,
    WorldState,
)

M = TypeVar("M")
Process = Literal["executive", "controller", "perception", "plant"]


@dataclass(frozen=True)
class Topic(Generic[M]):
    """A named stream of messages of one type.

    `kind` is the type (a struct or a union of structs), `rate_hz` the rate its source promises,
    None for events that come when they come. `queue` is how many messages a subscriber that
    takes them one by one may fall behind before the oldest are dropped.
    """

    name: str
    kind: Any
    rate_hz: float | None
    source: Process
    queue: int = 8


BODY_COMMAND: Topic[BodyCommand] = Topic("body/command", BodyCommand, None, "executive", queue=256)
BODY_STATE: Topic[BodyState] = Topic("body/state", BodyState, 50.0, "controller", queue=64)
DEPTH: Topic[DepthImage] = Topic("sensors/depth", DepthImage, 10.0, "plant")
LIDAR: Topic[LidarScan] = Topic("sensors/lidar", LidarScan, 10.0, "plant")
ORACLE_FIX: Topic[PoseFix] = Topic("oracle/fix", PoseFix, 10.0, "plant", queue=64)
ORACLE_SIGHTINGS: Topic[Sightings] = Topic("oracle/sightings", Sightings, 10.0, "plant")
ORACLE_MAP: Topic[WorldMap] = Topic("oracle/map", WorldMap, 1.0, "plant")
POWER: Topic[PowerState] = Topic("power/state", PowerState, 1.0, "plant")
WORLD_STATE: Topic[WorldState] = Topic("world/state", WorldState, 10.0, "perception")
CONTROLLER_TIMING: Topic[LoopTiming] = Topic("controller/timing", LoopTiming, 2.0, "controller")
PLANT_TIMING: Topic[LoopTiming] = Topic("plant/timing", LoopTiming, 1.0, "plant")

TOPICS: tuple[Topic[Any], ...] = (
    BODY_COMMAND,
    BODY_STATE,
    DEPTH,
    LIDAR,
    ORACLE_FIX,
    ORACLE_SIGHTINGS,
    ORACLE_MAP,
    POWER,
    WORLD_STATE,
    CONTROLLER_TIMING,
    PLANT_TIMING,
)
BY_NAME: dict[str, Topic[Any]] = {topic.name: topic for topic in TOPICS}


def named(name: str) -> Topic[Any]:
    """The topic of that name.

    Raises:
        BusError: if the table has no such topic.
    """
    if name not in BY_NAME:
        raise BusError(f"no topic {name!r}; the table has {', '.join(sorted(BY_NAME))}")
    return BY_NAME[name]
