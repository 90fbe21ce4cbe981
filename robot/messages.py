"""Every message that crosses from one process to another: frozen, stamped, SI.

Frames (docs/frames.md): W world; N odometry (the controller's own: smooth, drifting); B base
(pelvis); C camera; L, R soles; G grasp point of a hand; O object.
"""

from __future__ import annotations

import math
from typing import Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from robot.failures import Failure
from robot.se3 import SE3, Array, Vector3
from robot.usual_things import usual

Side = Literal["left", "right"]
Mode = Literal["damping", "stand", "walk", "fallen", "rising"]
Channel = Literal["legs", "waist", "head", "left_arm", "right_arm", "left_hand", "right_hand"]
Source = Literal["oracle", "emulated", "sensor", "estimate"]
EyesBy = Literal["oracle", "camera"]
"""Who tells where the things are: the simulator, or what the robot sees in its own pictures."""
LocalisedBy = Literal["oracle", "lidar"]
"""Who tells where the robot is: the simulator, or its own lidar and legs in its own map."""
SAMPLE_M = 0.25
"""How far apart the points of a surface are by which it is said what of it was seen [m]."""


class Message(msgspec.Struct, frozen=True, kw_only=True):
    """A message; `stamp_s` is the sender's clock when the content was true."""

    stamp_s: float


# --- executive -> controller -------------------------------------------------------------------


class Command(Message, frozen=True, kw_only=True, tag=True):
    """A request to the body. `id` grows; `Activity.id` in the state answers it."""

    id: int


class Damp(Command, frozen=True, kw_only=True):
    """Let every motor damp (kp = 0, velocity target 0)."""


class GetUp(Command, frozen=True, kw_only=True):
    """Get up from the floor and stand; only for a robot that has fallen. `Damp` ends it at once."""


class Stand(Command, frozen=True, kw_only=True):
    """Stand on both feet where they are; finish the step first if walking.

    `height_m` is the base height wanted above the soles (None: nominal), `pitch_rad` a lean of the
    trunk by the waist, `yaw_rad` a turn of it.
    """

    height_m: float | None = None
    pitch_rad: float = 0.0
    yaw_rad: float = 0.0


class OneLeg(Command, frozen=True, kw_only=True):
    """Shift onto `side` and lift the other foot for `duration_s`, then stand again."""

    side: Side
    duration_s: float


class Walk(Command, frozen=True, kw_only=True):
    """Walk at a twist in the base's heading frame [m/s, rad/s]; dies out after `hold_s`."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0
    hold_s: float = 0.5


class WalkTo(Command, frozen=True, kw_only=True):
    """Step to a stance: the midpoint of the soles at X_NS (x, y, yaw), then stand."""

    x_m: float
    y_m: float
    yaw_rad: float
    position_tolerance_m: float = 0.015
    yaw_tolerance_rad: float = 0.03


class MoveArm(Command, frozen=True, kw_only=True):
    """Follow a joint trajectory.

    `times_s` from now, shape (k,); `positions_rad` shape (k, joints of the arm), in the order of
    the description's group; interpolated by a C2 (cubic) spline, at rest at both ends.
    """

    side: Side
    times_s: tuple[float, ...]
    positions_rad: tuple[tuple[float, ...], ...]


class MoveHand(Command, frozen=True, kw_only=True):
    """Move the grasp frame on a straight line to X_NG, corrected for the body's motion, and hold.

    With `stop_load_n`, a downward line also ends when the wrist's vertical load has changed by
    that much (contact). With `near_rad`, joints of the arm, the elbow goes where it is at these, as
    far as the line allows; else it goes wherever the joints move least.
    """

    side: Side
    X_NG: SE3
    speed_m_s: float = 0.15
    stop_load_n: float | None = None
    near_rad: tuple[float, ...] = ()


class HoldArm(Command, frozen=True, kw_only=True):
    """Brake an arm, with bounds on acceleration and jerk, and hold its joints where they rest."""

    side: Side


class Grip(Command, frozen=True, kw_only=True):
    """Open or close the fingers to `opening_m` with `force_n` a finger, more if it is pulled at."""

    side: Side
    opening_m: float
    force_n: float = 15.0


class Look(Command, frozen=True, kw_only=True):
    """Turn the head's camera towards a point of N [m]."""

    p_N: Vector3


