"""Models of the X series with control of current, as data: what ROBOTIS says of them.

Torque is taken as proportional to current, by the ratio at stall that the e-manual prints: friction
of the gears is in it, so a servo that turns gives less, and one that is turned holds more.
"""

from __future__ import annotations

import math
from typing import NamedTuple

PULSES_A_TURN = 4096
RAD_A_PULSE = 2.0 * math.pi / PULSES_A_TURN
RAD_S_A_STEP = 0.229 * 2.0 * math.pi / 60.0
"""Of velocities, e-manual: 0.229 rev/min."""


class Model(NamedTuple):
    """A model of servo, at its recommended voltage.

    Attributes:
        number: what it tells as its model.
        stall_nm, stall_a: at standstill.
        speed_rev_min: without load.
        current_step_a: unit of its currents.
        current_steps: the largest that its CURRENT_LIMIT takes, as it is sold.
        volts: recommended.
        source: of these figures.
    """

    number: int
    stall_nm: float
    stall_a: float
    speed_rev_min: float
    current_step_a: float
    current_steps: int
    volts: float
    source: str

    @property
    def nm_a_step(self) -> float:
        """Torque of one step of current."""
        return self.current_step_a * self.stall_nm / self.stall_a

    @property
    def torque_nm(self) -> float:
        """The most it gives: at stall, and within its limit of current."""
        return min(self.stall_nm, self.nm_a_step * self.current_steps)

    @property
    def velocity_rad_s(self) -> float:
        """The fastest it turns."""
        return self.speed_rev_min * 2.0 * math.pi / 60.0


_PAGE = "ROBOTIS e-manual, docs/en/dxl/x/"
_LARGE = 2.69e-3

MODELS: dict[str, Model] = {
    "XL330-M077": Model(1190, 0.215, 1.47, 383, 1e-3, 1750, 5.0, f"{_PAGE}xl330-m077"),
    "XL330-M288": Model(1200, 0.52, 1.47, 103, 1e-3, 1750, 5.0, f"{_PAGE}xl330-m288"),
    "XC330-M181": Model(1230, 0.60, 1.80, 129, 1e-3, 2352, 5.0, f"{_PAGE}xc330-m181"),
    "XC330-M288": Model(1240, 0.93, 1.80, 81, 1e-3, 2352, 5.0, f"{_PAGE}xc330-m288"),
    "XM430-W210": Model(1030, 3.0, 2.3, 77, _LARGE, 1193, 12.0, f"{_PAGE}xm430-w210"),
    "XM430-W350": Model(1020, 4.1, 2.3, 46, _LARGE, 1193, 12.0, f"{_PAGE}xm430-w350"),
    "XM540-W150": Model(1130, 7.3, 4.4, 53, _LARGE, 2047, 12.0, f"{_PAGE}xm540-w150"),
    "XM540-W270": Model(1120, 10.6, 4.4, 30, _LARGE, 2047, 12.0, f"{_PAGE}xm540-w270"),
    "XW540-T140": Model(1180, 6.9, 4.9, 72, _LARGE, 2047, 12.0, f"{_PAGE}xw540-t140"),
    "XW540-T260": Model(1170, 9.5, 4.9, 40, _LARGE, 2047, 12.0, f"{_PAGE}xw540-t260"),
}

NAMES: dict[int, str] = {model.number: name for name, model in MODELS.items()}
"""By the number that a servo tells."""
