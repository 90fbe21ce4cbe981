"""The last check before anything moves: are the numbers of a task within this robot's reach?

It refuses only what cannot work wherever things turn out to stand; what depends on that is found
out by the planners. Below it stand the limits in the controller.
"""

from __future__ import annotations

from executive.meaning.knowledge import Knowledge, full_name
from executive.skills.ability import unable
from executive.skills.parameters import (
    BalanceParams,
    NavigateParams,
    Parameters,
    PickParams,
    PlaceParams,
)
from executive.trees.parts import Part, errands
from robot.errors import Failure, failure
from robot.model.description import RobotDescription

FINGER_MARGIN_M = 0.01  # objects are never quite as wide as the map says


def check(part: Part, knowledge: Knowledge, description: RobotDescription) -> Failure | None:
    """The first thing in a task that this robot cannot do, or None."""
    for errand in errands(part):
        if isinstance(errand.params, Parameters):
            refusal = unable(errand.params, description)
            refusal = refusal or _check(errand.params, knowledge, description)
            if refusal is not None:
                return refusal
    return None


def _check(
    params: Parameters, knowledge: Knowledge, description: RobotDescription
) -> Failure | None:
    if isinstance(params, PickParams):
        return _check_pick(params, knowledge, description)
    if isinstance(params, PlaceParams):
        return _check_place(params, knowledge, description)
    if isinstance(params, NavigateParams):
        return _check_walk(params, knowledge)
    if isinstance(params, BalanceParams) and params.mode == "one_leg":
        return _check_one_leg(params, description)
    return None


def _check_pick(
    params: PickParams, knowledge: Knowledge, description: RobotDescription
) -> Failure | None:
    info = knowledge.object(params.object_id)
    if info is None:
        return failure("unknown_object", f"there is no object {params.object_id!r} in this world")
    width_m = min(info.shape.size_m[:2])
    opening_m = max(hand.max_opening_m for hand in description.hands.values()) - FINGER_MARGIN_M
    if width_m > opening_m:
        text = f"{full_name(info)} is {width_m * 100:.0f} cm wide, the hand opens to hold "
        return failure("no_grasp", f"{text}{opening_m * 100:.0f} cm", width_m=width_m)
    most_kg = description.arms.max_lift_kg
    if info.mass_kg > most_kg:
        text = f"{full_name(info)} weighs {info.mass_kg:g} kg, a hand carries {most_kg:g} kg"
        return failure("invalid_goal", text, suggestion="name something lighter")
    return None


def _check_place(
    params: PlaceParams, knowledge: Knowledge, description: RobotDescription
) -> Failure | None:
    place = knowledge.place(params.place_id or "")
    if params.place_id is not None and place is None:
        return failure("unknown_place", f"there is no place {params.place_id!r} in this world")
    X = params.X_WO or (place.X_WP if place else None)
    if X is None:
        return None
    # A stretched arm from the shoulder; lower by as much as the legs let the shoulder down.
    squat_m = description.walking.base_height_m - description.balance.lowest_base_m
    lowest_m = description.shoulder_height_m - description.arm_reach_m - squat_m
    highest_m = description.shoulder_height_m + description.arm_reach_m
    if lowest_m <= X.p[2] <= highest_m:
        return None
    name = f"the {place.name}" if place else "that spot"
    text = f"{name} is {X.p[2]:.2f} m high; the hands reach {lowest_m:.2f} to {highest_m:.2f} m"
    return failure("out_of_reach", text, suggestion="name another place", height_m=X.p[2])


def _check_walk(params: NavigateParams, knowledge: Knowledge) -> Failure | None:
    if params.pose is None:
        return None
    x_min, y_min, x_max, y_max = knowledge.map.bounds_m
    x_m, y_m = params.pose.x_m, params.pose.y_m
    if x_min <= x_m <= x_max and y_min <= y_m <= y_max:
        return None
    text = f"({x_m:g}, {y_m:g}) is outside this world"
    bounds = f"x from {x_min:g} to {x_max:g} m, y from {y_min:g} to {y_max:g} m"
    return failure("invalid_goal", text, suggestion=bounds)


def _check_one_leg(params: BalanceParams, description: RobotDescription) -> Failure | None:
    most_s = description.balance.max_one_leg_s
    if params.duration_s <= most_s:
        return None
    text = f"{params.duration_s:g} s on one leg is too long: at most {most_s:g} s"
    return failure("invalid_goal", text)
