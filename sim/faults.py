"""What can be done to a running world: pushes, things that move or vanish, senses that fail.

Faults are values; a benchmark, a test or a person sends one, the plant suffers it. They reach the
robot through physics and sensors only. As plain data, in files and at the prompt, a fault is a
dict with its name under `fault`: ``{"fault": "push", "impulse_n_s": [0, 4, 0]}``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, get_args

import msgspec

from robot.bus.topics import TOPICS
from robot.config import nearest
from robot.drivers.registry import SENSES
from robot.errors import ConfigError, Problem
from robot.model.description import RobotDescription
from robot.se3 import SE3, Vector3
from sim import atlas
from sim.schema import World

if TYPE_CHECKING:
    from sim.plant import Plant

SENSORS: dict[str, tuple[str, ...]] = {
    "camera": ("sensors/depth", "oracle/sightings"),
    "lidar": ("sensors/lidar",),
    "localisation": ("oracle/fix",),
}
"""A sensor to the topics that fall silent with it."""
SENT = [
    *(topic.name for topic in TOPICS if topic.source == "plant"),
    *(sense.topic.name for sense in SENSES),
]
"""What a plant sends, or the drivers of its sensors publish."""


def _name(kind: str) -> str:
    """`StandInWay` to `stand_in_way`."""
    return "".join(f"_{c.lower()}" if c.isupper() else c for c in kind).lstrip("_")


class _Fault(
    msgspec.Struct, frozen=True, kw_only=True, tag=_name, tag_field="fault",
    forbid_unknown_fields=True,
):  # fmt: skip
    """A fault; it begins when it is applied."""


class Push(_Fault, frozen=True, kw_only=True):
    """A force on the robot's torso, or on an object, a piece of furniture, or a body by name.

    `impulse_n_s` in the world's axes, spread evenly over `duration_s`. A push down on a held
    object pulls it out of the hand.
    """

    impulse_n_s: Vector3
    target: str = "robot"
    duration_s: float = 0.1


class Shove(_Fault, frozen=True, kw_only=True):
    """A level push on the robot's torso of `strength_n_s`, towards an angle from where it faces.

    0 degrees pushes it forwards, 90 to its left.
    """

    strength_n_s: float
    towards_deg: float = 0.0
    duration_s: float = 0.1


class KnockOver(_Fault, frozen=True, kw_only=True):
    """An object is hit at its rim and goes over, towards an angle of the world."""

    target: str
    towards_deg: float = 0.0


class Move(_Fault, frozen=True, kw_only=True):
    """An object, a person or a movable piece of furniture is suddenly elsewhere, at rest.

    `X_WO` says where, or `by_m` how far from where it is.
    """

    target: str
    X_WO: SE3 | None = None
    by_m: Vector3 | None = None

    def __post_init__(self) -> None:
        """Check that there is one destination."""
        if (self.X_WO is None) == (self.by_m is None):
            raise ValueError("give exactly one of X_WO, by_m")


class Occupy(_Fault, frozen=True, kw_only=True):
    """Another object suddenly stands on a place, at `at_m` from the middle of it."""

    place: str
    target: str
    at_m: tuple[float, float] = (0.0, 0.0)


class StandInWay(_Fault, frozen=True, kw_only=True):
    """Somebody, or a chair, stands in the way for `duration_s`, then where it was again.

    That is before the robot, or at a point of the floor.
    """

    target: str
    ahead_m: float = 0.9
    left_m: float = 0.0
    at_m: tuple[float, float] | None = None
    duration_s: float = math.inf


class Remove(_Fault, frozen=True, kw_only=True):
    """An object or a person is suddenly gone."""

    target: str


class Silence(_Fault, frozen=True, kw_only=True):
    """A sensor (`camera`), or one topic (`sensors/depth`), says nothing for `duration_s`."""

    topic: str
    duration_s: float = math.inf


class Mislead(_Fault, frozen=True, kw_only=True):
    """The oracle's fixes of the robot's pose are off for `duration_s`."""

    by_m: tuple[float, float]
    by_deg: float = 0.0
    duration_s: float = math.inf


class Heat(_Fault, frozen=True, kw_only=True):
    """A motor's winding is suddenly that hot; it cools down as it does."""

    motor: str
    temperature_c: float


class Discharge(_Fault, frozen=True, kw_only=True):
    """The emulated battery is suddenly left with that part of its charge."""

    charge: float

    def __post_init__(self) -> None:
        """Check the range."""
        if not 0.0 <= self.charge <= 1.0:
            raise ValueError(f"charge is a part, 0 to 1, not {self.charge}")


class MotorOff(_Fault, frozen=True, kw_only=True):
    """One motor no longer obeys: it damps, whatever it is told (`off=False`: it obeys again)."""

    motor: str
    off: bool = True


class Kill(_Fault, frozen=True, kw_only=True):
    """A process dies. The runtime does this, not the plant."""

    process: Literal["controller", "perception"]


Fault = (
    Push | Shove | KnockOver | Move | Occupy | StandInWay | Remove | Silence | Mislead | Heat
    | Discharge | MotorOff | Kill
)  # fmt: skip
KINDS: dict[str, type[_Fault]] = {_name(kind.__name__): kind for kind in get_args(Fault)}
"""Name to fault."""


def parse(data: Mapping[str, Any]) -> Fault:
    """A fault out of plain data.

    Raises:
        ConfigError: if it is none, with the nearest name of a fault or of a key.
    """
    name = str(data.get("fault", ""))
    _check(name, list(KINDS), "fault")
    keys = [field.name for field in msgspec.structs.fields(KINDS[name])]
    for key in data:
        if key != "fault":
            _check(key, keys, f"key of the fault {name!r}:")
    try:
        return msgspec.convert(dict(data), Fault)  # pyright: ignore[reportArgumentType, reportReturnType]
    except msgspec.ValidationError as error:
        raise ConfigError(f"the fault {name!r}: {error}") from None


