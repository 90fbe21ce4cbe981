"""Every message that crosses from one process to another: frozen, stamped, SI.

    commands     what the executive asks of the body
    body_state   how the body is, as its controller believes
    speech       what is said and heard
    senses       what sensors tell, and the oracles that stand in for some
    shapes       forms of things
    world_state  the world as it is mapped and believed
    basics       what they share

Frames (docs/frames.md): W world; N odometry (the controller's own: smooth, drifting); B base
(pelvis); C camera; L, R soles; G grasp point of a hand; O object.
"""

from robot.messages.basics import (
    AskedEyes,
    AskedLocalisation,
    Channel,
    EyesBy,
    LocalisedBy,
    Message,
    Mode,
    Side,
    Source,
)
from robot.messages.body_state import (
    IMU,
    Activity,
    BodyState,
    HandState,
    ImuBias,
    Landing,
    LoopTiming,
    MotorAlarm,
)
from robot.messages.commands import (
    BodyCommand,
    Command,
    Damp,
    GetUp,
    Grip,
    HoldArm,
    Look,
    MoveArm,
    MoveHand,
    OneLeg,
    Payload,
    Stand,
    Walk,
    WalkTo,
)
from robot.messages.senses import (
    CameraState,
    DepthImage,
    LidarScan,
    PoseFix,
    PowerState,
    RgbdImage,
    Sighting,
    Sightings,
)
from robot.messages.shapes import (
    Piece,
    Shape,
)
from robot.messages.speech import (
    Heard,
    Spoken,
)
from robot.messages.world_state import (
    Looked,
    ObjectInfo,
    Obstacle,
    PersonInfo,
    Place,
    Track,
    Unnamed,
    WorldMap,
    WorldState,
)

__all__ = [
    "IMU",
    "Activity",
    "AskedEyes",
    "AskedLocalisation",
    "BodyCommand",
    "BodyState",
    "CameraState",
    "Channel",
    "Command",
    "Damp",
    "DepthImage",
    "EyesBy",
    "GetUp",
    "Grip",
    "HandState",
    "Heard",
    "HoldArm",
    "ImuBias",
    "Landing",
    "LidarScan",
    "LocalisedBy",
    "Look",
    "Looked",
    "LoopTiming",
    "Message",
    "Mode",
    "MotorAlarm",
    "MoveArm",
    "MoveHand",
    "ObjectInfo",
    "Obstacle",
    "OneLeg",
    "Payload",
    "PersonInfo",
    "Piece",
    "Place",
    "PoseFix",
    "PowerState",
    "RgbdImage",
    "Shape",
    "Side",
    "Sighting",
    "Sightings",
    "Source",
    "Spoken",
    "Stand",
    "Track",
    "Unnamed",
    "Walk",
    "WalkTo",
    "WorldMap",
    "WorldState",
]
