"""What a motor turns: a shaft of its own here, a joint of a simulated body elsewhere."""

from __future__ import annotations

from typing import Protocol


class Shaft(Protocol):
    """The output shaft of a motor."""

    @property
    def q_rad(self) -> float:
        """Its angle."""
        ...

    @property
    def qd_rad_s(self) -> float:
        """Its speed."""
        ...

    def turn(self, torque_nm: float, duration_s: float) -> None:
        """Apply a torque for a while, at most a millisecond."""
        ...


class FreeShaft:
    """A flywheel with viscous friction, and a spring back to where it began: a motor on a bench."""

    def __init__(
        self,
        *,
        q_rad: float = 0.0,
        inertia_kg_m2: float = 0.01,
        friction_nm_s: float = 0.0,
        spring_nm_rad: float = 0.0,
    ) -> None:
        """At rest; somebody may turn it by setting `qd_rad_s`."""
        self.q_rad = self._middle_rad = q_rad
        self.qd_rad_s = 0.0
        self._gained = 1.0 / inertia_kg_m2
        self._friction_nm_s, self._spring_nm_rad = friction_nm_s, spring_nm_rad

    def turn(self, torque_nm: float, duration_s: float) -> None:
        """Semi-implicit Euler, friction at the end of the step."""
        gained = duration_s * self._gained
        sprung_nm = self._spring_nm_rad * (self._middle_rad - self.q_rad)
        slowed = 1.0 + gained * self._friction_nm_s
        self.qd_rad_s = (self.qd_rad_s + gained * (torque_nm + sprung_nm)) / slowed
        self.q_rad += duration_s * self.qd_rad_s