def verify(data: Mapping[str, Any], world: World, robot: RobotDescription) -> Fault:
    """A fault out of plain data, with every name in it checked, before there is a plant.

    Raises:
        ConfigError: as `parse` does, or for a name that is not there, with the nearest one.
    """
    fault = parse(data)
    objects = [item.id for item in world.objects]
    bodies = ["robot", *objects, *(item.id for item in (*world.furniture, *world.people))]
    known = {
        "target": objects if isinstance(fault, KnockOver | Occupy) else bodies,
        "place": list(atlas.places(world)),
        "motor": list(robot.motor_names),
        "topic": [*SENSORS, *SENT],
    }
    for field, valid in known.items():
        name = getattr(fault, field, None)
        if name is not None:
            _check(name, valid, field)
    return fault


def apply(plant: Plant, fault: Fault) -> None:
    """Make a fault happen now.

    Raises:
        ConfigError: if it names what is not there, with the nearest name that is.
    """
    match fault:
        case Push() | Shove() | KnockOver():
            _push(plant, fault)
        case Move() | Occupy() | StandInWay() | Remove():
            _put(plant, fault)
        case Silence():
            topics = SENSORS.get(fault.topic, (fault.topic,))
            for topic in topics:
                _check(topic, [*plant.sensing.topics(), *SENSORS], "topic")
                plant.sensing.silence(topic, plant.time_s + fault.duration_s)
        case Mislead():
            X = SE3.from_xy_yaw(*fault.by_m, math.radians(fault.by_deg))
            plant.oracle.mislead(X, until_s=plant.time_s + fault.duration_s)
        case Heat() | MotorOff():
            names = list(plant.robot.motor_names)
            _check(fault.motor, names, "motor")
            index = names.index(fault.motor)
            if isinstance(fault, Heat):
                plant.motors.temperature_c[index] = fault.temperature_c
            else:
                plant.motors.set_off(index, off=fault.off)
        case Discharge():
            if plant.battery is None:
                raise ConfigError(f"the robot {plant.robot.name!r} describes no battery")
            plant.battery.charge = fault.charge
        case Kill():
            raise ConfigError(f"the {fault.process} is not the plant's; the runtime kills it")


def _push(plant: Plant, fault: Push | Shove | KnockOver) -> None:
    match fault:
        case Push():
            force = tuple(value / fault.duration_s for value in fault.impulse_n_s)
            plant.pull(_body(plant, fault.target), force, duration_s=fault.duration_s)
        case Shove():
            towards_rad = plant.oracle.X_WB().yaw_rad + math.radians(fault.towards_deg)
            plant.push(fault.strength_n_s, towards_rad, duration_s=fault.duration_s)
        case KnockOver():
            plant.tip(_object(plant, fault.target), math.radians(fault.towards_deg))


def _put(plant: Plant, fault: Move | Occupy | StandInWay | Remove) -> None:
    match fault:
        case Move():
            body = _body(plant, fault.target)
            plant.put(body, fault.X_WO or _shifted(plant.where(body), fault.by_m))
        case Occupy():
            body, places = _object(plant, fault.target), plant.places()
            _check(fault.place, list(places), "place")
            height_m = next(o.size_m[2] for o in plant.world.objects if o.id == fault.target)
            X_PO = SE3((*fault.at_m, height_m / 2 + 0.002))
            plant.put(body, places[fault.place].X_WP @ X_PO)
        case StandInWay():
            body = _body(plant, fault.target)
            before = plant.where(body)
            X_WB = plant.oracle.X_WB().flat()
            X_there = X_WB @ SE3.from_xy_yaw(fault.ahead_m, fault.left_m, math.pi)
            if fault.at_m is not None:
                X_there = SE3.from_xy_yaw(*fault.at_m, X_there.yaw_rad)
            plant.put(body, _shifted(X_there, (0.0, 0.0, before.p[2])))
            if math.isfinite(fault.duration_s):
                plant.after(fault.duration_s, lambda: plant.put(body, before))
        case Remove():
            names = [item.id for item in plant.world.objects]
            row = names.index(fault.target) if fault.target in names else len(names)
            away = SE3((FAR_AWAY_M, FAR_AWAY_M / 2 + row, 1.0))
            plant.put(_body(plant, fault.target), away)


FAR_AWAY_M = 60.0


def _shifted(X_WO: SE3, by_m: Vector3 | None) -> SE3:
    x, y, z = (a + b for a, b in zip(X_WO.p, by_m or (0.0, 0.0, 0.0), strict=True))
    return SE3((x, y, z), X_WO.quat_wxyz)


def _object(plant: Plant, target: str) -> str:
    """The MuJoCo body of an object."""
    _check(target, [item.id for item in plant.world.objects], "object")
    return f"object/{target}"


def _body(plant: Plant, target: str) -> str:
    """The MuJoCo body that a target means."""
    world = plant.world
    bodies = {"robot": plant.robot.torso_body}
    bodies |= {item.id: f"object/{item.id}" for item in world.objects}
    bodies |= {item.id: f"furniture/{item.id}" for item in world.furniture}
    bodies |= {item.id: f"person/{item.id}" for item in world.people}
    if target in bodies:
        return bodies[target]
    known = [plant.model.body(index).name for index in range(plant.model.nbody)]
    _check(target, [*bodies, *known], "body")
    return target


def _check(name: str, valid: list[str], what: str) -> None:
    if name not in valid:
        raise ConfigError([Problem(f"unknown {what} {name!r}", suggestion=nearest(name, valid))])
