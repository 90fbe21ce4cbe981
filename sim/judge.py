"""What truly became of a run: the judge of evaluations. Nothing here is ever told to the robot."""

from __future__ import annotations

import math
from collections.abc import Iterable

from robot import config
from robot.errors import ConfigError, Problem
from robot.model.description import Hand
from robot.reality.truth import Check, Verdict
from robot.se3 import SE3
from sim.plant import Plant

UPRIGHT_TILT_RAD = math.radians(40.0)
STANDING_SHARE = 0.6
OBJECT_TILT_RAD = math.radians(20.0)
IN_HAND_M = 0.06
ON_M = 0.03


def judge(plant: Plant, checks: Iterable[Check]) -> Verdict:
    """Compare the world as it is with what should be. Raises ConfigError for an unknown place."""
    wrong = [_wrong(plant, check) for check in checks]
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


def _hands(plant: Plant) -> list[Hand]:
    return list(plant.robot.hands.values())


def _from_hand_m(plant: Plant, site: str, X_WO: SE3) -> float:
    return math.dist(plant.data.site(site).xpos, X_WO.p)
