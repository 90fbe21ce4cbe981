"""Goals beyond the edge of the map: nobody can make room there, so they are refused at once."""

from __future__ import annotations

from robot.failures import Failure, failure
from robot.messages import WorldMap
from robot.planning.requests import NARROW_M


def beyond(world_map: WorldMap, x_m: float, y_m: float) -> Failure | None:
    """Why nobody can be sent to a point of the floor: the map ends before it, or right behind it.

    The planner takes no goal nearer than `NARROW_M` to the edge.
    """
    x_min, y_min, x_max, y_max = world_map.bounds_m
    off_m = min(x_m - x_min, x_max - x_m, y_m - y_min, y_max - y_m)
    if off_m >= NARROW_M:
        return None
    where = "outside this world" if off_m < 0.0 else "at the very edge of this world"
    room = [round(low + NARROW_M, 2) for low in (x_min, y_min)]
    room += [round(high - NARROW_M, 2) for high in (x_max, y_max)]
    bounds = f"x from {room[0]:g} to {room[2]:g} m, y from {room[1]:g} to {room[3]:g} m"
    text = f"({round(x_m, 2):g}, {round(y_m, 2):g}) is {where}"
    return failure("invalid_goal", text, suggestion=bounds)
