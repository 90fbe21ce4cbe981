"""What a motor turns: a shaft of its own here, a joint of a simulated body elsewhere."""

from __future__ import annotations

from typing import NamedTuple, Protocol


class Order(NamedTuple):
    """What a motor's firmware was told: kp (q - q_now) + kd (qd - qd_now) + tau, at its shaft."""

    q_rad: float = 0.0
    qd_rad_s: float = 0.0
    kp: float = 0.0
    kd: float = 0.0
    tau_nm: float = 0.0


LET_GO = Order()
"""No torque at all."""


class Shaft(Protocol):
    """The output shaft of a motor."""

    @property
    def step_s(self) -> float:
        """How often the firmware's loop runs."""
        ...

    @property
    def q_rad(self) -> float:
        """Its angle."""
        ...

    @property
    def qd_rad_s(self) -> float:
        """Its speed."""
        ...

    def turn(self, order: Order, most_nm: float, duration_s: float) -> float:
        """Let the motor act by an order for a while, at most a millisecond.

        Args:
            order: in force.
            most_nm: torque that the motor can give.
            duration_s: for so long.

        Returns:
            The torque that it gives.
        """
        ...


class FreeShaft:
    """A flywheel with viscous friction, and a spring back to where it began: a motor on a bench."""

    step_s: float = 0.0005
    """A real one's loop runs at 20 kHz."""

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

    def turn(self, order: Order, most_nm: float, duration_s: float) -> float:
        """Semi-implicit Euler, friction at the end of the step."""
        torque_nm = (
            order.kp * (order.q_rad - self.q_rad)
            + order.kd * (order.qd_rad_s - self.qd_rad_s)
            + order.tau_nm
        )
        torque_nm = max(-most_nm, min(most_nm, torque_nm))
        gained = duration_s * self._gained
        sprung_nm = self._spring_nm_rad * (self._middle_rad - self.q_rad)
        slowed = 1.0 + gained * self._friction_nm_s
        self.qd_rad_s = (self.qd_rad_s + gained * (torque_nm + sprung_nm)) / slowed
        self.q_rad += duration_s * self.qd_rad_s
        return torque_nm
