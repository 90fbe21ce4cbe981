"""Between joints and motors, gears and linkages together; arrays of shape (n,).

    joint  -- linkage -->  crank  -- sign, gear, offset (`Gearing`) -->  motor

Of a joint in a linkage, sign, gear and offset are those of its motor at its crank.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.gearing import Gearing
from robot.drivers.motors.linkage import Linkage, Solved, solved
from robot.drivers.motors.motor_map import MotorMap, linkages_of
from robot.drivers.motors.mounting import Misplaced, Mounted, misplaced
from robot.se3 import Array


class Motion(NamedTuple):
    """What one motor says of itself, or one joint: rad, rad/s, N m."""

    q_rad: float
    qd_rad_s: float
    tau_nm: float


class AtMotors(NamedTuple):
    """What motors are told: shape (n,) each."""

    q: Array
    qd: Array
    kp: Array
    kd: Array
    tau: Array


class _Linked:
    """One linkage, where its joints stand in every array, and how they were last."""

    def __init__(
        self, name: str, linkage: Linkage, places: npt.NDArray[np.intp], middle: Array
    ) -> None:
        self.name, self.linkage, self.places = name, linkage, places
        cranks, jacobian = linkage.at(middle)
        self.now = Solved(middle, cranks, jacobian)
        self.unsolved = 0

    def stand(self, cranks: Array) -> None:
        """Take where the cranks stand; where no joints are, the last ones stay, and it counts."""
        found = solved(self.linkage, cranks, self.now.angles)
        self.unsolved = 0 if found is not None else self.unsolved + 1
        self.now = found or self.now


class Transmission:
    """Of all joints of a map.

    Attributes:
        gearing: of motors at joints, or at cranks.
        most_nm: that each motor gives at its joint or crank, shape (n,).
    """

    def __init__(self, joints: MotorMap) -> None:
        """Of a map's joints, in its order; linkages of which a joint is not in it are left out."""
        self.gearing = Gearing(joints)
        count = len(joints.joints)
        self.most_nm: Array = np.full(count, np.inf)
        motors = joints.joints.values()
        self._kp_most: Array = np.array([one.kp_most for one in motors])
        self._kd_most: Array = np.array([one.kd_most for one in motors])
        order = {name: index for index, name in enumerate(joints.joints)}
        middle = np.array([0.5 * (one.lower_rad + one.upper_rad) for one in motors])
        self._linked: list[_Linked] = []
        for name, linkage in linkages_of(joints).items():
            if all(one in order for one in linkage.joints):
                places = np.array([order[one] for one in linkage.joints], np.intp)
                self._linked.append(_Linked(name, linkage, places, middle[places]))

    @property
    def unsolved(self) -> Iterator[tuple[str, int]]:
        """Linkages, and for how many calls in a row cranks have stood where no joints are."""
        return ((one.name, one.unsolved) for one in self._linked)

    def at_joints(self, q: Array, qd: Array, tau: Array) -> tuple[Array, Array, Array]:
        """Angles, speeds and torques of the joints, from those of the motors."""
        gearing = self.gearing
        q, qd, tau = gearing.joint_q(q), gearing.joint_qd(qd), gearing.joint_tau(tau)
        for one in self._linked:
            at = one.places
            one.stand(q[at])
            q[at], jacobian = one.now.angles, one.now.jacobian
            qd[at] = np.linalg.solve(jacobian, qd[at])
            tau[at] = jacobian.T @ tau[at]
        return q, qd, tau

    def at_motors(self, command: MotorCommand, q: Array, qd: Array) -> AtMotors:
        """What motors are told of a command to the joints.

        Of a linkage, motors get the stiffness that each can have for itself; what couples them, and
        what the angles bend, goes into the torques, at where the joints are now. So the sum is the
        law of the joints at this moment, and as stiff between two commands as motors alone can be.

        Args:
            command: limited.
            q: where the joints are, as `at_joints` said last.
            qd: their speeds.
        """
        gearing = self.gearing
        fields = (command.q_des, command.qd_des, command.kp, command.kd, command.tau_ff)
        if self._linked:
            fields = tuple(field.copy() for field in fields)
            for one in self._linked:
                self._couple(one, command, q, qd, fields)
        q_des, qd_des, kp, kd, tau = fields
        return AtMotors(
            gearing.motor_q(q_des), gearing.motor_qd(qd_des), kp / gearing.stiffness,
            kd / gearing.stiffness, gearing.motor_tau(tau),
        )  # fmt: skip

    def said(self, command: MotorCommand, told: AtMotors, q: Array, qd: Array) -> MotorCommand:
        """What motors were really told, at the joints.

        Of joints in a linkage it is the command, with the torque by which that is the sum of what
        their motors give now.
        """
        gearing = self.gearing
        q_des, qd_des = gearing.joint_q(told.q), gearing.joint_qd(told.qd)
        kp, kd = told.kp * gearing.stiffness, told.kd * gearing.stiffness
        tau = gearing.joint_tau(told.tau)
        for one in self._linked:
            at = one.places
            _, cranks, jacobian = one.now
            speeds = jacobian @ qd[at]
            given = kp[at] * (q_des[at] - cranks) + kd[at] * (qd_des[at] - speeds) + tau[at]
            q_des[at], qd_des[at] = command.q_des[at], command.qd_des[at]
            kp[at], kd[at] = command.kp[at], command.kd[at]
            law = kp[at] * (q_des[at] - q[at]) + kd[at] * (qd_des[at] - qd[at])
            tau[at] = jacobian.T @ given - law
        return MotorCommand(command.stamp_s, q_des, qd_des, tau, kp, kd)

    def _couple(
        self, one: _Linked, command: MotorCommand, q: Array, qd: Array, fields: Sequence[Array]
    ) -> None:
        """Write what the cranks of a linkage are told in place of what its joints are."""
        at, (_, cranks, jacobian) = one.places, one.now
        q_des, qd_des, kp, kd, tau = fields
        back = np.linalg.inv(jacobian)
        law = command.kp[at] * (command.q_des[at] - q[at])
        law += command.kd[at] * (command.qd_des[at] - qd[at]) + command.tau_ff[at]
        wanted = back.T @ law
        share = min(1.0, float(np.min(self.most_nm[at] / np.maximum(np.abs(wanted), 1e-9))))
        # Of back.T K back each motor keeps its own entry, and none that it could not be told.
        stiffness = np.minimum((back * back).T @ command.kp[at], self._kp_most[at]) * share
        damping = np.minimum((back * back).T @ command.kd[at], self._kd_most[at]) * share
        # Where the cranks go is told to first order: the goal may lie where no rod reaches.
        goals = cranks + jacobian @ (command.q_des[at] - q[at])
        paces, speeds = jacobian @ command.qd_des[at], jacobian @ qd[at]
        alone = stiffness * (goals - cranks) + damping * (paces - speeds)
        q_des[at], qd_des[at], kp[at], kd[at] = goals, paces, stiffness, damping
        tau[at] = share * wanted - alone