class Payload(Command, frozen=True, kw_only=True):
    """Tell the body what a hand carries, centre of mass at the grasp point (0 kg: nothing)."""

    side: Side
    mass_kg: float


BodyCommand = (
    Damp
    | GetUp
    | Stand
    | OneLeg
    | Walk
    | WalkTo
    | MoveArm
    | MoveHand
    | HoldArm
    | Grip
    | Look
    | Payload
)


# --- controller -> everybody -------------------------------------------------------------------


class Activity(msgspec.Struct, frozen=True, kw_only=True):
    """What a channel does about the last command sent to it."""

    id: int
    status: Literal["running", "done", "failed"]
    detail: str = ""


class HandState(msgspec.Struct, frozen=True, kw_only=True):
    """One hand: grasp pose, measured opening [m] and opening speed [m/s], force at the wrist.

    `load_n` is the vertical force the hand bears beyond its own weight [N], low-pass filtered.
    `pulls` is how often it has gripped harder, because what it holds was about to slip.
    """

    X_NG: SE3
    opening_m: float
    opening_m_s: float
    load_n: float
    pulls: int = 0


class ImuBias(msgspec.Struct, frozen=True, kw_only=True):
    """What is known of an IMU, in its own frame: its offsets, and how sure they are (1 sigma)."""

    gyro_rad_s: Vector3
    accel_m_s2: Vector3
    gyro_sigma_rad_s: Vector3
    accel_sigma_m_s2: Vector3


class MotorAlarm(msgspec.Struct, frozen=True):
    """One thing wrong with a motor or its bus, as its driver says.

    `code` is for programs (`silent`), `who` the joint or the bus; `level` what is done, mild first:
    WARN, DERATE (less torque), HOLD (the last targets are kept), SIT (the robot is lowered, and it
    stays latched).
    """

    code: str
    who: str
    level: Literal["WARN", "DERATE", "HOLD", "SIT"]
    cause: str
    cure: str


class Landing(msgspec.Struct, frozen=True, kw_only=True):
    """Where a sole is to land: its middle and heading on the floor of N [m, rad]."""

    side: Side
    x_m: float
    y_m: float
    yaw_rad: float


class BodyState(Message, frozen=True, kw_only=True):
    """The body as the controller believes it to be; estimated, not true.

    `q_rad`, `qd_rad_s`, `tau_nm` are in motor order (the description's), fingers in m, m/s, N.
    `X_NS` is the stance: midpoint and mean heading of the soles. Points in N [m]. `since_s` is when
    this controller took the motors over: another value, another controller, with an N of its own;
    what it knows of the IMU goes over to that. `steps` are the landings that are planned, in order.
    """

    mode: Mode
    X_NB: SE3
    v_NB: Vector3
    w_NB: Vector3
    X_NL: SE3
    X_NR: SE3
    X_NS: SE3
    left_contact: bool
    right_contact: bool
    q_rad: tuple[float, ...]
    qd_rad_s: tuple[float, ...]
    tau_nm: tuple[float, ...]
    com_N: Vector3
    dcm_N: tuple[float, float]
    zmp_N: tuple[float, float]
    hands: dict[Side, HandState]
    activities: dict[Channel, Activity]
    clamped: int = 0
    refused: int = 0
    temperature_c: tuple[float, ...] = ()
    alarms: tuple[MotorAlarm, ...] = ()
    failure: Failure | None = None
    since_s: float = 0.0
    imu: ImuBias | None = None
    steps: tuple[Landing, ...] = ()


class LoopTiming(Message, frozen=True, kw_only=True):
    """How well a periodic loop keeps its time, since it began.

    `late` of `count` periods began later than half a period after their time; percentiles of the
    lateness in seconds. `real_time_factor` is simulated time over wall time, 1 on hardware.
    `late_share` is of the periods since the last report; `pressed` asks whatever is not real-time
    to make room (`robot.bus.timing`).
    """

    process: str
    period_s: float
    count: int
    late: int
    p50_s: float
    p99_s: float
    p999_s: float
    max_s: float
    real_time_factor: float = 1.0
    late_share: float = 0.0
    pressed: bool = False


