"""What faults (`robot.reality.faults`) do to a plant, and whether what they name is there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from robot.bus.topics import TOPICS
from robot.drivers.registry import SENSES
from robot.errors import ConfigError
from robot.model.description import RobotDescription
from robot.reality.faults import (
    BreakImu,
    CoverLidar,
    Delay,
    Discharge,
    Fault,
    Heat,
    Kidnap,
    Kill,
    KnockOver,
    Load,
    Mislead,
    MotorOff,
    Move,
    Occupy,
    OffsetImu,
    Push,
    Remove,
    Shove,
    Silence,
    Sill,
    Slope,
    StandInWay,
    check_name,
)
from robot.se3 import SE3, Vector3
from sim import atlas, furniture
from sim.bodies import BUMP, SILL, SILL_HALF_HEIGHT_M
from sim.flaws import ImuFlaws
from sim.world_schema import World

if TYPE_CHECKING:
    from sim.plant import Plant

SENSORS: dict[str, tuple[str, ...]] = {
    "camera": ("sensors/depth", "oracle/sightings"),
    "lidar": ("sensors/lidar",),
    "localisation": ("oracle/fix",),  # of a robot that is told where it is
}
"""A sensor to the topics that fall silent with it."""
SENT = [
    *(topic.name for topic in TOPICS if topic.source == "plant" and topic.rate_hz is not None),
    *(sense.topic.name for sense in SENSES),
]
"""What a plant sends, or the drivers of its sensors publish."""


def verify(fault: Fault, world: World, robot: RobotDescription) -> None:
    """Check every name in a fault, before there is a plant.

    Raises:
        ConfigError: for a name that is not there, with the nearest one.
    """
    objects = [item.id for item in world.objects]
    people = [item.id for item in world.people]
    loose = [item.id for item in world.furniture if furniture.movable(item)]
    bodies = ["robot", *objects, *(item.id for item in world.furniture), *people]
    if isinstance(fault, KnockOver | Occupy):
        targets = objects
    elif isinstance(fault, Push):
        targets = bodies
    else:  # what is put elsewhere must not stand fast
        targets = [*objects, *people, *loose]
    if isinstance(fault, Discharge) and robot.battery is None:
        raise ConfigError(f"the robot {robot.name!r} describes no battery")
    known = {
        "target": targets,
        "place": list(atlas.places(world)),
        "motor": list(robot.motor_names),
        "topic": [*SENSORS, *SENT],
    }
    for field, valid in known.items():
        name = getattr(fault, field, None)
        if name is not None:
            check_name(name, valid, field)


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
        case Silence() | Mislead() | CoverLidar():
            _deceive(plant, fault)
        case Kidnap():
            _kidnap(plant, fault)
        case OffsetImu() | BreakImu() | Sill() | Slope() | Load() | Delay():
            _worsen(plant, fault)
        case Heat() | MotorOff():
            names = list(plant.robot.motor_names)
            check_name(fault.motor, names, "motor")
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


def _deceive(plant: Plant, fault: Silence | Mislead | CoverLidar) -> None:
    match fault:
        case Silence():
            topics = SENSORS.get(fault.topic, (fault.topic,))
            for topic in topics:
                check_name(topic, [*plant.sending.topics(), *SENSORS], "topic")
                plant.sending.silence(topic, plant.time_s + fault.duration_s)
        case Mislead():
            X = SE3.from_xy_yaw(*fault.by_m, math.radians(fault.by_deg))
            plant.oracle.mislead(X, until_s=plant.time_s + fault.duration_s)
        case CoverLidar():
            lidar = plant.sending.lidar
            lidar.cover(math.radians(fault.width_deg), math.radians(fault.towards_deg))
            if math.isfinite(fault.duration_s):
                plant.after(fault.duration_s, lambda: lidar.cover(0.0, 0.0))


def _kidnap(plant: Plant, fault: Kidnap) -> None:
    """Move and turn the whole body about the vertical: on a level floor nothing else changes."""
    model, data = plant.model, plant.data
    joint = int(model.body_jntadr[model.body(plant.robot.base_body).id])
    at, moving = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
    X_WB, turn_rad = plant.oracle.X_WB(), math.radians(fault.turn_deg)
    by_x, by_y = fault.by_m or (0.0, 0.0)
    x, y = fault.at_m or (X_WB.p[0] + by_x, X_WB.p[1] + by_y)
    turn = SE3.from_xy_yaw(0.0, 0.0, turn_rad)
    there = turn @ SE3((0.0, 0.0, 0.0), X_WB.quat_wxyz)
    data.qpos[at : at + 7] = (x, y, X_WB.p[2], *there.quat_wxyz)
    data.qvel[moving : moving + 3] = turn.rotation() @ data.qvel[moving : moving + 3]


def _worsen(plant: Plant, fault: OffsetImu | BreakImu | Sill | Slope | Load | Delay) -> None:
    match fault:
        case OffsetImu():
            roll, pitch, yaw = (math.radians(angle) for angle in fault.askew_deg)
            x, y, z = (math.radians(rate) for rate in fault.gyro_deg_s)
            askew = SE3.from_rpy(roll, pitch, yaw, (0.0, 0.0, 0.0)).quat_wxyz
            plant.spoil_imu(ImuFlaws((x, y, z), fault.accel_m_s2, askew))
        case BreakImu():
            plant.break_imu(fault.how, fault.duration_s)
        case Sill():
            name = BUMP if fault.round_bump else SILL
            X = plant.oracle.X_WB().flat() @ SE3.from_xy_yaw(fault.ahead_m, fault.left_m, 0.0)
            high_m = fault.height_m or -1.0  # of none it lies under the floor
            plant.put(name, _shifted(X, (0.0, 0.0, high_m - SILL_HALF_HEIGHT_M)))
        case Slope():
            uphill_rad = plant.oracle.X_WB().yaw_rad + math.radians(fault.towards_deg)
            plant.lean(math.radians(fault.rise_deg), uphill_rad)
        case Load():
            plant.load(plant.robot.torso_body, fault.mass_kg)
        case Delay():
            plant.delay(fault.delay_s)


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
            check_name(fault.place, list(places), "place")
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
    check_name(target, [item.id for item in plant.world.objects], "object")
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
    check_name(target, [*bodies, *known], "body")
    return target
