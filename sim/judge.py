"""What truly became of a run: the judge of evaluations. Nothing here is ever told to the robot."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from robot import config
from robot.errors import ConfigError, Problem
from robot.se3 import SE3
from sim.plant import Plant

UPRIGHT_TILT_RAD = math.radians(40.0)
STANDING_SHARE = 0.6
OBJECT_TILT_RAD = math.radians(20.0)
IN_HAND_M = 0.06
ON_M = 0.03


class Check(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One thing that should be so: about an object (`held`, `on` a place), or about the robot.

    `at` is a point of the floor [m] that the robot stands at, within `within_m`.
    """

    object: str = ""
    held: bool = False
    on: str = ""
    at: tuple[float, float] | None = None
    within_m: float = 0.15

    def __post_init__(self) -> None:
        """Check that it says something."""
        if bool(self.object) == (self.at is not None) or bool(self.object) != (
            self.held or bool(self.on)
        ):
            raise ValueError("a check is {object, held: true}, {object, on} or {at}")


class Verdict(msgspec.Struct, frozen=True, kw_only=True):
    """How a run truly ended.

    Attributes:
        wrong: each check that does not hold, in words; none: all is as it should be.
        upright: whether the robot truly stands on its feet.
        damped: whether the motors are left to damp by themselves.
    """

    wrong: tuple[str, ...]
    upright: bool
    damped: bool
    source: str = "oracle"


def read(data: Sequence[Mapping[str, Any]], plant_world: Any) -> tuple[Check, ...]:
    """Checks out of plain data. Raises ConfigError with the nearest valid name."""
    try:
        checks = msgspec.convert(list(data), tuple[Check, ...])
    except msgspec.ValidationError as error:
        raise ConfigError(f"a check of the truth: {error}") from None
    objects = [item.id for item in plant_world.objects]
    for check in checks:
        if check.object and check.object not in objects:
            hint = config.nearest(check.object, objects)
            raise ConfigError([Problem(f"unknown object {check.object!r}", suggestion=hint)])
    return checks


def judge(plant: Plant, data: Sequence[Mapping[str, Any]]) -> Verdict:
    """Compare the world as it is with what should be. Raises ConfigError as `read` does."""
    wrong = [_wrong(plant, check) for check in read(data, plant.world)]
    X_WB = plant.oracle.X_WB()
    tilt_rad = math.acos(max(-1.0, min(1.0, float(X_WB.rotation()[2, 2]))))
    low_m = STANDING_SHARE * plant.robot.walking.base_height_m
    return Verdict(
        wrong=tuple(text for text in wrong if text),
        upright=tilt_rad < UPRIGHT_TILT_RAD and X_WB.p[2] > low_m,
        damped=plant.motors.watchdog or not plant.motors.stiff,
    )


def _wrong(plant: Plant, check: Check) -> str:
    """What is not as a check wants it; empty when it is."""
    if check.at is not None:
        off_m = math.dist(plant.oracle.X_WB().p[:2], check.at)
        return "" if off_m <= check.within_m else f"the robot stands {off_m:.2f} m off"
    X_WO = plant.oracle.X_WO(check.object)
    if check.held:
        far_m = min(_from_hand_m(plant, hand.grasp_site, X_WO) for hand in _hands(plant))
        return "" if far_m <= IN_HAND_M else f"the {check.object} is {far_m:.2f} m from the hand"
    return _not_on(plant, check.object, check.on, X_WO)


def _not_on(plant: Plant, name: str, place_id: str, X_WO: SE3) -> str:
    """Why an object does not stand on a place; empty when it does."""
    places = plant.places()
    if place_id not in places:
        hint = config.nearest(place_id, list(places))
        raise ConfigError([Problem(f"unknown place {place_id!r}", suggestion=hint)])
    place = places[place_id]
    height_m = next(o.size_m[2] for o in plant.world.objects if o.id == name)
    x_m, y_m, z_m = place.X_WP.inverse().apply(X_WO.p)
    inside = abs(x_m) <= place.size_m[0] / 2 and abs(y_m) <= place.size_m[1] / 2
    if not inside or abs(z_m - height_m / 2) > ON_M:
        return f"the {name} is not on the {place.name}"
    tilt_rad = math.acos(max(-1.0, min(1.0, float(X_WO.rotation()[2, 2]))))
    return f"the {name} lies on its side" if tilt_rad > OBJECT_TILT_RAD else ""


def _hands(plant: Plant) -> list[Any]:
    return list(plant.robot.hands.values())


def _from_hand_m(plant: Plant, site: str, X_WO: SE3) -> float:
    return math.dist(plant.data.site(site).xpos, X_WO.p)