# --- the robot and people ----------------------------------------------------------------------


class Spoken(Message, frozen=True, kw_only=True):
    """What the robot says aloud: people who stand near can hear it."""

    text: str


class Heard(Message, frozen=True, kw_only=True):
    """What a person says to the robot; `source` is "oracle" for people who are simulated."""

    text: str
    person_id: str
    source: Source = "oracle"


# --- sensors and oracle ------------------------------------------------------------------------


class DepthImage(Message, frozen=True, kw_only=True):
    """Depth along the optical axis [m], float32 row-major bytes, 0 where nothing was hit."""

    width: int
    height: int
    fovy_rad: float
    depth_m: bytes
    source: Source = "emulated"

    def pixels(self) -> NDArray[np.float32]:
        """Depth [m], shape (height, width), not to be written to."""
        return np.frombuffer(self.depth_m, np.float32).reshape(self.height, self.width)


class RgbdImage(Message, frozen=True, kw_only=True):
    """One picture of a camera: colours, and depth where the device has it, pixel for pixel.

    The camera's frame C is the site `frame` of the body at `stamp_s`, as OpenCV has it: x right, y
    down, z forward. A pixel (u, v), whose middle has whole numbers, looks along
    ((u - cx) / fx, (v - cy) / fy, 1) in C.

    Attributes:
        width, height: of both, in pixels.
        focal_px: fx, fy.
        centre_px: cx, cy.
        frame: the site of the body that is C.
        colours: red, green, blue of 0 to 255, row by row.
        depth_m: float32 along z of C [m], row by row; 0: nothing was measured. Empty: no depth.
        exposure_s: how long light was gathered, until `stamp_s`.
    """

    width: int
    height: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    frame: str
    colours: bytes
    depth_m: bytes = b""
    exposure_s: float = 0.0
    source: Source = "emulated"

    def picture(self) -> NDArray[np.uint8]:
        """Red, green, blue, shape (height, width, 3), not to be written to."""
        return np.frombuffer(self.colours, np.uint8).reshape(self.height, self.width, 3)

    def depth(self) -> NDArray[np.float32] | None:
        """Depth [m], shape (height, width), not to be written to; None: the device has none."""
        if not self.depth_m:
            return None
        return np.frombuffer(self.depth_m, np.float32).reshape(self.height, self.width)

    def matrix(self) -> Array:
        """The camera matrix K [px], shape (3, 3)."""
        (fx, fy), (cx, cy) = self.focal_px, self.centre_px
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


class CameraState(Message, frozen=True, kw_only=True):
    """How the camera of `RgbdImage` is: what is wrong with it is a code of `robot.failures`.

    Attributes:
        code: empty while all is well.
        cause: a sentence, for people.
    """

    code: str = ""
    cause: str = ""


class LidarScan(Message, frozen=True, kw_only=True):
    """Ranges [m] of a planar scan in the lidar's frame, counter-clockwise from -pi; inf: no hit."""

    angle_min_rad: float
    angle_step_rad: float
    ranges_m: tuple[float, ...]
    source: Source = "emulated"


class PowerState(Message, frozen=True, kw_only=True):
    """The battery: charge as a part of the whole (0 to 1), and what is drawn [W]."""

    charge: float
    power_w: float
    source: Source


class PoseFix(Message, frozen=True, kw_only=True):
    """Where the base is in the world, absolutely, at the stamp.

    `covariance`, row by row, is of the errors of x, y [m] and heading [rad]; () if it is unknown.
    """

    X_WB: SE3
    source: Source
    covariance: tuple[float, ...] = ()


class Sighting(msgspec.Struct, frozen=True, kw_only=True):
    """One object seen by the head camera."""

    id: str
    X_CO: SE3


class Sightings(Message, frozen=True, kw_only=True):
    """What the head camera sees in one frame; what should be seen and is not is the model's."""

    objects: tuple[Sighting, ...]
    people: tuple[Sighting, ...] = ()
    source: Source = "oracle"


# --- the world ---------------------------------------------------------------------------------


