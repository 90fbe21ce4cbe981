"""Whole-body control: one quadratic programme from tasks to joint torques.

Inverse dynamics with contact wrenches (Herzog et al., "Momentum control with hierarchical inverse
dynamics on a torque-controlled humanoid", 2016; here weighted, not hierarchical). Unknowns are the
accelerations of base, legs and waist and a wrench [N, N m] at each sole in contact, in the axes of
N. Arms and head follow prescribed accelerations; their coupling enters as known terms.

    minimise   sum_i w_i |A_i x - b_i|^2
    subject to the six rows of the base's dynamics, torque limits, friction pyramid, centre of
    pressure inside the sole, a cap on each foot's normal force
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, cast

import daqp  # pyright: ignore[reportMissingTypeStubs]
import numpy as np
from numpy.typing import NDArray

from robot.kinematics.dynamics import Dynamics
from robot.model.body import SIDES, BodyModel, as_index
from robot.physics import GRAVITY_M_S2
from robot.se3 import Array

STANCE_WEIGHT = 2000.0
"""Weights count against one another only. Soles that stand come first, then balance. They are those
of a study with a body of 1.3 m and 35 kg (docs/control.md), and serve the G1 as well."""
COM_WEIGHT = 50.0  # with 10 the DCM was 15 mm off at 0.5 m/s, so it is 5 mm
SWING_WEIGHT = 20.0
PELVIS_WEIGHT = 4.0
STRAINED_COM_WEIGHT = 1000.0  # with a push to catch, turning the trunk is worth its while:
STRAINED_PELVIS_WEIGHT = 1.0  # of 64 pushes by 10 N s while walking 61 were caught, without 48
STRAINED_SWING_WEIGHT = 60.0  # else the foot that is to catch it hovers short of the floor
WAIST_WEIGHT = 4.0
POSTURE_WEIGHT = 0.02
FORCE_WEIGHT = 1e-5
"""Next to nothing: it only chooses among wrenches that are as good."""
CONE_ROWS = 17  # friction 4, centre of pressure 4, turning 8, the cap
EQUALITY = 5  # DAQP's mark of a row that is always active
KEEP_EQUALITIES = -1  # DAQP eliminates none of them first, which for six costs more than it saves


@dataclass(slots=True)
class Task:
    """What the body should do this tick; accelerations in N unless said.

    Attributes:
        com_acc: of the centre of mass [m/s2], shape (3,).
        own_acc: of the pelvis [rad/s2], angular, in B, then of every active joint [rad/s2], shape
            (3 + active joints,).
        sole_acc: linear over angular of the left, then the right sole [m/s2, rad/s2], shape (12,):
            what keeps a foot in contact still, or moves a swinging one.
        contact: which feet bear on the floor.
        max_force_n: cap on each foot's normal force.
        rest_acc: of the joints that are not active, by dof, shape (nv,); 0 for those that are.
        strain: 0 to 1, how much the centre of mass comes before an upright trunk.
    """

    com_acc: Array
    own_acc: Array
    sole_acc: Array
    contact: list[bool]
    max_force_n: list[float]
    rest_acc: Array
    strain: float = 0.0


@dataclass(slots=True)
class Solution:
    """Torques and accelerations by dof, shape (nv,); wrenches at the soles in N; solver's flag."""

    tau: Array
    acc: Array
    wrench: list[Array] = field(default_factory=lambda: [np.zeros(6), np.zeros(6)])
    ok: bool = True


@dataclass(slots=True)
class _Programme:
    """The matrices for one set of feet in contact, and views of the blocks that change."""

    feet: list[int]
    H: Array
    H_own: Array
    diagonal: Array
    g: Array
    A: Array
    A_mass: Array
    A_wrench: Array
    A_cone: list[Array]
    cap_rows: list[int]
    lower: Array
    upper: Array
    sense: NDArray[np.int32]
    jac_rows: slice
    weight: Array


