"""Ways to walk around furniture: a way over the floor, then corners rounded and headings set.

The body is a circle that holds its arms. A start or goal nearer to furniture than that (in front of
a table) is left and entered on a short straight line with the heading kept.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from robot.failures import Failure, failure
from robot.model.description import RobotDescription
from robot.planning import numerics
from robot.planning.base_block import explain_no_path
from robot.planning.floor import Floor, with_room
from robot.planning.floor_ways import FloorWays
from robot.planning.requests import NARROW_M, BasePath, BasePathRequest, Stance
from robot.planning.robot_body import Body
from robot.planning.solids import Solid, solids_of
from robot.se3 import Array, wrap_angle

ESCAPE_M = 1.0
"""Longest line on which a place near furniture is left or entered [m]."""
SPACING_M = 0.25
CUT_M = 0.35
"""Distance of waypoints, and most that is cut off a corner [m]."""
MORE_ROOM_M = 0.3
"""Longest such line [m] where the body has room already and only more of it is wanted. Stepped
along with the heading kept, it is followed less well than a way: 0.56 m of it led backwards and
askew through a doorway that had just been passed, and a hand met the wall."""
START_OVERLAP_M = 0.03
"""Where the robot stands it may seem to overlap things by this much [m]."""
LEAST = 0.9
"""Of the body's radius, a circle that holds the arms: a gap of 0.49 m is gone through."""
TURN_ON_THE_SPOT_RAD = 0.35


def plan_base_path(body: Body, request: BasePathRequest) -> BasePath | Failure:
    """Waypoints from the start to the goal, or why there are none."""
    solids = solids_of(request.around)
    robot = body.description
    radius = robot.body_radius_m
    bounds_m = with_room(request.around.map.bounds_m, *request.start[:2], radius_m=radius)
    floor = Floor(solids, bounds_m)
    for stance, code, overlap in (
        (request.start, "start_in_collision", START_OVERLAP_M),
        (request.goal, "goal_in_collision", 0.0),
    ):
        problem = _standing_problem(body, solids, floor, stance, code=code, overlap_m=overlap)
        if problem is not None:
            return problem
    path = _plan(robot, floor, request)
    return path or explain_no_path(
        floor, request.start, request.goal, needed_m=2.0 * LEAST * radius
    )


def _standing_problem(
    body: Body,
    solids: tuple[Solid, ...],
    floor: Floor,
    stance: Stance,
    *,
    code: str,
    overlap_m: float,
) -> Failure | None:
    """What the robot touches where it stands or would stand, by more than `overlap_m`."""
    x, y, _ = stance
    verb = "stands" if code == "start_in_collision" else "would stand"
    touch = body.trunk_touch(solids, stance)
    if touch is not None and touch.distance_m < -overlap_m:
        return failure(
            code,
            f"where the robot {verb}, its {touch.first} touches {touch.second}",
            x_m=x,
            y_m=y,
            blocked_by=touch.second,
            overlap_m=-touch.distance_m,
        )
    if code == "goal_in_collision" and floor.clearance_m(x, y) < NARROW_M:
        name, distance = floor.nearest(x, y)
        return failure(
            code,
            f"where the robot {verb}, there is {name}",
            x_m=x,
            y_m=y,
            blocked_by=name,
            distance_m=distance,
        )
    return None


def _plan(robot: RobotDescription, floor: Floor, request: BasePathRequest) -> BasePath | None:
    """A path whose free part keeps clear of everything as far as there is room."""
    radius_m = robot.body_radius_m
    least_m, wanted_m = LEAST * radius_m, radius_m + request.clearance_m
    direct = _direct(robot, floor, request, wanted_m)
    if direct is not None:
        return direct
    levels = (wanted_m, radius_m, least_m)
    leave, enter = (_way_out(floor, stance, levels) for stance in (request.start, request.goal))
    if leave is None or enter is None:
        return None
    a, b = np.array(leave[:2]), np.array(enter[:2])
    ways = FloorWays(floor, a, least_m=least_m, wanted_m=wanted_m)
    corners = ways.corners(b)
    if corners is None:
        return None
    rounded = _round_off(floor, corners, wanted_m)
    waypoints = _with_headings(rounded, leave[2], enter[2])
    if math.dist(leave[:2], request.start[:2]) > 1e-9:
        waypoints.insert(0, leave)
    if math.dist(enter[:2], request.goal[:2]) > 1e-9:
        waypoints.append(request.goal)
    return _finish(floor, request.start, waypoints)


def _finish(floor: Floor, start: Stance, waypoints: list[Stance]) -> BasePath:
    """Add up length and clearance."""
    stops = [start, *waypoints]
    length = sum(math.dist(a[:2], b[:2]) for a, b in pairwise(stops))
    clearances = tuple(floor.segment_clearance_m(a[:2], b[:2]) for a, b in pairwise(stops))
    return BasePath(
        waypoints=tuple(waypoints), length_m=length, clearance_m=min(clearances),
        clearances_m=clearances,
    )  # fmt: skip


