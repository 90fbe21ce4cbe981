"""From where left, right, behind and in front are meant: from before the surface, facing it."""

from __future__ import annotations

import math

from intents.relations import Point, Viewpoint
from robot.messages import Place
from robot.se3 import SE3

STAND_OFF_M = 1.5


def facing(place: Place, p_WO: Point, view: Viewpoint) -> Viewpoint:
    """The viewpoint straight before a thing on a surface, on the side where the robot stands.

    People say "behind" across a counter's front edge, not along the line from where they happen to
    stand: from its end all that is left of a bottle would be behind it.

    Args:
        place: the surface.
        p_WO: the thing that is referred to [m].
        view: where the robot stands.
    """
    x_m, y_m, _ = place.X_WP.inverse().apply((view.x_m, view.y_m, 0.0))
    over_x, over_y = abs(x_m) - 0.5 * place.size_m[0], abs(y_m) - 0.5 * place.size_m[1]
    out = (math.copysign(1.0, x_m), 0.0) if over_x >= over_y else (0.0, math.copysign(1.0, y_m))
    turned = SE3((0.0, 0.0, 0.0), place.X_WP.quat_wxyz).apply((*out, 0.0))
    x_out, y_out = float(turned[0]), float(turned[1])
    return Viewpoint(
        x_m=p_WO[0] + STAND_OFF_M * x_out,
        y_m=p_WO[1] + STAND_OFF_M * y_out,
        yaw_rad=math.atan2(-y_out, -x_out),
    )
