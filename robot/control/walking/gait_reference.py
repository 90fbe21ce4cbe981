"""What the gait wants of the body at one instant, between the feet and the whole-body task."""

from __future__ import annotations

from dataclasses import dataclass

from robot.control.walking.dcm import Point
from robot.control.walking.swing import Swing
from robot.messages import Side


@dataclass(slots=True)
class Reference:
    """What the gait wants of the body now; all in N.

    `strain` says how far the commanded ZMP lies beyond the soles, 0 to 1: what the trunk's turning
    must give.
    """

    xi: Point
    zmp: Point
    zmp_command: Point
    contact: list[bool]
    max_force_share: list[float]
    heading_rad: float
    strain: float = 0.0
    swing: Swing | None = None
    swing_side: Side | None = None
