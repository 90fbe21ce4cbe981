"""Where things are relative to one another, and to who looks: left of, behind, on, near.

Left, right, behind and in front are as a person at the viewpoint would say them: seen along the
line from there to the thing that is referred to, as people place things in front of them
[Levinson2003, the relative frame of reference].
"""

from collections.abc import Callable, Iterable
from math import cos, hypot, sin

import msgspec

from intents.goals import How, Superlative

Point = tuple[float, float, float]
NEAR_M = 0.45
"""Free distance up to which two things are next to each other [m]."""
LEVEL_M = 0.2
"""Boards of a shelf are 0.25 m apart or more: what stands on the next one is not next to it."""
ASIDE = 0.5
"""Least share of a distance that has to be sideways for "left", or along for "behind"."""
TOUCH_M = 0.05


class Body(msgspec.Struct, frozen=True):
    """A box that stands upright: the middle p_WO [m] and extents in x, y, z [m]."""

    p_WO: Point
    size_m: Point = (0.0, 0.0, 0.0)

    @property
    def radius_m(self) -> float:
        """Half of its wider extent on the floor [m]."""
        return max(self.size_m[0], self.size_m[1]) / 2


class Viewpoint(msgspec.Struct, frozen=True, kw_only=True):
    """Where the robot stands and looks: position p_WB on the floor [m] and heading [rad]."""

    x_m: float = 0.0
    y_m: float = 0.0
    yaw_rad: float = 0.0

    def distance_m(self, p_WO: Point) -> float:
        """Distance on the floor [m]."""
        return hypot(p_WO[0] - self.x_m, p_WO[1] - self.y_m)

    def left_m(self, p_WO: Point) -> float:
        """How far to the left of where it looks [m]."""
        dx, dy = p_WO[0] - self.x_m, p_WO[1] - self.y_m
        return cos(self.yaw_rad) * dy - sin(self.yaw_rad) * dx


def rank(superlative: Superlative, p_WO: Point, view: Viewpoint) -> float | None:
    """How much of a superlative that depends on the viewpoint something is; None for others."""
    if superlative in ("leftmost", "rightmost"):
        return view.left_m(p_WO) * (1 if superlative == "leftmost" else -1)
    if superlative in ("nearest", "farthest"):
        return view.distance_m(p_WO) * (-1 if superlative == "nearest" else 1)
    return None


def apart_m(one: Point, other: Point) -> float:
    """Distance on the floor [m]."""
    return hypot(one[0] - other[0], one[1] - other[1])


def holds(how: How, one: Body, other: Body, view: Viewpoint | None) -> bool | None:
    """Whether one is `how` the other; None where that needs a viewpoint and there is none."""
    if how in _UPRIGHT:
        return _UPRIGHT[how](one, other)
    return None if view is None else _as_seen(how, one, other, view)


def between(one: Body, ends: Iterable[Body]) -> bool:
    """Whether it stands on the way from one of two things to the other."""
    a, b = (end.p_WO for end in ends)
    length_m = hypot(b[0] - a[0], b[1] - a[1])
    x, y = one.p_WO[0] - a[0], one.p_WO[1] - a[1]
    if length_m == 0.0:
        return False
    along_m = (x * (b[0] - a[0]) + y * (b[1] - a[1])) / length_m
    off_m = abs(x * (b[1] - a[1]) - y * (b[0] - a[0])) / length_m
    return 0 < along_m < length_m and off_m <= max(NEAR_M, length_m / 4)


def _overlap(one: Body, other: Body) -> bool:
    """Whether the middle of one is over or under the other."""
    reach = (other.size_m[0] / 2 + TOUCH_M, other.size_m[1] / 2 + TOUCH_M)
    return all(abs(one.p_WO[i] - other.p_WO[i]) <= reach[i] for i in (0, 1))


def _gap_m(upper: Body, lower: Body) -> float:
    """Free height between two things [m]."""
    return (upper.p_WO[2] - upper.size_m[2] / 2) - (lower.p_WO[2] + lower.size_m[2] / 2)


def _foot_m(one: Body) -> float:
    return one.p_WO[2] - one.size_m[2] / 2


def _on(one: Body, other: Body) -> bool:
    return _overlap(one, other) and abs(_gap_m(one, other)) <= TOUCH_M


def _above(one: Body, other: Body) -> bool:
    return _overlap(one, other) and _gap_m(one, other) >= -TOUCH_M


def _under(one: Body, other: Body) -> bool:
    return _overlap(other, one) and _gap_m(other, one) >= -TOUCH_M


def _in(one: Body, other: Body) -> bool:
    inside = abs(one.p_WO[2] - other.p_WO[2]) <= other.size_m[2] / 2
    return _overlap(one, other) and inside


def _near(one: Body, other: Body) -> bool:
    apart_m = hypot(one.p_WO[0] - other.p_WO[0], one.p_WO[1] - other.p_WO[1])
    off_m = abs(one.p_WO[2] - other.p_WO[2])
    foot_off_m = abs(_foot_m(one) - _foot_m(other))
    level = off_m <= other.size_m[2] / 2 or min(off_m, foot_off_m) <= LEVEL_M
    return level and apart_m - one.radius_m - other.radius_m <= NEAR_M


_UPRIGHT: dict[How, Callable[[Body, Body], bool]] = {
    "on": _on, "above": _above, "under": _under, "in": _in, "near": _near,
}  # fmt: skip


def _as_seen(how: How, one: Body, other: Body, view: Viewpoint) -> bool:
    """Left, right, behind, in front: along or across the line of sight to the other."""
    away = view.distance_m(other.p_WO)
    if away == 0.0:
        return False
    sight = ((other.p_WO[0] - view.x_m) / away, (other.p_WO[1] - view.y_m) / away)
    d = (one.p_WO[0] - other.p_WO[0], one.p_WO[1] - other.p_WO[1])
    beyond_m = d[0] * sight[0] + d[1] * sight[1]
    left_m = sight[0] * d[1] - sight[1] * d[0]
    wanted_m = {"left": left_m, "right": -left_m, "behind": beyond_m, "in_front": -beyond_m}
    return wanted_m.get(how, 0.0) > ASIDE * hypot(*d)
