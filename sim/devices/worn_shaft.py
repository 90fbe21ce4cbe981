"""A shaft that is no longer new: friction, backlash, and a motor that obeys late."""

from __future__ import annotations

import math
from collections import deque

from sim.devices.shaft import LET_GO, Order


class WornShaft:
    """A flywheel with Coulomb and viscous friction, and play before the encoder.

    The encoder is the motor's: it lies on one flank of the play or the other, as the torque does,
    and as in a simulated body (`sim.body_sensors`). The motor's law is closed over what the joint
    does.

    Attributes:
        worn_nm, viscous_nm_s: friction.
        play_rad: between motor and joint, all of it.
        late_s: from an order to its torque.
    """

    step_s: float = 0.0005

    def __init__(
        self,
        *,
        q_rad: float = 0.0,
        inertia_kg_m2: float = 0.01,
        worn_nm: float = 0.0,
        viscous_nm_s: float = 0.0,
        play_rad: float = 0.0,
        flank_nm: float = 0.05,
        late_s: float = 0.0,
        spring_nm_rad: float = 0.0,
    ) -> None:
        """At rest."""
        self._true_rad = self._middle_rad = q_rad
        self.qd_rad_s = 0.0
        self.worn_nm, self.viscous_nm_s = worn_nm, viscous_nm_s
        self.play_rad, self.late_s = play_rad, late_s
        self._inertia, self._flank_nm = inertia_kg_m2, flank_nm
        self._spring_nm_rad = spring_nm_rad
        self._torque_nm = self._passed_s = 0.0
        self._orders: deque[tuple[float, Order]] = deque()
        self._last = self._obeyed = LET_GO

    @property
    def q_rad(self) -> float:
        """What its encoder says."""
        return self._true_rad + 0.5 * self.play_rad * math.tanh(self._torque_nm / self._flank_nm)

    def turn(self, order: Order, most_nm: float, duration_s: float) -> float:
        """Semi-implicit Euler; friction takes what speed there is, and holds what has none."""
        if order != self._last:
            self._last = order
            self._orders.append((self._passed_s + self.late_s, order))
        while self._orders and self._orders[0][0] <= self._passed_s + 1e-9:
            self._obeyed = self._orders.popleft()[1]
        obeyed = self._obeyed
        torque_nm = (
            obeyed.kp * (obeyed.q_rad - self._true_rad)
            + obeyed.kd * (obeyed.qd_rad_s - self.qd_rad_s)
            + obeyed.tau_nm
        )
        self._torque_nm = max(-most_nm, min(most_nm, torque_nm))
        sprung_nm = self._spring_nm_rad * (self._middle_rad - self._true_rad)
        gained = duration_s / self._inertia
        speed = self.qd_rad_s + gained * (self._torque_nm + sprung_nm)
        speed /= 1.0 + gained * self.viscous_nm_s
        held = gained * self.worn_nm
        self.qd_rad_s = math.copysign(max(0.0, abs(speed) - held), speed)
        self._true_rad += duration_s * self.qd_rad_s
        self._passed_s += duration_s
        return self._torque_nm
