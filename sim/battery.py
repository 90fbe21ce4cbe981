"""An emulated battery: what the motors and the computers draw, and how much is left.

Not a model of any cell: energy in, energy out, no voltage. It is there so that the executive has a
charge to reckon with.
"""

from __future__ import annotations

import numpy as np

from robot.messages import PowerState
from robot.model.description import Battery as Described
from robot.se3 import Array

JOULE_A_WH = 3600.0


class Battery:
    """Charge as a part of the whole, 1 when full.

    Attributes:
        charge: what is left, 0 to 1.
        power_w: what was drawn last.
    """

    def __init__(self, described: Described) -> None:
        """Begin fully charged."""
        self.charge = 1.0
        self.power_w = described.idle_w
        self._described = described

    def draw(self, torque_nm: Array, speed_rad_s: Array, load: Array, *, duration_s: float) -> None:
        """Let the motors draw for a while.

        Args:
            torque_nm: of every motor.
            speed_rad_s: of every motor; what a motor brakes is not fed back.
            load: torque as a part of each motor's limit, for the heat of holding still.
            duration_s: how long.
        """
        known = self._described
        work_w = float(np.maximum(torque_nm * speed_rad_s, 0.0).sum()) / known.efficiency
        heat_w = known.stall_w * float(np.square(load).sum())
        self.power_w = known.idle_w + work_w + heat_w
        used = self.power_w * duration_s / (known.capacity_wh * JOULE_A_WH)
        self.charge = max(0.0, self.charge - used)

    def report(self, stamp_s: float) -> PowerState:
        """The message."""
        charge, power_w = round(self.charge, 6), round(self.power_w, 2)
        return PowerState(stamp_s=stamp_s, charge=charge, power_w=power_w, source="emulated")
