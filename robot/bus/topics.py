"""Every topic of the robot in one table: its name, what travels on it, how often, who sends it.

Health is derived from this table: a topic with a rate is silent when its newest message is older
than a few periods, and its row says what that means.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

from robot.messages import (
    BodyCommand,
    BodyState,
    CameraState,
    DepthImage,
    Heard,
    LidarScan,
    LoopTiming,
    PoseFix,
    PowerState,
    RgbdImage,
    Sightings,
    Spoken,
    WorldMap,
    WorldState,
)

M = TypeVar("M")
Process = Literal["executive", "controller", "perception", "plant"]


@dataclass(frozen=True, kw_only=True)
class Silence:
    """What it means that a topic is silent: after so many periods, and seconds at least.

    `code` is a failure's, `level` the name of what health makes of it (`executive.health`), `text`
    what people read, `starting` what they read at the start, before the first message.
    """

    code: str
    level: Literal["HOLD", "SIT"]
    text: str
    starting: str
    periods: float = 3.0
    at_least_s: float = 0.5


@dataclass(frozen=True)
class Topic(Generic[M]):
    """A named stream of messages of one type.

    `kind` is the type (a struct or a union of structs), `rate_hz` the rate its source promises,
    None for events that come when they come. `queue` is how many messages a subscriber that
    takes them one by one may fall behind before the oldest are dropped. A topic without `silence`
    is not missed.
    """

    name: str
    kind: Any
    rate_hz: float | None
    source: Process
    queue: int = 8
    silence: Silence | None = None


BODY_COMMAND: Topic[BodyCommand] = Topic("body/command", BodyCommand, None, "executive", queue=256)
BODY_STATE: Topic[BodyState] = Topic(
    "body/state", BodyState, 50.0, "controller", queue=64,
    silence=Silence(
        code="controller_lost",
        level="SIT",
        text="the controller stopped reporting; the motors damp by themselves",
        starting="the controller is starting",
        periods=10.0,
    ),
)  # fmt: skip
LIDAR: Topic[LidarScan] = Topic(
    "sensors/lidar", LidarScan, 10.0, "perception",
    silence=Silence(
        code="sensor_silent",
        level="HOLD",
        text="the lidar is silent",
        starting="the lidar is starting",
    ),
)  # fmt: skip
DEPTH: Topic[DepthImage] = Topic(
    "sensors/depth", DepthImage, 10.0, "perception",
    silence=Silence(
        code="sensor_silent",
        level="HOLD",
        text="the camera is silent",
        starting="the camera is starting",
    ),
)  # fmt: skip
RGBD: Topic[RgbdImage] = Topic("sensors/rgbd", RgbdImage, 10.0, "perception", queue=2)
CAMERA_STATE: Topic[CameraState] = Topic("sensors/camera_state", CameraState, 2.0, "perception")
ORACLE_FIX: Topic[PoseFix] = Topic("oracle/fix", PoseFix, 10.0, "plant", queue=64)
ORACLE_SIGHTINGS: Topic[Sightings] = Topic("oracle/sightings", Sightings, 10.0, "plant")
ORACLE_MAP: Topic[WorldMap] = Topic("oracle/map", WorldMap, 1.0, "plant")
WORLD_MAP: Topic[WorldMap] = Topic("world/map", WorldMap, 1.0, "perception")
"""The prior map, with things as the robot's own eyes see them, where these tell of them."""
SPOKEN: Topic[Spoken] = Topic("voice/spoken", Spoken, None, "executive", queue=32)
HEARD: Topic[Heard] = Topic("oracle/heard", Heard, None, "plant", queue=32)
POWER: Topic[PowerState] = Topic("power/state", PowerState, 1.0, "controller")
WORLD_STATE: Topic[WorldState] = Topic(
    "world/state", WorldState, 10.0, "perception",
    silence=Silence(
        code="localisation_lost",
        level="HOLD",
        text="the world model is silent",
        starting="the robot is finding its place",
    ),
)  # fmt: skip
CONTROLLER_TIMING: Topic[LoopTiming] = Topic("controller/timing", LoopTiming, 2.0, "controller")
PLANT_TIMING: Topic[LoopTiming] = Topic("plant/timing", LoopTiming, 1.0, "plant")

TOPICS: tuple[Topic[Any], ...] = (
    BODY_COMMAND,
    BODY_STATE,
    WORLD_STATE,  # before camera and lidar: when perception dies, that is what is told first
    LIDAR,
    DEPTH,
    RGBD,
    CAMERA_STATE,
    ORACLE_FIX,
    ORACLE_SIGHTINGS,
    ORACLE_MAP,
    WORLD_MAP,
    SPOKEN,
    HEARD,
    POWER,
    CONTROLLER_TIMING,
    PLANT_TIMING,
)
BY_NAME: dict[str, Topic[Any]] = {topic.name: topic for topic in TOPICS}
