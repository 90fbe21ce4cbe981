"""Where to look in passing, on the way to a view: at surfaces beside the way that are left to see.

Only a guess at what shows, by the direction and by what stands between as the map has it; what was
seen well is for the world model to say, and what was not is gone to as planned.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from executive.skills.motions.body_access import Body
from executive.skills.motions.obstructions import between, clearance_m
from executive.skills.motions.survey import Survey
from robot.messages import Obstacle
from robot.model import looking
from robot.se3 import Array, Vector3

NEAREST_M, NEAR_M = 0.4, 1.9
"""Over the floor: eyes look down on what is nearer at too steep an angle, and from farther off it
is not said that there is nothing (`robot.planning.views`)."""
HEAD_SHARE = 1.3 / 1.4
"""Of how far a robot looks to a side (`looking.aside_rad`), a little less."""
TRIES = 3
"""Directions that are tried; each is checked against all that stands near."""


def glance(body: Body, survey: Survey) -> Vector3 | None:
    """The point to look at from here that shows most of what a survey has left, if there is any.

    The feet need not turn for it.
    """
    rows, robot = survey.left, body.description
    head_rad, cone_rad = HEAD_SHARE * looking.aside_rad(robot), looking.cone_rad(robot)
    points, worth = np.array(survey.points_W(rows)).reshape(-1, 3), np.array(survey.worth(rows))
    x_m, y_m, _ = body.X_WS.p
    off = points[:, :2] - (x_m, y_m)
    far_m = np.hypot(off[:, 0], off[:, 1])
    bearings = np.arctan2(off[:, 1], off[:, 0]) - body.X_WS.yaw_rad
    bearings = (bearings + np.pi) % (2.0 * np.pi) - np.pi
    left = (far_m > NEAREST_M) & (far_m < NEAR_M) & (np.abs(bearings) < head_rad)
    near = [thing for thing in body.map.obstacles if clearance_m((x_m, y_m), thing) < NEAR_M]
    for _ in range(TRIES):
        if not left.any():
            return None
        at = _best(bearings, worth, left, cone_rad)
        x, y, z = points[at].tolist()
        if between((x_m, y_m), (x, y), _others(near, points[at]), height_m=z) is None:
            return (x, y, z)
        left &= np.abs(bearings - bearings[at]) > cone_rad
    return None


def may_look_at(body: Body, p_W: Vector3) -> bool:
    """Whether the head turns to a point by itself, and nothing that the map has hides it."""
    x_m, y_m, _ = body.X_WS.p
    ahead_m, left_m, _ = body.X_WS.inverse().apply((p_W[0], p_W[1], 0.0)).tolist()
    if abs(math.atan2(left_m, ahead_m)) > HEAD_SHARE * looking.aside_rad(body.description):
        return False
    far_m = math.dist(p_W[:2], (x_m, y_m))
    near = [thing for thing in body.map.obstacles if clearance_m((x_m, y_m), thing) < far_m]
    things = _others(near, np.array(p_W))
    return between((x_m, y_m), (p_W[0], p_W[1]), things, height_m=p_W[2]) is None


def _best(bearings: Array, worth: Array, left: NDArray[np.bool_], cone_rad: float) -> int:
    """The point about whose direction most of what is left shows."""
    rows = np.flatnonzero(left)
    together = np.abs(bearings[rows][:, None] - bearings[rows][None, :]) < cone_rad
    return int(rows[np.argmax(together @ worth[rows])])


def _others(things: list[Obstacle], point: Array) -> list[Obstacle]:
    """All but what the point is on, or in: boards stand among their uprights."""
    at = (float(point[0]), float(point[1]))
    return [thing for thing in things if clearance_m(at, thing) > 0.0]
