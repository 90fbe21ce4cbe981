"""How far aside a body sees, what of its pictures counts, how fast it gets from view to view.

Planners of views reckon with these, out of neck, waist, camera and paces of a description. The
shares are of Juno, with which searching was measured (neck 1.4 rad, fovy 1.047 rad, 0.23 m/s).
"""

from __future__ import annotations

import math

from robot.model.description import Camera, RobotDescription

PICTURE_SHARE = 0.7
"""Of half the picture: what is further out may be cut by its edge."""
CONE_SHARE = 0.84 / 1.0471976
"""Of half its height: a cone about its middle in which all that a look is for counts as seen."""
WALK_SHARE = 0.2 / 0.23
"""Of the pace on a straight way: between views there are bends, narrow places, stops."""
TURN_EXTRA = 0.95
"""What the pace of a turn, which has one step too many in it, is of that of a turn to a view, which
has a start of its own."""


def half_picture_rad(camera: Camera) -> tuple[float, float]:
    """Aside and down from the middle of the picture, as far as nothing is cut by its edge [rad]."""
    tangent = math.tan(0.5 * camera.fovy_rad)
    aside = PICTURE_SHARE * math.atan(tangent * camera.width / camera.height)
    return aside, PICTURE_SHARE * math.atan(tangent)


def aside_rad(robot: RobotDescription) -> float:
    """How far to either side of its feet's heading a standing robot can look at something [rad].

    By its neck; without one by its waist, as far as what is looked at comes into the picture.
    """
    if robot.groups["head"]:
        return robot.neck_rad
    return robot.gaze.waist_yaw_rad + half_picture_rad(robot.sensors.camera)[0]


def cone_rad(robot: RobotDescription) -> float:
    """Around the middle of a picture, what counts as looked at [rad]."""
    return 0.5 * robot.sensors.camera.fovy_rad * CONE_SHARE


def walk_m_s(robot: RobotDescription) -> float:
    """On the way from view to view."""
    return robot.paces.walk_m_s * WALK_SHARE


def turn_rad_s(robot: RobotDescription) -> float:
    """On the spot, to a view."""
    return robot.paces.turn_rad_s / TURN_EXTRA