class WholeBody:
    """Builds and solves the programme; keeps its matrices."""

    def __init__(self, body: BodyModel) -> None:
        """Take the active joints (legs, waist) and limits from the description."""
        self.body = body
        description = body.description
        active = [
            i for group in ("left_leg", "right_leg", "waist") for i in description.indices(group)
        ]
        self.active_motors = as_index(np.array(active))
        self.dofs: NDArray[np.int64] = np.concatenate([np.arange(6), body.dof_of[active]])
        self.active_qpos = as_index(body.qpos_of[active])
        self.active_dofs = as_index(body.dof_of[active])
        self.active_count = len(active)
        self.waist = slice(len(active) - len(description.groups["waist"]), len(active))
        self.size = len(self.dofs)
        limit = 0.95 * body.torque_limit_nm[active]
        self._upper: Array = np.concatenate([np.zeros(6), limit])
        self._lower: Array = -self._upper
        joint_weights = np.full(len(active), POSTURE_WEIGHT)
        joint_weights[self.waist] = WAIST_WEIGHT
        self._own_weight: Array = np.concatenate([np.full(3, PELVIS_WEIGHT), joint_weights])
        self._regular: Array = np.concatenate([np.full(3, 1e-6), self._own_weight])
        self._cones = [self._cone(i).reshape(-1, 3) for i in range(2)]
        self._own = as_index(self.dofs)
        patterns = [(True, True), (True, False), (False, True), (False, False)]
        self._programmes = {pattern: self._allocate(pattern) for pattern in patterns}
        self._strain = 0.0
        self._rows: Array = np.zeros((15, self.size))
        self._weighted: Array = np.zeros((15, self.size))
        self._b: Array = np.zeros(15)

    def _cone(self, foot: int) -> Array:
        """Rows C with C w <= 0 for a wrench w = (fx, fy, fz, tx, ty, tz) in the sole's axes.

        What four corners with friction can bear: a sole that stands on one of them alone resists no
        turning, and spins. Caron et al., "Stability of surface contacts for humanoid robots:
        closed-form formulae of the contact wrench cone for rectangular support areas", 2015.
        """
        shape = self.body.description.feet[SIDES[foot]]
        balance = self.body.description.balance
        half_x = shape.half_length_m - balance.cop_margin_m
        half_y = shape.half_width_m - balance.cop_margin_m
        friction = balance.friction
        rows: list[list[float]] = []
        for sign in (1.0, -1.0):
            rows.append([sign, 0, -friction, 0, 0, 0])
            rows.append([0, sign, -friction, 0, 0, 0])
            rows.append([0, 0, -half_y, sign, 0, 0])
            rows.append([0, 0, -half_x, 0, sign, 0])
            about, held = friction * sign, -friction * (half_x + half_y)
            for a in (1.0, -1.0):
                for b in (1.0, -1.0):
                    rows.append([a * half_y, b * half_x, held, a * about, b * about, sign])
        rows.append([0, 0, 1, 0, 0, 0])  # the cap: its bound is set every tick
        return np.array(rows)

    def _allocate(self, contact: tuple[bool, bool]) -> _Programme:
        """Matrices for these feet in contact; constant entries filled in."""
        feet = [i for i in range(2) if contact[i]]
        size = self.size
        n, rows = size + 6 * len(feet), size + CONE_ROWS * len(feet)
        lower, upper = np.full(rows, -1e30), np.zeros(rows)
        sense = np.zeros(rows, dtype=np.int32)
        sense[:6] = EQUALITY
        H, A = np.zeros((n, n)), np.zeros((rows, n))
        diagonal = np.einsum("ii->i", H)
        diagonal[size:] = FORCE_WEIGHT
        starts = [size + CONE_ROWS * k for k in range(len(feet))]
        sole_weights = [STANCE_WEIGHT if bears else SWING_WEIGHT for bears in contact]
        return _Programme(
            feet=feet,
            H=H,
            H_own=H[:size, :size],
            diagonal=diagonal[:size],
            g=np.zeros(n),
            A=A,
            A_mass=A[:size, :size],
            A_wrench=A[:size, size:],
            A_cone=[
                A[start : start + CONE_ROWS, size + 6 * k : size + 6 * k + 6]
                for k, start in enumerate(starts)
            ],
            cap_rows=[start + CONE_ROWS - 1 for start in starts],
            lower=lower,
            upper=upper,
            sense=sense,
            jac_rows=slice(6 * min(feet, default=0), 6 * (max(feet, default=-1) + 1)),
            weight=np.repeat([COM_WEIGHT, *sole_weights], [3, 6, 6]).reshape(-1, 1),
        )

    def solve(self, dynamics: Dynamics, task: Task) -> Solution:
        """Solve for this tick; `ok` is False where the programme has no solution."""
        left, right = task.contact
        programme = self._programmes[left, right]
        if task.strain != self._strain:
            self._weigh(task.strain)
        own, size = self._own, self.size
        # Products as methods and sums in place: without numpy's dispatch a tick takes 0.65 of it.
        M_own = dynamics.M[own]
        known = M_own.dot(task.rest_acc)
        known += dynamics.h[own]
        M, jac = M_own[:, own], dynamics.jac[:, own]
        self._objective(programme, task, bias=dynamics.bias, jac=jac, M=M, known=known)
        self._constraints(programme, task, dynamics, jac=jac, M=M, known=known)
        result = cast(
            "tuple[Array, float, int, Any]",
            daqp.solve(  # pyright: ignore
                programme.H,
                programme.g,
                programme.A,
                programme.upper,
                programme.lower,
                programme.sense,
                eq_reduction=KEEP_EQUALITIES,
            ),
        )
        x = result[0]
        if result[2] <= 0 or not math.isfinite(np.add.reduce(x)):
            return Solution(np.zeros_like(dynamics.h), task.rest_acc.copy(), ok=False)
        acc = task.rest_acc.copy()
        acc[own] = x[:size]
        tau = dynamics.M.dot(acc)
        tau += dynamics.h
        tau[own] = programme.A[:size].dot(x) + known
        tau[:6] = 0.0
        solution = Solution(tau, acc)
        for k, i in enumerate(programme.feet):
            solution.wrench[i] = x[size + 6 * k : size + 6 * k + 6]
        return solution

    def _weigh(self, strain: float) -> None:
        """Between upright and at rest, and whatever keeps it from falling."""
        self._strain = strain
        com = COM_WEIGHT * (STRAINED_COM_WEIGHT / COM_WEIGHT) ** strain
        pelvis = PELVIS_WEIGHT * (STRAINED_PELVIS_WEIGHT / PELVIS_WEIGHT) ** strain
        swing = SWING_WEIGHT * (STRAINED_SWING_WEIGHT / SWING_WEIGHT) ** strain
        for bears, programme in self._programmes.items():
            programme.weight[:3] = com
            for i in (0, 1):
                if not bears[i]:
                    programme.weight[3 + 6 * i : 9 + 6 * i] = swing
        self._own_weight[:3] = self._regular[3:6] = pelvis

    def _objective(
        self,
        programme: _Programme,
        task: Task,
        *,
        bias: Array,
        jac: Array,
        M: Array,
        known: Array,
    ) -> None:
        """Fill H and g with the weighted tasks: rows x = -b."""
        size, mass = self.size, self.body.mass_kg
        rows, weighted, b = self._rows, self._weighted, self._b
        np.divide(M[:3], mass, out=rows[:3])
        rows[3:] = jac
        np.divide(known[:3], mass, out=b[:3])
        b[2] -= GRAVITY_M_S2
        b[:3] -= task.com_acc
        np.subtract(bias, task.sole_acc, out=b[3:])
        np.multiply(rows, programme.weight, out=weighted)
        np.matmul(weighted.T, rows, out=programme.H_own)
        diagonal = programme.diagonal
        diagonal += self._regular
        gradient = programme.g[:size]
        b.dot(weighted, out=gradient)
        gradient[3:] -= self._own_weight * task.own_acc

    def _constraints(
        self,
        programme: _Programme,
        task: Task,
        dynamics: Dynamics,
        *,
        jac: Array,
        M: Array,
        known: Array,
    ) -> None:
        """Fill A and its bounds: dynamics, torques, cones, and the cap on normal forces."""
        size, lower, upper = self.size, programme.lower, programme.upper
        programme.A_mass[:] = M
        np.negative(jac[programme.jac_rows].T, out=programme.A_wrench)
        for k, i in enumerate(programme.feet):
            cone = self._cones[i].dot(dynamics.sole_rotation[i].T)
            programme.A_cone[k][:] = cone.reshape(CONE_ROWS, 6)
            upper[programme.cap_rows[k]] = task.max_force_n[i]
        np.subtract(self._lower, known, out=lower[:size])
        np.subtract(self._upper, known, out=upper[:size])
