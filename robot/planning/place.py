"""Plans for putting down: a free spot, a stance, a posture."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from robot.failures import Failure, failure
from robot.messages import Place, Shape
from robot.model.handling import Gripping
from robot.planning.floor import Floor
from robot.planning.grasps import TIP_HEIGHT_M, held_option
from robot.planning.handling import search
from robot.planning.handling_problem import Choice, HandlingProblem
from robot.planning.requests import Held, ObjectPose, PlacePlan, PlaceRequest
from robot.planning.robot_body import Body
from robot.planning.solids import people_of, solids_of
from robot.planning.stances import posture_of
from robot.se3 import Array

LIFTS_M = (0.05, 0.03, 0.02)
SPOT_STEP_M = 0.05
MAX_SPOTS = 16
SHARE_PER_M = 1.5
"""Cost of a metre between a spot and where the robot can stand."""
MOST_RAISED_M = 0.01
"""A low thing is let go so far above its place at most, to keep the fingertips clear of it."""
UNDER_A_BOARD_M = 1.0
"""With less free height than this above a place, a hand that is still over it as the robot stands
up meets what is there."""
FARTHER_BACK_M = (0.05, 0.10)
"""So much farther the hand is drawn back there, if it must be: a train on a board 0.45 m high, the
next one 0.30 m above it, could not be let go where the robot squats for that."""
EDGE_M = 0.025
"""Between an object and the edge of what it is put on [m]."""


def plan_place(body: Body, request: PlaceRequest) -> PlacePlan | Failure:
    """How to put down what is held, or why it cannot be."""
    place, shape = request.place, request.held.shape
    around = request.around
    if place.floor:
        return failure("invalid_goal", f"the {place.name} has no surface to put things on")
    if shape.size_m[2] + LIFTS_M[-1] > place.clearance_m:
        return failure(
            "no_free_spot",
            f"there is {100 * place.clearance_m:.0f} cm above the {place.name}, and the thing is "
            f"{100 * shape.size_m[2]:.0f} cm high",
            clearance_m=place.clearance_m,
            height_m=shape.size_m[2],
        )
    others = tuple(s for s in solids_of(around) if s.id != request.held.id)
    floor = Floor(others, around.map.bounds_m)
    objects = tuple(thing for thing in around.objects if thing.id != request.held.id)
    if request.target is not None:
        spots, cost = np.array([request.target.p]), np.zeros(1)
    else:
        gripping = body.description.handy.gripping
        spots = _on_surface(place, shape, request.spots)
        spots, cost = _free_spots(
            place, shape, objects, spots=spots, gripping=gripping, seed=request.seed
        )
        labels = floor.regions(body.description.body_radius_m)
        walkable = (labels > 0) & (labels == floor.home(labels, *request.start[:2]))
        far = floor.distance_to_m(walkable, spots[:, :2])
        spots, cost = _spread(spots, cost + SHARE_PER_M * (far - np.min(far, initial=np.inf)))
        if not len(spots):
            there = ", there where it is wanted," if request.spots else ""
            return failure(
                "no_free_spot",
                f"the {place.name} has no free spot{there} {200 * shape.radius_m:.0f} cm wide",
                width_m=2 * shape.radius_m,
                objects=float(len(objects)),
            )
    names = {info.id: info.name for info in around.map.objects}
    yaws, gripping = _yaws(request), body.description.handy.gripping
    spots = spots + np.array([0.0, 0.0, _raised_m(request.held, gripping)])
    option = held_option(request.held.X_GO, shape, yaws=yaws, gripping=gripping)
    problem = HandlingProblem(
        kind="place",
        object_id=request.held.id,
        shape=shape,
        options=[option],
        references=spots,
        reference_cost=cost,
        others=others,
        lifts_m=LIFTS_M,
        walk_cost_per_m=request.walk_cost_per_m,
        people=people_of(request.around),
        what=f"the {place.name} with the {names.get(request.held.id, request.held.id)}",
    )
    choice = first = _search(body, problem, floor, request)
    for more_m in FARTHER_BACK_M if place.clearance_m < UNDER_A_BOARD_M else ():
        if not isinstance(choice, Failure) or choice.code != "goal_in_collision":
            break
        farther = replace(option, back_m=option.back_m + more_m)
        choice = _search(body, replace(problem, options=[farther]), floor, request)
    if not isinstance(choice, Failure):
        return _plan(body, choice, request)
    return first if isinstance(first, Failure) else choice


def _search(
    body: Body, problem: HandlingProblem, floor: Floor, request: PlaceRequest
) -> Choice | Failure:
    sides = (request.side,)
    return search(body, problem, floor, sides=sides, start=request.start, seed=request.seed)


def _plan(body: Body, choice: Choice, request: PlaceRequest) -> PlacePlan:
    X_WG = choice.main.pose(0)
    lean = body.description.handy.reaching.leans[int(choice.candidate.lean[0])]
    return PlacePlan(
        side=choice.side,
        standoff=choice.candidate.standoff_of(0),
        stance=choice.candidate.stance_of(0),
        posture=posture_of(lean, choice.side),
        ready_rad=tuple(choice.q_ready.tolist()),
        X_WO=X_WG @ request.held.X_GO,
        X_WG_pre=choice.up.pose(0),
        X_WG_release=X_WG,
        X_WG_retreat=choice.back.pose(0),
        pre_rad=tuple(choice.q_up.tolist()),
        margin=choice.margin,
        over=choice.over(body),
    )


def _raised_m(held: Held, gripping: Gripping) -> float:
    """How far above its place a thing is let go, which the fingers hold by its foot.

    They came as near to what it stood on as fingertips may, less what a hand is off: without this
    there were no ways to put a flat thing down at all.
    """
    X_OG, shape = held.X_GO.inverse(), held.shape
    R = X_OG.rotation()
    tip_m = X_OG.p[2] - gripping.fingertip_m * max(0.0, -float(R[2, 0]))
    tip_m -= gripping.finger_half_m * abs(float(R[2, 2]))
    foot_m = shape.X_BodyShape.p[2] - 0.5 * shape.size_m[2]
    return min(MOST_RAISED_M, max(0.0, foot_m + TIP_HEIGHT_M - tip_m))


def _yaws(request: PlaceRequest) -> tuple[float, ...] | None:
    """Yaws of the object that will do (None: any): a cylinder has none; a box is set square."""
    if request.held.shape.kind == "cylinder":
        return None
    if request.target is not None:
        yaw = request.target.yaw_rad
        return (yaw, yaw + math.pi)
    yaw = request.place.X_WP.yaw_rad
    return tuple(yaw + k * math.pi / 2 for k in range(4))


def _on_surface(place: Place, shape: Shape, wanted: tuple[tuple[float, float], ...]) -> Array:
    """Points of the surface far enough from its edges, shape (m, 2) in P: those wanted, or all."""
    radius = shape.radius_m
    half = [max(0.0, 0.5 * size - radius - EDGE_M) for size in place.size_m]
    if min(place.size_m) < 2 * radius:
        return np.zeros((0, 2))
    if wanted:
        X_PW = place.X_WP.inverse()
        local = np.array([X_PW.apply((x, y, place.X_WP.p[2]))[:2] for x, y in wanted])
        return local[np.all(np.abs(local) <= half, axis=1)]
    axes = [np.linspace(-h, h, max(1, int(2 * h / SPOT_STEP_M) + 1)) if h else [0.0] for h in half]
    x, y = (values.ravel() for values in np.meshgrid(*axes, indexing="ij"))
    return np.stack([x, y], axis=1)


def _free_spots(
    place: Place,
    shape: Shape,
    objects: tuple[ObjectPose, ...],
    *,
    spots: Array,
    gripping: Gripping,
    seed: int,
) -> tuple[Array, Array]:
    """Of points (n, 2) in P the free ones as spots for the object's origin, and their costs.

    Spots away from other things and near the middle of the place are liked. Shapes (m, 3), (m,).
    """
    radius = shape.radius_m
    x, y = spots[:, 0], spots[:, 1]
    z = 0.5 * shape.size_m[2] - shape.X_BodyShape.p[2]
    local = np.stack([x, y, np.full_like(x, z)], axis=1)
    spots = local @ place.X_WP.rotation().T + np.array(place.X_WP.p)
    gap = np.full(len(spots), np.inf)
    for thing in objects:
        if abs(thing.X_WO.p[2] - place.X_WP.p[2]) > 0.3:
            continue
        distance = np.hypot(spots[:, 0] - thing.X_WO.p[0], spots[:, 1] - thing.X_WO.p[1])
        gap = np.minimum(gap, distance - thing.shape.radius_m)
    cost = 0.15 * np.hypot(x, y) + 0.6 * np.maximum(0.0, 0.25 - gap)
    cost = cost + 0.05 * np.random.default_rng(seed).random(len(cost))
    free = gap > max(radius, gripping.half_width_m) + gripping.beside_m
    return spots[free], cost[free]


def _spread(spots: Array, cost: Array) -> tuple[Array, Array]:
    """At most `MAX_SPOTS` of them: the best, then the best that are 16 cm off those, and so on."""
    order = np.argsort(cost, kind="stable")
    spots, cost = spots[order], cost[order]
    chosen: list[int] = []
    for apart in (0.16, 0.08, 0.0):
        for i in range(len(spots)):
            if len(chosen) == MAX_SPOTS:
                break
            if i not in chosen and all(
                np.linalg.norm(spots[i] - spots[j]) >= apart for j in chosen
            ):
                chosen.append(i)
    return spots[chosen], cost[chosen]