class Piece(msgspec.Struct, frozen=True, kw_only=True):
    """A part of a shape, sized as one; `is_held`: a hand may close on it."""

    kind: Literal["box", "cylinder"]
    size_m: Vector3
    X_ShapePiece: SE3 = SE3()
    is_held: bool = True

    @property
    def radius_m(self) -> float:
        """From the shape's axis to what of the piece is furthest away, as it is not turned."""
        x, y, _ = self.X_ShapePiece.p
        if self.kind == "cylinder":
            return math.hypot(x, y) + 0.5 * self.size_m[0]
        return math.hypot(abs(x) + 0.5 * self.size_m[0], abs(y) + 0.5 * self.size_m[1])


INSIDE_M = 0.002
"""What reaches no further out of a shape does not stick out of it."""


class Shape(msgspec.Struct, frozen=True, kw_only=True):
    """A primitive: `size_m` is (x, y, z) of a box, (diameter, diameter, height) of a cylinder.

    `pieces` are its form where that is known more exactly: neck and belly of a bottle, a cup's
    handle, which sticks out of the primitive. Its foot and its top are the primitive's.
    """

    kind: Literal["box", "cylinder"]
    size_m: Vector3
    X_BodyShape: SE3 = SE3()
    pieces: tuple[Piece, ...] = ()

    @property
    def held_pieces(self) -> tuple[Piece, ...]:
        """What a hand may close on: all of it, where its form is not known."""
        whole = Piece(kind=self.kind, size_m=self.size_m)
        return tuple(piece for piece in self.pieces or (whole,) if piece.is_held)

    @property
    def sticking_out(self) -> tuple[Piece, ...]:
        """Pieces that are not inside the primitive."""
        x, y, _ = self.size_m
        return tuple(
            piece
            for piece in self.pieces
            if abs(piece.X_ShapePiece.p[0]) + 0.5 * piece.size_m[0] > 0.5 * x + INSIDE_M
            or abs(piece.X_ShapePiece.p[1]) + 0.5 * piece.size_m[1] > 0.5 * y + INSIDE_M
        )

    @property
    def is_round(self) -> bool:
        """Whether it is the same from all sides."""
        upright = (
            piece.kind == "cylinder" and piece.X_ShapePiece.p[:2] == (0.0, 0.0)
            for piece in self.pieces
        )
        return self.kind == "cylinder" and all(upright)

    @property
    def radius_m(self) -> float:
        """Of the upright cylinder about its axis that holds all of it."""
        x, y, _ = self.size_m
        own = 0.5 * x if self.kind == "cylinder" else 0.5 * math.hypot(x, y)
        reaches = [piece.radius_m for piece in self.pieces]
        return max([own, *reaches])


class Obstacle(msgspec.Struct, frozen=True, kw_only=True):
    """A rigid body that does not move by itself: furniture, walls, people's outlines."""

    id: str
    name: str
    X_WO: SE3
    shapes: tuple[Shape, ...]
    movable: bool = False


class Place(msgspec.Struct, frozen=True, kw_only=True):
    """A surface that things are put on: a rectangle with its centre and axes X_WP, z up.

    `size_m` its extent along x and y; `clearance_m` the free height above it; `of` the furniture.
    `floor` places (rooms, spots) are walked to and have no surface. `kind` is the sort of furniture
    ("table", "chair"), empty where nobody said.
    """

    id: str
    name: str
    X_WP: SE3
    size_m: tuple[float, float]
    clearance_m: float = 2.0
    of: str = ""
    room: str = ""
    floor: bool = False
    synonyms: tuple[str, ...] = ()
    kind: str = ""

    def samples(self) -> NDArray[np.float64]:
        """Points spread over the surface [m], shape (n, 3) in W; `Looked` is about each of them."""
        grid = [
            (np.arange(count) + 0.5) / count - 0.5
            for count in (max(1, math.ceil(size / SAMPLE_M)) for size in self.size_m)
        ]
        x, y = np.meshgrid(grid[0] * self.size_m[0], grid[1] * self.size_m[1], indexing="ij")
        points_P = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
        return points_P @ self.X_WP.rotation().T + np.array(self.X_WP.p)


