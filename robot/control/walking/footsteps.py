"""Where the next foot goes: from a twist, or towards a stance.

Everything is planar in N: a sole is (x [m], y [m], yaw [rad]).
"""

from __future__ import annotations

import math

import msgspec

from robot.messages import Side
from robot.model.description import Foot
from robot.model.gait import Walking
from robot.se3 import wrap_angle

STILL_M = 0.03
STILL_RAD = 0.06
"""Feet that come to a stand may be so far from square: with loose gears (`real`) a step lands as
far off, and half as much cost a step or two more."""


class Sole(msgspec.Struct, frozen=True):
    """A planted sole."""

    x: float
    y: float
    yaw: float

    def offset(self, forward_m: float, left_m: float, *, turn_rad: float = 0.0) -> Sole:
        """The pose at this offset in the sole's own axes."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return Sole(
            self.x + c * forward_m - s * left_m,
            self.y + s * forward_m + c * left_m,
            self.yaw + turn_rad,
        )

    def relative(self, other: Sole) -> tuple[float, float, float]:
        """`other` in this sole's axes: forward, left, turn."""
        dx, dy = other.x - self.x, other.y - self.y
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return c * dx + s * dy, -s * dx + c * dy, wrap_angle(other.yaw - self.yaw)


class Twist(msgspec.Struct, frozen=True):
    """A velocity wanted of the stance: forward, left [m/s], turn [rad/s]."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0


class Target(msgspec.Struct, frozen=True):
    """A stance wanted: the midpoint of the soles, and the tolerance at which it is met."""

    stance: Sole
    position_tolerance_m: float
    yaw_tolerance_rad: float


Wish = Twist | Target


def sign_of(side: Side) -> float:
    """+1 for left, -1 for right."""
    return 1.0 if side == "left" else -1.0


def other(side: Side) -> Side:
    """The other side."""
    return "right" if side == "left" else "left"


def stance_of(left: Sole, right: Sole) -> Sole:
    """Midpoint and mean heading of two soles."""
    yaw = left.yaw + 0.5 * wrap_angle(right.yaw - left.yaw)
    return Sole(0.5 * (left.x + right.x), 0.5 * (left.y + right.y), yaw)


class FootstepPlanner:
    """Chooses footsteps one at a time; pure but for its limits."""

    def __init__(self, walking: Walking, foot: Foot) -> None:
        """Take the gait's limits, and the size of a sole."""
        self.walking = walking
        self._foot = foot
        self.step_time_s = walking.single_support_s + walking.double_support_s

    def first_swing(self, left: Sole, right: Sole, wish: Wish) -> Side:
        """The foot to move first: the outward one of a sideways move or a turn."""
        stance = stance_of(left, right)
        forward, left_m, turn = self._error(stance, wish)
        sideways = left_m + 0.2 * turn
        if abs(sideways) > 0.01:
            return "left" if sideways > 0.0 else "right"
        lead, _, _ = left.relative(right)
        if abs(lead) > 0.01:  # the foot that trails (or leads, going back) moves first
            return "left" if (lead > 0.0) == (forward >= 0.0) else "right"
        return "left"

    def next(self, support: Sole, swing: Sole, side: Side, wish: Wish) -> Sole | None:
        """Landing of the swing foot `side`, or None when the wish is met with both feet."""
        half = 0.5 * self.walking.stance_width_m
        s = sign_of(side)
        middle = support.offset(0.0, s * half)
        dx, dy, turn = self._increments(middle, s, wish)
        landing = middle.offset(dx, dy, turn_rad=turn).offset(0.0, s * half)
        landing = self.apart(support, landing, side)
        if self._met(swing, landing, middle, wish):
            return None
        return landing

    def apart(self, support: Sole, landing: Sole, side: Side) -> Sole:
        """The landing of the foot `side`, so far out that it does not come down on the other."""
        forward, left, turn = support.relative(landing)
        half_x, half_y = self._foot.half_length_m, self._foot.half_width_m
        inner = half_x * abs(math.sin(turn)) + half_y * abs(math.cos(turn))
        width, s = half_y + self.walking.sole_gap_m + inner, sign_of(side)
        if s * left >= width:
            return landing
        return support.offset(forward, s * width, turn_rad=turn)

    def _met(self, swing: Sole, landing: Sole, middle: Sole, wish: Wish) -> bool:
        """Nothing to do: the foot would land where it is, and the stance is where it should be."""
        if isinstance(wish, Twist):
            if (wish.forward_m_s, wish.left_m_s, wish.turn_rad_s) != (0.0, 0.0, 0.0):
                return False
            tolerance_m, tolerance_rad = STILL_M, STILL_RAD
        else:
            tolerance_m, tolerance_rad = wish.position_tolerance_m, wish.yaw_tolerance_rad
            dx, dy, turn = middle.relative(wish.stance)
            if math.hypot(dx, dy) > tolerance_m or abs(turn) > tolerance_rad:
                return False
        dx, dy, turn = swing.relative(landing)
        return math.hypot(dx, dy) <= tolerance_m and abs(turn) <= tolerance_rad

    def _error(self, middle: Sole, wish: Wish) -> tuple[float, float, float]:
        if isinstance(wish, Target):
            return middle.relative(wish.stance)
        time_s = self.step_time_s
        return wish.forward_m_s * time_s, wish.left_m_s * time_s, wish.turn_rad_s * time_s

    def _increments(self, middle: Sole, s: float, wish: Wish) -> tuple[float, float, float]:
        """Advance of the stance in this step: outward moves and turns take the outward foot."""
        limits, time_s = self.walking, self.step_time_s
        dx, dy, turn = self._error(middle, wish)
        if isinstance(wish, Twist):
            # Of two steps one does it all, the outward foot's: the other would cross.
            dy = 2.0 * dy if s * dy > 0.0 else 0.0
            turn = 2.0 * turn if s * turn > 0.0 else 0.0
            heading = middle.offset(0.0, 0.0, turn_rad=0.5 * turn)
            dx, dy, _ = middle.relative(heading.offset(dx, dy))
        dx = max(-limits.max_backward_m_s * time_s, min(limits.max_step_length_m, dx))
        if isinstance(wish, Target):
            dx = max(
                -0.8 * limits.max_backward_m_s * time_s,
                min(0.8 * limits.max_forward_m_s * time_s, dx),
            )
        inward = limits.stance_width_m - limits.min_stance_width_m
        outward = min(limits.max_step_width_m, 2.0 * limits.max_sideways_m_s * time_s)
        dy = s * max(-inward, min(outward, s * dy))
        turn = s * max(-limits.inward_turn_rad, min(limits.max_step_turn_rad, s * turn))
        return dx, dy, turn
