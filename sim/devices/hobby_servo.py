"""A hobby servo: it goes where its pulses say, at its own speed, and tells nobody."""

from __future__ import annotations

from sim.devices.pca9685 import Pca9685Chip
from sim.devices.shaft import LET_GO, Order, Shaft

STIFF_RAD = 0.05
"""So far from where it is sent it gives all its torque."""
NOTICES_S = 0.1
"""After so long without a pulse it lets go."""
SHORTEST_S, LONGEST_S = 0.3e-3, 3.0e-3


class HobbyServo:
    """On an output of a chip.

    Attributes:
        shaft: what it turns.
        target_rad: where it is sent; None: it gets no pulses, and gives no torque.
        tau_nm: that it gives.
    """

    def __init__(
        self, chip: Pca9685Chip, channel: int, shaft: Shaft, *, pulse_us: tuple[float, float],
        travel_rad: float, speed_rad_s: float, torque_nm: float, now_s: float,
    ) -> None:  # fmt: skip
        """Plug it in."""
        self.chip, self.channel, self.shaft = chip, channel, shaft
        self.target_rad: float | None = None
        self.tau_nm = 0.0
        self._pulse_us, self._travel_rad = pulse_us, travel_rad
        self._speed_rad_s, self._torque_nm = speed_rad_s, torque_nm
        self._lived_s = self._pulsed_s = now_s
        self._goes_rad = shaft.q_rad

    @property
    def is_on(self) -> bool:
        """Whether it gives torque."""
        return self.target_rad is not None

    def live(self, until_s: float) -> None:
        """Let time go by up to a moment."""
        span_s = self.shaft.step_s
        while self._lived_s + span_s <= until_s + 1e-9:
            self._lived_s += span_s
            self._look()
            self.tau_nm = self.shaft.turn(self._order(span_s), self._torque_nm, span_s)

    def _look(self) -> None:
        pulse_s = self.chip.pulse_s(self.channel, self._lived_s)
        if pulse_s is not None and SHORTEST_S <= pulse_s <= LONGEST_S:
            low, high = self._pulse_us
            share = min(1.0, max(0.0, (1e6 * pulse_s - low) / (high - low)))
            if self.target_rad is None:
                self._goes_rad = self.shaft.q_rad
            self.target_rad, self._pulsed_s = (share - 0.5) * self._travel_rad, self._lived_s
        elif self._lived_s - self._pulsed_s > NOTICES_S:
            self.target_rad = None

    def _order(self, span_s: float) -> Order:
        if self.target_rad is None:
            return LET_GO
        step = self._speed_rad_s * span_s
        self._goes_rad += max(-step, min(step, self.target_rad - self._goes_rad))
        stiffness = self._torque_nm / STIFF_RAD
        return Order(q_rad=self._goes_rad, kp=stiffness, kd=0.05 * stiffness)
