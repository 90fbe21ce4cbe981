"""What can be done to a running world: pushes, things that move or vanish, silent sensors.

Faults are values; a benchmark, a test or a person sends one, the plant suffers it. They reach the
robot through physics and sensors only.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import msgspec

from robot.config import nearest
from robot.errors import ConfigError, Problem
from robot.se3 import SE3, Vector3

if TYPE_CHECKING:
    from sim.plant import Plant

FAR_AWAY_M = 60.0


class _Fault(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """A fault; it begins when it is applied."""


class Push(_Fault, frozen=True, kw_only=True):
    """A force on the robot's torso, or on an object, a piece of furniture, or a body by name.

    `impulse_n_s` in the world's axes, spread evenly over `duration_s`. A push down on a held
    object pulls it out of the hand.
    """

    impulse_n_s: Vector3
    target: str = "robot"
    duration_s: float = 0.1


class Move(_Fault, frozen=True, kw_only=True):
    """An object, a person or a movable piece of furniture is suddenly elsewhere, at rest."""

    target: str
    X_WO: SE3


class Remove(_Fault, frozen=True, kw_only=True):
    """An object or a person is suddenly gone."""

    target: str


class Silence(_Fault, frozen=True, kw_only=True):
    """A sensor's topic (`sensors/depth`) carries nothing for `duration_s`."""

    topic: str
    duration_s: float = math.inf


class MotorOff(_Fault, frozen=True, kw_only=True):
    """One motor no longer obeys: it damps, whatever it is told (`off=False`: it obeys again)."""

    motor: str
    off: bool = True


Fault = Push | Move | Remove | Silence | MotorOff


def apply(plant: Plant, fault: Fault) -> None:
    """Make a fault happen now.

    Raises:
        ConfigError: if it names what is not there, with the nearest name that is.
    """
    match fault:
        case Push():
            force = tuple(value / fault.duration_s for value in fault.impulse_n_s)
            plant.pull(_body(plant, fault.target), force, duration_s=fault.duration_s)
        case Move():
            plant.put(_body(plant, fault.target), fault.X_WO)
        case Remove():
            names = [item.id for item in plant.world.objects]
            row = names.index(fault.target) if fault.target in names else len(names)
            away = SE3((FAR_AWAY_M, FAR_AWAY_M / 2 + row, 1.0))
            plant.put(_body(plant, fault.target), away)
        case Silence():
            _check(fault.topic, plant.sensing.topics(), "topic")
            plant.sensing.silence(fault.topic, plant.time_s + fault.duration_s)
        case MotorOff():
            names = list(plant.robot.motor_names)
            _check(fault.motor, names, "motor")
            plant.motors.set_off(names.index(fault.motor), off=fault.off)


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
