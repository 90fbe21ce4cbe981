"""All that the code knows of a robot: a YAML file beside an MJCF."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, get_args

import msgspec

from robot.errors import ConfigError, DescriptionError, Problem
from robot.files import config
from robot.files import quantities as q
from robot.messages import Side
from robot.model.gait import Balance, Walking
from robot.model.handling import Arms, Handling, Signs
from robot.model.keyframes import GettingUp
from robot.model.ownership import BusOwner
from robot.model.paces import Paces
from robot.model.published import Published

if TYPE_CHECKING:
    from robot.model import mjcf

SHIPPED = Path(str(resources.files("robot.model"))).resolve()
"""Where the robots are that come with the project."""


class Motor(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One motor: its joint in the MJCF and what it may do.

    `kp`, `kd` are the position gains used where no controller asks for others; `source` says where
    the limits come from (a datasheet, a measurement, a design choice).
    """

    joint: str
    torque_limit_nm: q.Torque
    velocity_limit_rad_s: q.TurnRate
    kp: q.PositionGain
    kd: q.VelocityGain
    source: str


class Foot(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A foot: its body, the site at the centre of its sole (x forward, z up), the sole's extent."""

    body: str
    sole_site: str
    half_length_m: q.Length
    half_width_m: q.Length
    force_sensor: str
    torque_sensor: str


class Hand(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A hand with two parallel fingers.

    The grasp site G has x along the approach (palm to fingertips) and y along the closing
    direction. `opening_per_motor` turns the motor's travel into the opening between the pads.
    """

    body: str
    grasp_site: str
    motor: str
    opening_per_motor: q.Ratio
    max_opening_m: q.Length
    max_force_n: q.Force
    mass_kg: q.Mass
    force_sensor: str
    torque_sensor: str
    finger_bodies: tuple[str, ...]


class Imu(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The inertial measurement unit: its site and sensors, and its noise (1 sigma)."""

    site: str
    gyro: str
    accelerometer: str
    gyro_noise_rad_s: q.TurnNoise
    accel_noise_m_s2: q.AccelerationNoise


class Picture(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the head's camera gives as a whole (`robot.messages.RgbdImage`).

    Attributes:
        width, height: in pixels.
        rate_hz: most pictures a second.
        depth_range_m: depth is measured up to there.
        source: of these figures and of the camera's field of view.
    """

    width: q.Pixels
    height: q.Pixels
    rate_hz: q.Rate
    depth_range_m: q.Sight
    source: str


class Camera(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The head's RGB-D camera; its site is C (OpenCV: x right, y down, z forward).

    `width`, `height` and `range_m` are of the coarse depth that perception looks at all the time;
    `fovy_rad`, the vertical field of view, is of its pictures as well. Where nothing is said of
    pictures they are like that depth.
    """

    camera: str
    site: str
    width: q.Pixels
    height: q.Pixels
    fovy_rad: q.View
    range_m: q.Sight
    picture: Picture | None = None

    def pictures(self) -> Picture:
        """What its pictures are like."""
        return self.picture or Picture(
            width=self.width,
            height=self.height,
            rate_hz=10.0,
            depth_range_m=self.range_m,
            source="the coarse depth",
        )


class Lidar(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The planar lidar; beams in its site's x-y plane."""

    site: str
    beams: q.Beams
    range_m: q.Sight


class Gaze(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Turning the camera towards a point.

    Attributes:
        rate_rad_s: of the neck's joints.
        done_rad: how near they are to come to where they should be.
        waist_yaw_rad: most that a robot without a neck turns its waist to a side to see.
        waist_pitch_rad: the same, backward (negative) and forward.
        eye_m: height that it looks at when it looks straight ahead.
        nod_m, shake_rad: of a nod up and down at 1.5 m ahead, of shaking the head to either side.
        around_rad: headings that a look around rests at, from straight ahead.
    """

    rate_rad_s: q.TurnRate
    done_rad: q.Turn
    eye_m: q.Length
    nod_m: q.Length
    shake_rad: q.Turn
    waist_yaw_rad: q.Turn = 0.0
    waist_pitch_rad: tuple[q.Angle, q.Angle] = (0.0, 0.0)
    around_rad: q.Several[q.Angle]


class Heating(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How the motors' windings warm up, first order (`sim.motors` emulates it).

    A motor that gives `continuous_share` of its peak torque for ever ends up `rise_k` warmer than
    the air.
    """

    rise_k: q.Warming
    continuous_share: q.Share
    time_constant_s: q.ThermalTime
    source: str


class Battery(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the robot lives on: capacity, and what draws on it (`sim.battery` emulates it).

    `idle_w` is drawn always, `efficiency` is that of the motors' mechanical work, `stall_w`
    the heat of one motor that holds its torque limit at rest.
    """

    capacity_wh: q.Energy
    idle_w: q.Power
    efficiency: q.Share
    stall_w: q.Power
    source: str


class Sensors(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Every sensor besides the motors' own encoders."""

    imu: Imu
    camera: Camera
    lidar: Lidar
    encoder_noise_rad: q.AngleNoise


class RobotDescription(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A humanoid: joint groups, limits, feet, hands, sensors, postures.

    `drivers` names what moves and senses it, by device (`robot.drivers.registry`); one that is not
    named is simulated. `bus_owner` says whether a process of its own commands the motors
    (`robot.owner`).

    What is left out and 0 here is measured at its model when it is loaded: height of the shoulders
    above the floor, standing, and their distance from the middle; length of a stretched arm, from
    the shoulder to the grasp point; radius of the circle about the feet that holds the body and its
    arms; how far the neck turns to the nearer side (0 of a robot without one).
    """

    name: q.Line
    mjcf: q.Line
    base_body: str
    torso_body: str
    motors: dict[str, Motor]
    groups: dict[str, tuple[str, ...]]
    feet: dict[Side, Foot]
    hands: dict[Side, Hand]
    sensors: Sensors
    walking: Walking
    balance: Balance
    arms: Arms
    gaze: Gaze
    paces: Paces
    postures: dict[str, dict[str, q.Joint]]
    shoulder_height_m: q.Margin = 0.0
    shoulder_aside_m: q.Margin = 0.0
    arm_reach_m: q.Margin = 0.0
    body_radius_m: q.Margin = 0.0
    neck_rad: q.Angle = 0.0
    heating: Heating
    overlay: str | None = None
    published: Published | None = None
    handling: Handling | None = None
    signs: Signs | None = None
    battery: Battery | None = None
    getting_up: GettingUp | None = None
    drivers: dict[str, str] = {}
    bus_owner: BusOwner | None = None
    folder: str = ""
    file: str = ""
    mjcf_folder: str = ""

    @property
    def motor_names(self) -> tuple[str, ...]:
        """Names in motor order, which every array of joint values follows."""
        return tuple(self.motors)

    def indices(self, group: str) -> list[int]:
        """Motor indices of a joint group, in the group's order."""
        names = self.motor_names
        return [names.index(name) for name in self.groups[group]]

    def path(self) -> Path:
        """Where the description lies."""
        return Path(self.folder) / self.file

    def driven_by(self, motors: str) -> RobotDescription:
        """The same with another driver of its motors; "" leaves the one that it names."""
        if not motors:
            return self
        return msgspec.structs.replace(self, drivers={**self.drivers, "motors": motors})

    @property
    def arm_sides(self) -> tuple[Side, ...]:
        """The arms that it has, left first; each may or may not have a hand."""
        sides: tuple[Side, Side] = ("left", "right")
        return tuple(side for side in sides if self.groups[f"{side}_arm"])

    @property
    def handy(self) -> Handling:
        """What the hands are good for.

        Raises:
            DescriptionError: if the robot has none.
        """
        if self.handling is None:
            raise DescriptionError(f"{self.name} has no hands")
        return self.handling

    def mjcf_path(self) -> Path:
        """Where the MJCF lies."""
        return Path(self.mjcf_folder or self.folder) / self.mjcf

    @property
    def source(self) -> mjcf.Source:
        """Where the model comes from."""
        from robot.model import mjcf

        overlay = None if self.overlay is None else str(Path(self.folder) / self.overlay)
        without = () if self.published is None else self.published.without
        folder = self.mjcf_folder or self.folder
        return mjcf.Source(
            str(self.mjcf_path()), folder, overlay, overlay_folder=self.folder, without=without
        )

    def digest(self) -> bytes:
        """SHA-256 of the description and its MJCF, wherever they lie, 32 bytes."""
        placeless = msgspec.structs.replace(self, folder="", file="", mjcf_folder="")
        return hashlib.sha256(msgspec.json.encode(placeless) + self.source.content()).digest()

    def posture(self, name: str) -> tuple[float, ...]:
        """Joint values of a named posture in motor order; `nominal` fills what it leaves out."""
        values = {**self.postures["nominal"], **self.postures[name]}
        return tuple(values.get(motor, 0.0) for motor in self.motors)


def shipped() -> list[str]:
    """Names of the robots that come along."""
    found = SHIPPED.glob("*/*.yaml")
    return sorted(entry.stem for entry in found if entry.stem == entry.parent.name)


def load(name_or_path: str = "juno") -> RobotDescription:
    """Load a shipped robot by name, or any robot by the path of its YAML file.

    Raises:
        ConfigError: if there is no such robot, the file is wrong (file, line, nearest name), or a
            published model that it names is not on this machine.
    """
    path = Path(name_or_path)
    if not config.names_file(name_or_path):
        if name_or_path not in shipped():
            hint = config.nearest(name_or_path, shipped())
            raise ConfigError([Problem(f"unknown robot {name_or_path!r}", suggestion=hint)])
        path = SHIPPED / name_or_path / f"{name_or_path}.yaml"
    description = config.load(path, RobotDescription)
    published, mjcf_folder = description.published, path.parent
    if published is not None:
        mjcf_folder = published.find(description.mjcf, description=path)
    description = msgspec.structs.replace(
        description, folder=str(path.parent), file=path.name, mjcf_folder=str(mjcf_folder)
    )
    _check(description, str(path))
    if not _shipped(description):
        from robot.model import trial

        trial.check(description.source)
    return _measured(description)


def _shipped(description: RobotDescription) -> bool:
    """Whether its model is as trusted as this code: named by a description of ours, or the same."""
    if SHIPPED in description.path().resolve().parents:
        return True
    if description.overlay is not None:
        return False
    content = description.source.content()
    return any(content == path.read_bytes() for path in SHIPPED.glob("*/*.xml"))


def _measured(description: RobotDescription) -> RobotDescription:
    """With what is left out of the file and can be seen at the model."""
    from robot.model import measures, mjcf

    model = mjcf.compiled(description.source)
    joints = {name: motor.joint for name, motor in description.motors.items()}
    arms = [
        measures.Arm(
            joints=tuple(joints[name] for name in description.groups[f"{side}_arm"]),
            tip=description.hands[side].grasp_site if side in description.hands else "",
        )
        for side in description.arm_sides
    ]
    nominal = zip(joints.values(), description.posture("nominal"), strict=True)
    soles = [foot.sole_site for foot in description.feet.values()]
    neck = next((joints[name] for name in description.groups["head"]), "")
    try:
        found = measures.measure(model, dict(nominal), arms=arms, soles=soles, neck=neck)
    except KeyError:
        return description  # a name is not in the MJCF: BodyModel says which, with all others
    return msgspec.structs.replace(
        description,
        shoulder_aside_m=description.shoulder_aside_m or found.shoulder_aside_m,
        shoulder_height_m=description.shoulder_height_m or found.shoulder_height_m,
        arm_reach_m=description.arm_reach_m or found.arm_reach_m,
        body_radius_m=description.body_radius_m or found.body_radius_m,
        neck_rad=description.neck_rad or found.neck_rad,
    )


GROUPS = ("left_leg", "right_leg", "waist", "head", "left_arm", "right_arm")


def _check(description: RobotDescription, file: str) -> None:
    """Names inside the file must point at each other."""
    motors = list(description.motors)
    problems = [
        Problem(f"{where} names motor {name!r}, not in motors", file, suggestion=nearest)
        for where, name in _named_motors(description)
        if name not in motors
        for nearest in [config.nearest(name, motors)]
    ]
    others = (*_missing(description), *_doubled(description))
    problems += [Problem(message, file, suggestion=hint) for message, hint in others]
    if problems:
        raise ConfigError(problems)


def _named_motors(description: RobotDescription) -> Iterator[tuple[str, str]]:
    """Where a motor is named, and how."""
    for group, names in description.groups.items():
        yield from ((f"group {group!r}", name) for name in names)
    for side, hand in description.hands.items():
        yield f"{side} hand", hand.motor
    for posture, values in description.postures.items():
        yield from ((f"posture {posture!r}", name) for name in values)
    if description.getting_up is not None:
        motions = description.getting_up.motions
        for keyframe in (*motions.front, *motions.left, *motions.right):
            yield from ((f"keyframe {keyframe.name!r}", name) for name in keyframe.posture)


def _missing(description: RobotDescription) -> Iterator[tuple[str, str]]:
    """What is not there though it has to be, and a hint."""
    postures, groups = list(description.postures), description.groups
    for group in [group for group in GROUPS if group not in groups]:
        yield f"joint group {group!r} is missing", f"every robot has the groups {', '.join(GROUPS)}"
    for side in [side for side in get_args(Side) if side not in description.feet]:
        yield f"the {side} foot is missing", "a humanoid stands on two"
    if "nominal" not in postures:
        yield "posture 'nominal' is missing", "it is how the robot stands"
    for side in [side for side in description.hands if not groups.get(f"{side}_arm")]:
        yield f"there is a {side} hand, and no motor in {side}_arm", "name the arm's motors"
    if description.hands and description.handling is None:
        yield "there are hands, and no 'handling'", "say what they are good for, as juno.yaml does"
    signs = description.signs
    for posture in () if signs is None else (signs.raised, *signs.waving):
        if posture not in postures:
            yield f"signs name posture {posture!r}", config.nearest(posture, postures) or ""


def _doubled(description: RobotDescription) -> Iterator[tuple[str, str]]:
    """What may be there once only, and a hint."""
    joints = Counter(motor.joint for motor in description.motors.values())
    for joint in [joint for joint, count in joints.items() if count > 1]:
        yield f"joint {joint!r} has several motors", "each motor moves a joint of its own"
    named = {name: Counter(motors) for name, motors in description.groups.items()}
    for group, motors in named.items():
        for motor in [motor for motor, count in motors.items() if count > 1]:
            yield f"group {group!r} names motor {motor!r} more than once", "name it once"
    limbs = Counter(motor for group in GROUPS for motor in named.get(group, ()))
    for motor in [motor for motor, count in limbs.items() if count > 1]:
        yield f"motor {motor!r} is in several of the limbs", "a motor belongs to one of them"
