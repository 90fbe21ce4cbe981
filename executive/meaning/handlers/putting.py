"""Where exactly something is put: next to a thing, between two, on a part of a surface.

That is known when its turn comes: by then it was seen where the things are.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from executive.behaviours.run_skill import Bound
from executive.blackboard import WORLD, Blackboard
from executive.meaning import spots
from executive.meaning.handlers.settling import pose_of
from executive.meaning.knowledge import Knowledge
from executive.meaning.viewpoint import facing
from executive.skills.navigate import FloorPose, NavigateParams
from executive.skills.place import PlaceParams
from intents import goals
from intents.relations import Body, Viewpoint
from robot.failures import Failure, failure
from robot.messages import ObjectInfo, Place

Spots = tuple[spots.Spot, ...]


def beside(
    info: ObjectInfo, how: goals.How, marks: Sequence[ObjectInfo], knowledge: Knowledge
) -> Bound:
    """Put a thing next to (left of, behind, ...) a landmark, or between two."""

    def params(board: Blackboard) -> PlaceParams | Failure:
        bodies: list[Body] = []
        for mark in marks:
            X_WM = pose_of(mark.id, board)
            if X_WM is None:
                text = f"it is not known where {mark.full_name} is"
                return failure("object_not_seen", text, object=mark.id)
            bodies.append(Body(X_WM.p, mark.shape.size_m))
        under = [knowledge.surface_under(pose) for m in marks if (pose := pose_of(m.id, board))]
        place = under[0]
        names = " and ".join(mark.full_name for mark in marks)
        if place is None or any(other is not place for other in under):
            many = len(marks) > 1
            text = f"{names} do not stand on one surface" if many else f"{names} is on no surface"
            return failure("no_free_spot", text, suggestion="name a place to put it on")
        if how == "between":
            wanted = spots.between(bodies[0].p_WO, bodies[1].p_WO)
        else:
            view = facing(place, bodies[0].p_WO, _view(board))
            wanted = spots.beside(how, bodies[0], _radius_m(info), view=view)
        return PlaceParams(object_id=info.id, place_id=place.id, spots=wanted)

    return params


NEXT_TO_M = 0.6
"""What stands farther from a piece of furniture than this is not next to it."""


def next_to_furniture(marks: Sequence[Place], knowledge: Knowledge) -> tuple[Place, Spots] | None:
    """The surface next to a piece of furniture, and its points, the nearest to it first.

    It is what the furniture stands on (a lamp on a desk), else the nearest of another piece.

    Args:
        marks: What is called so.
        knowledge: What is known of the world.

    Returns:
        None where no other surface is within `NEXT_TO_M` of it.
    """
    every = [place for place in knowledge.map.places if not place.floor]
    found: list[tuple[float, Place, Place]] = []
    for mark in marks:
        others = [one for one in every if one.id != mark.id and (one.of or one.id) != mark.of]
        found += [(spots.gap_m(mark, one), mark, one) for one in others if one.of != mark.id]
    gap_m, mark, surface = min(found, key=lambda one: one[0], default=(math.inf, None, None))
    if mark is None or surface is None or gap_m > NEXT_TO_M:
        return None
    return surface, spots.nearest_to(mark, surface)


def part_of_place(info: ObjectInfo, place: Place, part: goals.Part) -> Bound:
    """Put a thing on a part of a surface; the other end is the one that is farther from it.

    If it did not stand on that surface before, it is the one that is farther from the robot.
    """

    def params(board: Blackboard) -> PlaceParams:
        view = _view(board)
        x_m, y_m = view.x_m, view.y_m
        facing_it = facing(place, place.X_WP.p, view)
        wanted = spots.part_of(place, part, away_from=(x_m, y_m), view=facing_it)
        return PlaceParams(object_id=info.id, place_id=place.id, spots=wanted)

    return params


def part_of_floor(place: Place, part: goals.Part) -> Bound:
    """Walk to a part of a room; the other end is the one that is farther from the robot."""

    def params(board: Blackboard) -> NavigateParams:
        x_m, y_m = spots.floor_end(place, part, _view(board))
        return NavigateParams(pose=FloorPose(x_m=x_m, y_m=y_m))

    return params


def _view(board: Blackboard) -> Viewpoint:
    world = board.read(WORLD)
    if world is None:
        return Viewpoint()
    return Viewpoint(x_m=world.X_WB.p[0], y_m=world.X_WB.p[1], yaw_rad=world.X_WB.yaw_rad)


def _radius_m(info: ObjectInfo) -> float:
    x_m, y_m, _ = info.shape.size_m
    return 0.5 * max(x_m, y_m)