def _direct(
    robot: RobotDescription, floor: Floor, request: BasePathRequest, radius_m: float
) -> BasePath | None:
    """Stepping straight to a near goal, sideways or backwards, where that is quicker and free."""
    (x0, y0, yaw0), (x1, y1, yaw1) = request.start, request.goal
    length = math.hypot(x1 - x0, y1 - y0)
    turn = abs(wrap_angle(yaw1 - yaw0))
    if length < 1e-6 and turn < 1e-6:
        return _finish(floor, request.start, [request.goal])
    ends = min(floor.clearance_m(x0, y0), floor.clearance_m(x1, y1))
    if floor.segment_clearance_m((x0, y0), (x1, y1)) < min(radius_m, ends) - 0.01:
        return None
    walk = robot.walking
    heading = math.atan2(y1 - y0, x1 - x0)
    middle = heading - yaw0 - 0.5 * wrap_angle(yaw1 - yaw0)
    along, across = length * math.cos(middle), length * abs(math.sin(middle))
    ahead = along / walk.max_forward_m_s if along > 0 else -along / walk.max_backward_m_s
    stepping_s = max(ahead + across / walk.max_sideways_m_s, turn / walk.max_turn_rad_s)
    turns = abs(wrap_angle(heading - yaw0)) + abs(wrap_angle(yaw1 - heading))
    walking_s = length / walk.max_forward_m_s + turns / walk.max_turn_rad_s
    if ends < radius_m and turn > TURN_ON_THE_SPOT_RAD:
        return None
    if stepping_s > walking_s + 0.5 and not (ends < radius_m and length < 0.5):
        return None
    return _finish(floor, request.start, [request.goal])


def _way_out(floor: Floor, stance: Stance, levels_m: tuple[float, float, float]) -> Stance | None:
    """Where a straight line from a stance has room to turn: as much as there is of the levels.

    The second level is room for the body: who has that goes no long way for the first.
    """
    wanted_m, body_m, _ = levels_m
    has_room = floor.clearance_m(*stance[:2]) >= body_m
    for level_m in levels_m:
        longest_m = MORE_ROOM_M if has_room and level_m == wanted_m else ESCAPE_M
        end = _escape(floor, stance, level_m, longest_m=longest_m)
        if end is not None:
            return end
    return None


def _escape(floor: Floor, stance: Stance, radius_m: float, *, longest_m: float) -> Stance | None:
    """The nearest stance with the same heading that has `radius_m` clear, backwards preferred."""
    x, y, yaw = stance
    here = floor.clearance_m(x, y)
    if here >= radius_m:
        return stance
    best: tuple[float, Stance] | None = None
    for turn in np.radians([180, 150, -150, 120, -120, 90, -90, 45, -45, 0]).tolist():
        c, s = math.cos(yaw + turn), math.sin(yaw + turn)
        off_back = abs(wrap_angle(turn - math.pi))
        for length in np.arange(0.05, longest_m + 0.01, 0.05).tolist():
            cost = length * (1.0 + 0.4 * off_back)
            end = (x + length * c, y + length * s)
            if best is not None and cost >= best[0]:
                break
            if floor.clearance_m(*end) < min(here, 0.5 * radius_m) - 0.02:
                break
            if floor.clearance_m(*end) >= radius_m:
                best = (cost, (*end, yaw))
                break
    return best[1] if best else None


def _length(corners: Array) -> float:
    return float(np.sum(np.linalg.norm(np.diff(corners, axis=0), axis=1)))


def _round_off(floor: Floor, corners: Array, wanted_m: float) -> Array:
    """Cut corners (a parabola between points on both legs) where that is free; space evenly.

    Free is what is wanted, or as near to things as the corner itself.
    """
    points: list[Array] = [corners[0]]
    for i in range(1, len(corners) - 1):
        before, corner, after = corners[i - 1], corners[i], corners[i + 1]
        free_m = min(wanted_m, floor.clearance_m(float(corner[0]), float(corner[1]))) - 0.01
        legs = [np.linalg.norm(corner - before), np.linalg.norm(after - corner)]
        for cut in (CUT_M, 0.5 * CUT_M, 0.25 * CUT_M, 0.0):
            shares = [min(0.5, cut / max(float(leg), 1e-9)) for leg in legs]
            p, q = corner + shares[0] * (before - corner), corner + shares[1] * (after - corner)
            t = np.linspace(0.0, 1.0, 7)[:, None]
            curve = (1 - t) ** 2 * p + 2 * t * (1 - t) * corner + t**2 * q
            if cut == 0.0 or np.min(floor.clearances_m(curve)) >= free_m:
                points += list(curve) if cut > 0.0 else [corner]
                break
    points.append(corners[-1])
    return _spaced(np.array(points))


def _spaced(points: Array) -> Array:
    """Points at about `SPACING_M` along a polyline, its ends included."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    keep = np.concatenate([[True], steps > 1e-9])
    points, along = points[keep], np.concatenate([[0.0], np.cumsum(steps[steps > 1e-9])])
    count = max(1, round(along[-1] / SPACING_M))
    at = numerics.even(0.0, float(along[-1]), count + 1)
    return np.stack([np.interp(at, along, points[:, axis]) for axis in (0, 1)], axis=1)


def _with_headings(points: Array, yaw_start: float, yaw_end: float) -> list[Stance]:
    """Waypoints after the first point, looking along the path, with turns on the spot."""
    if len(points) < 2 or _length(points) < 1e-6:
        x, y = points[-1]
        return [(float(x), float(y), yaw_end)]
    legs = np.diff(points, axis=0)
    heading = np.arctan2(legs[:, 1], legs[:, 0]).tolist()
    result: list[Stance] = []
    if abs(wrap_angle(heading[0] - yaw_start)) > TURN_ON_THE_SPOT_RAD:
        result.append((float(points[0, 0]), float(points[0, 1]), heading[0]))
    for i in range(1, len(points)):
        ahead = heading[i] if i < len(heading) else heading[i - 1]
        yaw = heading[i - 1] + 0.5 * wrap_angle(ahead - heading[i - 1])
        result.append((float(points[i, 0]), float(points[i, 1]), wrap_angle(yaw)))
    if abs(wrap_angle(yaw_end - result[-1][2])) > TURN_ON_THE_SPOT_RAD:
        result.append((result[-1][0], result[-1][1], yaw_end))
    else:
        result[-1] = (result[-1][0], result[-1][1], yaw_end)
    return result