class Looked(msgspec.Struct, frozen=True, kw_only=True):
    """When each of a surface's `samples` was last seen well [s], -inf: never, in their order."""

    place_id: str
    seen_s: tuple[float, ...]


class ObjectInfo(msgspec.Struct, frozen=True, kw_only=True):
    """What is known of an object before it is seen (from the world file: an oracle's knowledge)."""

    id: str
    name: str
    category: str
    color: str
    shape: Shape
    mass_kg: float
    synonyms: tuple[str, ...] = ()

    @property
    def plain_name(self) -> str:
        """The name without the colour in front of it: "cup" of a "red cup"."""
        plain = self.name.removeprefix(f"{self.color} ") if self.color else self.name
        return plain or self.name

    def told(self) -> ObjectInfo:
        """As it is known by its name alone: as large and heavy as such things usually are."""
        known = usual(self.category)
        shape = Shape(kind=known.kind, size_m=known.size_m)
        return msgspec.structs.replace(self, shape=shape, mass_kg=known.mass_kg)

    @property
    def full_name(self) -> str:
        """What it is called on screen: "the red cup"."""
        return f"the {self.color} {self.plain_name}" if self.color else f"the {self.plain_name}"


PERSON_RADIUS_M = 0.25
"""Of somebody's outline, where nobody says otherwise [m]."""


class PersonInfo(msgspec.Struct, frozen=True, kw_only=True):
    """A person as the world file gives them."""

    id: str
    name: str
    X_WO: SE3
    radius_m: float = PERSON_RADIUS_M


class WorldMap(Message, frozen=True, kw_only=True):
    """The prior map: what does not change by itself. Until there is SLAM it is the world file's."""

    name: str
    obstacles: tuple[Obstacle, ...]
    places: tuple[Place, ...]
    objects: tuple[ObjectInfo, ...]
    people: tuple[PersonInfo, ...]
    categories: dict[str, str]
    bounds_m: tuple[float, float, float, float]
    start_X_WS: SE3 = SE3()
    source: Source = "oracle"

    def told(self) -> WorldMap:
        """The same without what only eyes and hands can know of objects: their forms and masses."""
        return msgspec.structs.replace(self, objects=tuple(one.told() for one in self.objects))

    def object(self, object_id: str) -> ObjectInfo | None:
        """The object with an id."""
        return next((item for item in self.objects if item.id == object_id), None)

    def place(self, place_id: str) -> Place | None:
        """The place with an id."""
        return next((item for item in self.places if item.id == place_id), None)

    def person(self, person_id: str) -> PersonInfo | None:
        """The person with an id."""
        return next((item for item in self.people if item.id == person_id), None)


class Track(msgspec.Struct, frozen=True, kw_only=True):
    """Where an object is believed to be.

    `seen_s` is when it was last seen (-inf: never, then X_WO is None); `missing` is set when its
    place was in clear view and it was not there; `held_by` while a hand has it.
    """

    id: str
    X_WO: SE3 | None
    seen_s: float
    missing: bool = False
    held_by: Side | None = None


class WorldState(Message, frozen=True, kw_only=True):
    """The world model: localisation and everything tracked.

    `X_WN` takes the controller's odometry frame to the world: `X_WB = X_WN @ X_NB`.
    `fix_age_s` is the age of the last fix that was believed; `jumps` counts how often the estimate
    of X_WN had to be thrown over. `unmapped` is what the sensors see and the map does not explain.
    `people` are tracked like objects; one not seen yet (`seen_s` -inf) is where the map says.
    `looked` is what of the surfaces has been in view, near enough and with nothing before it.
    `covariance`, row by row, is of the errors of the base's x, y [m] and heading [rad], () where it
    is unknown; `lost` says why the robot does not know where it is, "" while it does.
    """

    X_WN: SE3
    X_WB: SE3
    fix_age_s: float
    tracks: tuple[Track, ...]
    people: tuple[Track, ...] = ()
    unmapped: tuple[Obstacle, ...] = ()
    looked: tuple[Looked, ...] = ()
    jumps: int = 0
    source: Source = "oracle"
    covariance: tuple[float, ...] = ()
    lost: str = ""
