"""Where and when a step has to come down to catch a push: under the DCM, as planned."""

from __future__ import annotations

import math
from dataclasses import dataclass

from robot.control.walking.adaptation import cheapest_time, dcm_at_end, error_at_end
from robot.control.walking.dcm import DcmPlan, Point
from robot.control.walking.footsteps import FootstepPlanner, Sole, sign_of
from robot.control.walking.swing import FREEZE_S
from robot.messages import Side

SHORTEST_SHARE, LONGEST_SHARE = 0.5, 1.35
"""Of the planned time: [Khadiv2020] chooses time and place together (docs/control.md, 4)."""
TIME_COST_M_S = 0.1  # 0.1 s off the planned time is as bad as landing 1 cm off the planned place
MISS_WEIGHT = 10.0  # of a landing that the leg cannot reach, or not in time


@dataclass(slots=True)
class Catch:
    """A step under way and the DCM that it leaves, at one instant; all in N.

    Attributes:
        plan: of the DCM, from when the foot lifted.
        planned_s: how long the step was to take.
        past_s: how long it has been under way.
        omega_1_s: the pendulum's frequency.
        gain_1_s: of the DCM's feedback.
        xi: the measured DCM [m].
        zmp: where the ZMP is until the foot lands [m].
        planned: where the foot was to land.
        support: the sole that bears.
        side: of the foot in the air.
        planner: keeps feet apart.
    """

    plan: DcmPlan
    planned_s: float
    past_s: float
    omega_1_s: float
    gain_1_s: float
    xi: Point
    zmp: Point
    planned: Sole
    support: Sole
    side: Side
    planner: FootstepPlanner

    def error(self, xi_ref: Point, zmp_ref: Point, left_s: float) -> Point:
        """How far off the DCM will be at the planned end, which is `left_s` away [m]."""
        (x, y), (zx, zy) = self.xi, self.zmp
        rates = {"omega_1_s": self.omega_1_s, "gain_1_s": self.gain_1_s}
        return (
            error_at_end(x - xi_ref[0], zx - zmp_ref[0], left_s, **rates),
            error_at_end(y - xi_ref[1], zy - zmp_ref[1], left_s, **rates),
        )

    def shift(self, duration_s: float) -> Point:
        """What puts the landing of a step that lasts so long under the DCM as planned [m]."""
        there = dcm_at_end(self.xi, self.zmp, duration_s - self.past_s, self.omega_1_s)
        planned, _ = self.plan.at(self.planned_s)
        return there[0] - planned[0], there[1] - planned[1]

    def best_time(self, x: float, y: float) -> float:
        """The duration at which the step that catches the DCM is nearest to the planned one [s].

        Args:
            x: where the foot is now [m].
            y: likewise.
        """

        def cost(duration_s: float) -> float:
            dx, dy = self.shift(duration_s)
            wanted = Sole(self.planned.x + dx, self.planned.y + dy, self.planned.yaw)
            landing = self.reachable(wanted)
            missed = math.hypot(landing.x - wanted.x, landing.y - wanted.y)
            way = math.hypot(landing.x - x, landing.y - y)
            short = max(
                0.0, way - self.planner.walking.catching.swing_m_s * (duration_s - self.past_s)
            )
            off = TIME_COST_M_S * (duration_s - self.planned_s)
            return MISS_WEIGHT * (missed**2 + short**2) + dx**2 + dy**2 + off**2

        shortest_s = max(SHORTEST_SHARE * self.planned_s, self.past_s + FREEZE_S)
        return cheapest_time(cost, shortest_s, LONGEST_SHARE * self.planned_s)

    def landing(self, shift: Point) -> Sole:
        """The planned landing shifted, but for a deadband, as far as the leg reaches.

        Errors that the next step takes back anyway would only shake the swing foot.
        """
        size = math.hypot(*shift)
        scale = (
            max(0.0, size - self.planner.walking.catching.ignored_m) / size if size > 0.0 else 0.0
        )
        x, y = self.planned.x + scale * shift[0], self.planned.y + scale * shift[1]
        return self.reachable(Sole(x, y, self.planned.yaw))

    def reachable(self, landing: Sole) -> Sole:
        """Keep a landing where the swing leg can put it without crossing the other."""
        s, reach = sign_of(self.side), self.planner.walking.catching
        forward, left, turn = self.support.relative(landing)
        forward = max(-reach.forward_m, min(reach.forward_m, forward))
        width = min(reach.width_m, self.planner.walking.min_stance_width_m)
        left = s * max(width, min(reach.side_m, s * left))
        landing = self.support.offset(forward, left, turn_rad=turn)
        return self.planner.apart(self.support, landing, self.side)