def joints_of(joints: MotorMap, told: Mapping[str, Motion | None]) -> dict[str, Motion]:
    """Every joint of a map by what its motors say, asked once.

    Args:
        joints: the map.
        told: by its motors, of each joint; None: nothing.

    Returns:
        NaN where a motor did not tell that a joint takes, or where its linkage does not fit.
    """
    nothing = Motion(math.nan, math.nan, math.nan)
    q, qd, tau = np.array([told[name] or nothing for name in joints.joints]).T
    transmission = Transmission(joints)
    rows = np.array(transmission.at_joints(q, qd, tau))
    for linkage, unsolved in transmission.unsolved:
        if unsolved:
            names = linkages_of(joints)[linkage].joints
            rows[:, [name in names for name in joints.joints]] = math.nan
    return {name: Motion(*row) for name, row in zip(joints.joints, rows.T.tolist(), strict=True)}


def placed(joints: MotorMap, told: Mapping[str, Motion | None]) -> dict[str, float | None]:
    """Where joints stand, as `joints_of`; None where nobody can tell without all of a linkage."""
    angles: dict[str, float | None] = {
        name: one.q_rad for name, one in joints_of(joints, told).items()
    }
    for linkage in linkages_of(joints).values():
        if any(name in told and told[name] is None for name in linkage.joints):
            angles |= dict.fromkeys(linkage.joints, None)
    return angles


def where_wrong(joint: Mounted, q_rad: float | None) -> Misplaced | None:
    """What is likely wrong with a joint that stands there (`placed`); None: nothing."""
    if q_rad is None:
        return None
    if math.isnan(q_rad):
        text = "its linkage does not fit: its motors stand where its joints cannot be"
        return Misplaced("linkage", text, "look at signs, offsets and rods in the map")
    return misplaced(joint, q_rad)
