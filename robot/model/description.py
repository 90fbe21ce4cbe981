"""All that the code knows of a robot: a YAML file beside an MJCF."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Literal

import msgspec

from robot import config
from robot.errors import ConfigError, Problem
from robot.messages import Side


class Motor(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One motor: its joint in the MJCF and what it may do.

    `kp`, `kd` are the position gains used where no controller asks for others; `source` says where
    the limits come from (a datasheet, a measurement, a design choice).
    """

    joint: str
    torque_limit_nm: float
    velocity_limit_rad_s: float
    kp: float
    kd: float
    source: str


class Foot(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A foot: its body, the site at the centre of its sole (x forward, z up), the sole's extent."""

    body: str
    sole_site: str
    half_length_m: float
    half_width_m: float
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
    opening_per_motor: float
    max_opening_m: float
    max_force_n: float
    mass_kg: float
    force_sensor: str
    torque_sensor: str
    finger_bodies: tuple[str, ...]


class Imu(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The inertial measurement unit: its site and sensors, and its noise (1 sigma)."""

    site: str
    gyro: str
    accelerometer: str
    gyro_noise_rad_s: float
    accel_noise_m_s2: float


class Camera(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The head's RGB-D camera; its site is C (OpenCV: x right, y down, z forward)."""

    camera: str
    site: str
    width: int
    height: int
    fovy_rad: float
    range_m: float


class Lidar(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The planar lidar; beams in its site's x-y plane."""

    site: str
    beams: int
    range_m: float


class Battery(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the robot lives on: capacity, and what draws on it (`sim.battery` emulates it).

    `idle_w` is drawn always, `efficiency` is that of the motors' mechanical work, `stall_w`
    the heat of one motor that holds its torque limit at rest.
    """

    capacity_wh: float
    idle_w: float
    efficiency: float
    stall_w: float
    source: str


class Sensors(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Every sensor besides the motors' own encoders."""

    imu: Imu
    camera: Camera
    lidar: Lidar
    encoder_noise_rad: float


class Walking(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Gait of this body: see robot/control/walking."""

    base_height_m: float
    stance_width_m: float
    min_stance_width_m: float
    single_support_s: float
    double_support_s: float
    step_height_m: float
    max_step_length_m: float
    max_step_width_m: float
    max_step_turn_rad: float
    max_forward_m_s: float
    max_backward_m_s: float
    max_sideways_m_s: float
    max_turn_rad_s: float


class Keyframe(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One stage of a motion: the joints named move to their values, the others stay.

    `duration_s` is the least it takes (the joints' speed may ask for more), `hold_s` how long it
    then rests. With `needs` it begins only if the trunk is so by then; else the motion is missed.
    """

    name: str
    duration_s: float
    posture: dict[str, float]
    hold_s: float = 0.0
    needs: Literal["front", "upright"] | None = None


class Motions(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What gets it up, by how it lies.

    From the `front` into a squat on both soles; over its `left` or `right` side onto the front.
    From the back it goes over the side that is lower.
    """

    front: tuple[Keyframe, ...]
    left: tuple[Keyframe, ...]
    right: tuple[Keyframe, ...]


class GettingUp(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How the robot gets up from the floor: with at most so many motions."""

    tries: int
    motions: Motions


class RobotDescription(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A humanoid: joint groups, limits, feet, hands, sensors, postures.

    `drivers` names what moves and senses it, by device (`robot.drivers.registry`); one that is not
    named is simulated.
    """

    name: str
    mjcf: str
    base_body: str
    torso_body: str
    motors: dict[str, Motor]
    groups: dict[str, tuple[str, ...]]
    feet: dict[Side, Foot]
    hands: dict[Side, Hand]
    sensors: Sensors
    walking: Walking
    postures: dict[str, dict[str, float]]
    shoulder_height_m: float
    body_radius_m: float
    battery: Battery | None = None
    getting_up: GettingUp | None = None
    drivers: dict[str, str] = {}
    folder: str = ""
    file: str = ""

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

    def mjcf_path(self) -> Path:
        """Where the MJCF lies."""
        return Path(self.folder) / self.mjcf

    def posture(self, name: str) -> tuple[float, ...]:
        """Joint values of a named posture in motor order; `nominal` fills what it leaves out."""
        values = {**self.postures["nominal"], **self.postures[name]}
        return tuple(values.get(motor, 0.0) for motor in self.motors)


def load(name_or_path: str = "juno") -> RobotDescription:
    """Load a shipped robot by name, or any robot by the path of its YAML file.

    Raises:
        ConfigError: if there is no such robot or the file is wrong (file, line, nearest name).
    """
    path = Path(name_or_path)
    if path.suffix not in (".yaml", ".yml"):
        shipped = Path(str(resources.files("robot.model")))
        path = shipped / name_or_path / f"{name_or_path}.yaml"
        if not path.exists():
            names = sorted(entry.parent.name for entry in shipped.glob("*/*.yaml"))
            hint = config.nearest(name_or_path, names)
            raise ConfigError([Problem(f"unknown robot {name_or_path!r}", suggestion=hint)])
    description = config.load(path, RobotDescription)
    description = msgspec.structs.replace(description, folder=str(path.parent), file=path.name)
    _check(description, str(path))
    return description


def _check(description: RobotDescription, file: str) -> None:
    """Names inside the file must point at each other."""
    motors = list(description.motors)
    problems: list[Problem] = []

    def want(name: str, where: str) -> None:
        if name not in motors:
            hint = config.nearest(name, motors)
            problems.append(
                Problem(f"{where} names motor {name!r}, not in motors", file, suggestion=hint)
            )

    needed = ("left_leg", "right_leg", "waist", "head", "left_arm", "right_arm")
    for group in needed:
        if group not in description.groups:
            hint = f"every robot has the groups {', '.join(needed)}"
            problems.append(Problem(f"joint group {group!r} is missing", file, suggestion=hint))
    for group, names in description.groups.items():
        for name in names:
            want(name, f"group {group!r}")
    for side, hand in description.hands.items():
        want(hand.motor, f"{side} hand")
    if "nominal" not in description.postures:
        problems.append(Problem("posture 'nominal' is missing", file))
    for posture, values in description.postures.items():
        for name in values:
            want(name, f"posture {posture!r}")
    for keyframe in _keyframes(description):
        for name in keyframe.posture:
            want(name, f"keyframe {keyframe.name!r}")
    if problems:
        raise ConfigError(problems)


def _keyframes(description: RobotDescription) -> tuple[Keyframe, ...]:
    """Every keyframe of getting up, if it knows how."""
    if description.getting_up is None:
        return ()
    motions = description.getting_up.motions
    return (*motions.front, *motions.left, *motions.right)
