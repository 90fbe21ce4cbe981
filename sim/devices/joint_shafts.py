"""The joints of a simulated body as the shafts of emulated motors, also through linkages.

An order is handed to the joint's actuator, which applies it in every step of the physics: so the
law runs as fast as the physics does, and stiff gains are integrated implicitly (`sim.motors`). Of a
linkage, cranks stand where its geometry has them, and what their motors give together is worked out
anew in every step: torque at the joints, and so much of it as stiffness as each joint has alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.drivers.motors.linkage import Linkage
from robot.drivers.motors.mounting import Mounted
from robot.se3 import Array
from sim.devices.shaft import LET_GO, Order

STEP_S = 0.001


class JointShaft:
    """One joint, seen through sign, gear and offset of its motor."""

    step_s = STEP_S

    def __init__(self, body: JointShafts, index: int, motor: Mounted) -> None:
        """The joint `index` of a body."""
        self._body, self._index = body, index
        self._turns, self._offset_rad = motor.sign * motor.gear, motor.offset_rad
        self._order = LET_GO

    @property
    def q_rad(self) -> float:
        """The motor's angle, as its encoder tells it."""
        return (self._body.q[self._index] - self._offset_rad) * self._turns

    @property
    def qd_rad_s(self) -> float:
        """The motor's speed."""
        return self._body.qd[self._index] * self._turns

    def turn(self, order: Order, most_nm: float, duration_s: float) -> float:  # noqa: ARG002
        """Hand the order on; the torque is that of the last step of the physics."""
        if order is not self._order and order != self._order:
            self._order, turns = order, self._turns
            stiffness = turns * turns
            self._body.order(
                self._index,
                order.q_rad / turns + self._offset_rad, order.qd_rad_s / turns,
                order.tau_nm * turns, order.kp * stiffness, order.kd * stiffness,
            )  # fmt: skip
        return self._body.tau[self._index] / self._turns


class JointShafts:
    """All joints of a body, and what their motors want of them.

    Attributes:
        q, qd, tau: of joints and of cranks, as measured last, in the motors' order.
        shafts: by joint.
        moves: whether any motor was ever told to give torque.
    """

    def __init__(self, joints: Mapping[str, Mounted], linkages: Iterable[Linkage] = ()) -> None:
        """Nothing is ordered.

        Args:
            joints: of all motors, in the body's order.
            linkages: of some of them.
        """
        count = len(joints)
        order = {name: index for index, name in enumerate(joints)}
        self._linked = [
            (one, np.array([order[name] for name in one.joints], np.intp)) for one in linkages
        ]
        self._felt: list[tuple[Array, Array, Array]] = []
        self.q, self.qd, self.tau = ([0.0] * count for _ in range(3))
        self.moves = False
        self.shafts = {
            name: JointShaft(self, index, motor)
            for index, (name, motor) in enumerate(joints.items())
        }
        self._orders: Array = np.zeros((5, count))
        self._is_new = True
        self._command = MotorCommand.damping(count, 0.0, 0.0)

    def feel(self, state: MotorState) -> None:
        """What the encoders say now."""
        if not self._linked:
            self.q, self.qd, self.tau = state.q.tolist(), state.qd.tolist(), state.tau.tolist()
            return
        q, qd, tau = state.q.copy(), state.qd.copy(), state.tau.copy()
        self._felt.clear()
        for linkage, at in self._linked:
            cranks, jacobian = linkage.at(q[at])
            self._felt.append((q[at], qd[at], jacobian))
            q[at], qd[at] = cranks, jacobian @ qd[at]
            tau[at] = np.linalg.solve(jacobian.T, tau[at])
        self.q, self.qd, self.tau = q.tolist(), qd.tolist(), tau.tolist()

    def order(self, index: int, *values: float) -> None:
        """A motor obeys something new from now on: q_des, qd_des, tau_ff, kp, kd at its joint."""
        self._orders[:, index] = values
        self._is_new = True
        self.moves = self.moves or values[2] != 0.0 or values[3] != 0.0

    def _at_joints(self) -> Array:
        """What is ordered, at the joints: q_des, qd_des, tau_ff, kp, kd."""
        orders = self._orders.copy()
        for (_, at), (q, qd, jacobian) in zip(self._linked, self._felt, strict=True):
            cranks, speeds = np.array(self.q)[at], np.array(self.qd)[at]
            q_des, qd_des, tau, kp, kd = orders[:, at]
            given = kp * (q_des - cranks) + kd * (qd_des - speeds) + tau
            squares = (jacobian * jacobian).T
            orders[:, at] = q, qd, jacobian.T @ given, squares @ kp, squares @ kd
        return orders

    def command(self, now_s: float) -> MotorCommand:
        """All that is ordered; the same arrays as before if nothing is new."""
        if self._is_new:
            self._is_new = bool(self._linked)
            self._command = MotorCommand(now_s, *self._at_joints())
        self._command.stamp_s = now_s
        return self._command
