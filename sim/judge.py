"""What truly became of a run: the judge of evaluations. Nothing here is ever told to the robot."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from robot.errors import ConfigError, Problem
from robot.files import config, patterns
from robot.model.description import Hand
from robot.reality.truth import Check, Verdict
from robot.se3 import SE3
from sim import atlas
from sim.plant import Plant
from sim.witness import Step, Witness

UPRIGHT_TILT_RAD = math.radians(40.0)
STANDING_SHARE = 0.6
OBJECT_TILT_RAD = math.radians(20.0)
IN_HAND_M = 0.06
ON_M = 0.03


def judge(plant: Plant, checks: Iterable[Check], witness: Witness) -> Verdict:
    """Compare the world as it is, and as it was, with what should be.

    Args:
        plant: as it is.
        checks: what should be.
        witness: who has watched the plant from the beginning.

    Raises:
        ConfigError: for an unknown place.
    """
    wrong = [_wrong(plant, check, witness) for check in checks]
    X_WB = plant.oracle.X_WB()
    tilt_rad = math.acos(max(-1.0, min(1.0, float(X_WB.rotation()[2, 2]))))
    low_m = STANDING_SHARE * plant.robot.walking.base_height_m
    return Verdict(
        wrong=tuple(text for text in wrong if text),
        upright=tilt_rad < UPRIGHT_TILT_RAD and X_WB.p[2] > low_m,
        damped=plant.motors.watchdog or not plant.motors.stiff,
        touched=tuple(f"{text} ({when_s:g} s)" for text, when_s in witness.touched.items()),
        too_near=tuple(f"{name} ({far_m:.2f} m)" for name, far_m in witness.too_near.items()),
    )


def _wrong(plant: Plant, check: Check, witness: Witness) -> str:
    """What is not as a check wants it; empty when it is."""
    if check.any:
        wrong = [_wrong(plant, one, witness) for one in check.any]
        return "" if "" in wrong else ", and ".join(wrong)
    if check.object:
        return _object_wrong(plant, check)
    if check.not_moved:
        far_m = math.dist(witness.begin[check.not_moved].p, plant.oracle.X_WO(check.not_moved).p)
        moved = f"the {check.not_moved} was moved by {far_m:.2f} m"
        return "" if far_m <= check.distance_m else moved
    if check.said:
        heard = any(patterns.is_in(check.said, text) for text in witness.said)
        return "" if heard else f"it did not say {check.said!r}, but {witness.said}"
    if check.visited or check.passed or check.passed_at:
        return _way_wrong(plant, check, witness.way)
    return _robot_wrong(plant, check)


def _robot_wrong(plant: Plant, check: Check) -> str:
    """What is not right about where the robot stands."""
    at = plant.oracle.X_WB().p[:2]
    if check.robot_in:
        room = atlas.room_at(plant.world, at)
        return "" if room == check.robot_in else f"the robot is in {room or 'no room'}"
    goal = check.at or plant.oracle.X_WO(check.robot_near).p[:2]
    off_m = math.dist(at, goal)
    of = f" of {check.robot_near}" if check.robot_near else ""
    return "" if off_m <= check.distance_m else f"the robot stands {off_m:.2f} m off{of}"


def _way_wrong(plant: Plant, check: Check, way: Sequence[Step]) -> str:
    """What is not right about where the robot was."""
    points = [(step.x_m, step.y_m) for step in way]
    if check.passed_at is not None:
        off_m = min(math.dist(point, check.passed_at) for point in points)
        return "" if off_m <= check.distance_m else f"it came no nearer than {off_m:.2f} m"
    if check.visited:
        rooms = [atlas.room_at(plant.world, point) for point in points]
        met: list[set[str]] = [{room} for room in rooms]
    else:
        where = {name: plant.oracle.X_WO(name).p[:2] for name in check.passed}
        near_m = check.distance_m
        met = [{n for n, at in where.items() if math.dist(p, at) <= near_m} for p in points]
    left = _left(check.visited or check.passed, iter(met))
    return f"it was not at {' and then '.join(left)}" if left else ""


def _left(stops: Sequence[str], met: Iterator[set[str]]) -> list[str]:
    """The stops, in their order, that were not come to; one instant may serve several."""
    left = list(stops)
    for there in met:
        while left and left[0] in there:
            left.pop(0)
    return left


def _object_wrong(plant: Plant, check: Check) -> str:
    """What is not right about an object."""
    X_WO = plant.oracle.X_WO(check.object)
    if check.held:
        far_m = min(_from_hand_m(plant, hand.grasp_site, X_WO) for hand in _hands(plant))
        return "" if far_m <= IN_HAND_M else f"the {check.object} is {far_m:.2f} m from the hand"
    if check.on:
        return _not_on(plant, check.object, check.on, X_WO)
    other = check.near or check.with_person
    there = plant.oracle.X_WO(other).p
    # A person's origin is between the feet: what they have is as high as they like.
    far_m = math.dist(X_WO.p, there) if check.near else math.dist(X_WO.p[:2], there[:2])
    wrong = f"the {check.object} is {far_m:.2f} m from {other}"
    return "" if far_m <= check.distance_m else wrong


def _not_on(plant: Plant, name: str, place_id: str, X_WO: SE3) -> str:
    """Why an object does not stand on a place, or any of a piece of furniture; empty if it does."""
    every = plant.places()
    places = [place for place in every.values() if place_id in (place.id, place.of)]
    if not places:
        hint = config.nearest(place_id, list(every))
        raise ConfigError([Problem(f"unknown place {place_id!r}", suggestion=hint)])
    item = next(o for o in plant.world.objects if o.id == name)
    heights_m = {item.size_m[2], item.height_m}  # what lay may lie there as well
    for place in places:
        x_m, y_m, z_m = place.X_WP.inverse().apply(X_WO.p)
        inside = abs(x_m) <= place.size_m[0] / 2 and abs(y_m) <= place.size_m[1] / 2
        if inside and any(abs(z_m - height_m / 2) <= ON_M for height_m in heights_m):
            break
    else:
        return f"the {name} is not on the {every[place_id].name if place_id in every else place_id}"
    tilt_rad = math.acos(max(-1.0, min(1.0, float(X_WO.rotation()[2, 2]))))
    tipped = tilt_rad > OBJECT_TILT_RAD and not item.lies
    return f"the {name} lies on its side" if tipped else ""


def _hands(plant: Plant) -> list[Hand]:
    return list(plant.robot.hands.values())


def _from_hand_m(plant: Plant, site: str, X_WO: SE3) -> float:
    return math.dist(plant.data.site(site).xpos, X_WO.p)
