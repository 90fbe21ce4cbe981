"""Whole-body control: one quadratic programme from tasks to joint torques.

Inverse dynamics with contact wrenches (Herzog et al., "Momentum control with hierarchical inverse
dynamics on a torque-controlled humanoid", 2016; here weighted, not hierarchical). Unknowns are the
accelerations of base, legs and waist and a wrench [N, N m] at each sole in contact, in the sole's
own axes. Arms and head follow prescribed accelerations; their coupling enters as known terms.

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
from robot.model.body import SIDES, BodyModel
from robot.se3 import Array

STANCE_WEIGHT = 2000.0
GRAVITY_M_S2 = 9.81
COM_WEIGHT = 50.0
SWING_WEIGHT = 20.0
PELVIS_WEIGHT = 4.0
WAIST_WEIGHT = 4.0
POSTURE_WEIGHT = 0.02
FORCE_WEIGHT = 1e-5
FRICTION = 0.6
YAW_FRICTION_M = 0.04
COP_MARGIN_M = 0.005
CONE_ROWS = 11


@dataclass(slots=True)
class Task:
    """What the body should do this tick; accelerations in N unless said.

    Attributes:
        com_acc: of the centre of mass [m/s2], shape (3,).
        pelvis_acc_B: angular, in B [rad/s2], shape (3,).
        posture_acc: of every active joint [rad/s2], shape (active joints,).
        sole_acc: linear over angular of each sole [m/s2, rad/s2], each (6,): what keeps a foot in
            contact still, or moves a swinging one.
        contact: which feet bear on the floor.
        max_force_n: cap on each foot's normal force.
        rest_acc: of the joints that are not active, by dof, shape (nv,).
    """

    com_acc: Array
    pelvis_acc_B: Array
    posture_acc: Array
    sole_acc: list[Array]
    contact: list[bool]
    max_force_n: list[float]
    rest_acc: Array


@dataclass(slots=True)
class Solution:
    """Torques and accelerations by dof, shape (nv,); wrenches of the soles; solver's flag."""

    tau: Array
    acc: Array
    wrench: list[Array] = field(default_factory=lambda: [np.zeros(6), np.zeros(6)])
    ok: bool = True


class WholeBody:
    """Builds and solves the programme; keeps its matrices."""

    def __init__(self, body: BodyModel) -> None:
        """Take the active joints (legs, waist) and limits from the description."""
        self.body = body
        description = body.description
        active = [
            i for group in ("left_leg", "right_leg", "waist") for i in description.indices(group)
        ]
        self.active_motors = np.array(active)
        self.dofs: NDArray[np.int64] = np.concatenate([np.arange(6), body.dof_of[active]])
        self.active_qpos = as_index(body.qpos_of[active])
        self.active_dofs = as_index(body.dof_of[active])
        self.waist = slice(len(active) - len(description.groups["waist"]), len(active))
        self.torque_limit = 0.95 * body.torque_limit_nm[active]
        self.size = len(self.dofs)
        weights = np.full(len(active), POSTURE_WEIGHT)
        weights[self.waist] = WAIST_WEIGHT
        self._posture_weight = weights
        self._cones = [self._cone(i) for i in range(2)]
        self._programmes = {n: self._allocate(n) for n in (0, 1, 2)}
        self._own = as_index(self.dofs)
        own = set(self.dofs.tolist())
        self._rest = as_index(np.array([dof for dof in range(body.model.nv) if dof not in own]))
        self._sites = [body.sole_site[side] for side in SIDES]
        self._rows: Array = np.zeros((15, self.size))
        self._b: Array = np.zeros(15)
        self._w: Array = np.full(15, COM_WEIGHT)
        self._local: list[Array] = [np.zeros((6, self.size)) for _ in SIDES]
        self._regular: Array = np.concatenate(
            [np.full(3, 1e-6), np.full(3, PELVIS_WEIGHT), weights]
        )

    def _cone(self, foot: int) -> Array:
        """Rows C with C w <= 0 for a wrench w = (fx, fy, fz, tx, ty, tz) in the sole's axes."""
        shape = self.body.description.feet[SIDES[foot]]
        half_x, half_y = shape.half_length_m - COP_MARGIN_M, shape.half_width_m - COP_MARGIN_M
        rows: list[list[float]] = []
        for sign in (1.0, -1.0):
            rows.append([sign, 0, -FRICTION, 0, 0, 0])
            rows.append([0, sign, -FRICTION, 0, 0, 0])
            rows.append([0, 0, -half_y, sign, 0, 0])
            rows.append([0, 0, -half_x, 0, sign, 0])
            rows.append([0, 0, -YAW_FRICTION_M, 0, 0, sign])
        rows.append([0, 0, 1, 0, 0, 0])  # the cap: its bound is set every tick
        return np.array(rows)

    def _allocate(self, feet: int) -> dict[str, Any]:
        """Matrices for `feet` feet in contact; constant rows filled in."""
        n, joints = self.size + 6 * feet, self.size - 6
        rows = 6 + joints + CONE_ROWS * feet
        lower = np.full(rows, -1e30)
        upper = np.full(rows, 1e30)
        upper[6 + joints :] = 0.0
        sense = np.zeros(rows, dtype=np.int32)
        sense[:6] = 5  # equalities
        H = np.zeros((n, n))
        diagonal = np.einsum("ii->i", H)
        diagonal[self.size :] = FORCE_WEIGHT
        return {
            "H": H,
            "H_own": H[: self.size, : self.size],
            "diagonal": diagonal,
            "g": np.zeros(n),
            "A": np.zeros((rows, n)),
            "lower": lower,
            "upper": upper,
            "sense": sense,
        }

    def solve(self, dynamics: Dynamics, task: Task) -> Solution:
        """Solve for this tick; `ok` is False where the programme has no solution."""
        feet = [i for i in range(2) if task.contact[i]]
        programme = self._programmes[len(feet)]
        own, rest, size = self._own, self._rest, self.size
        M_own, h = dynamics.M[own], dynamics.h
        M = M_own[:, own]
        known = h[own] + M_own[:, rest] @ task.rest_acc[rest]
        jac = [dynamics.jac_sole[i][:, own] for i in range(2)]
        self._objective(programme, task, bias=dynamics.bias_sole, jac=jac, M=M, known=known)
        contact_jac: list[Array] = []
        for i in feet:
            rotation = dynamics.data.site_xmat[self._sites[i]].reshape(3, 3).T
            local = self._local[i]
            np.matmul(rotation, jac[i][:3], out=local[:3])
            np.matmul(rotation, jac[i][3:], out=local[3:])
            contact_jac.append(local)
        self._constraints(programme, task, feet=feet, M=M, known=known, contact_jac=contact_jac)
        result = cast(
            "tuple[Array, float, int, Any]",
            daqp.solve(  # pyright: ignore
                programme["H"],
                programme["g"],
                programme["A"],
                programme["upper"],
                programme["lower"],
                programme["sense"],
            ),
        )
        x = result[0]
        solution = Solution(np.zeros_like(h), task.rest_acc.copy())
        if result[2] <= 0 or not math.isfinite(float(x.sum())):
            solution.ok = False
            return solution
        solution.acc[own] = x[:size]
        tau = M @ x[:size] + known
        for k, i in enumerate(feet):
            wrench = x[size + 6 * k : size + 6 * k + 6]
            tau -= wrench @ contact_jac[k]
            solution.wrench[i] = wrench
        solution.tau[own] = tau
        solution.tau[:6] = 0.0
        solution.tau[rest] = dynamics.M[rest] @ solution.acc + h[rest]
        return solution

    def _objective(
        self,
        programme: dict[str, Any],
        task: Task,
        *,
        bias: list[Array],
        jac: list[Array],
        M: Array,
        known: Array,
    ) -> None:
        """Fill H and g with the weighted tasks."""
        size, mass = self.size, self.body.mass_kg
        g, rows, target, weight = programme["g"], self._rows, self._b, self._w
        np.divide(M[:3], mass, out=rows[:3])
        target[:3] = task.com_acc - known[:3] / mass
        target[2] += GRAVITY_M_S2
        for i in range(2):
            start = 3 + 6 * i
            rows[start : start + 6] = jac[i]
            target[start : start + 6] = task.sole_acc[i] - bias[i]
            weight[start : start + 6] = STANCE_WEIGHT if task.contact[i] else SWING_WEIGHT
        weighted = rows.T * weight
        np.matmul(weighted, rows, out=programme["H_own"])
        gradient = weighted @ target
        diagonal = programme["diagonal"]
        diagonal[:size] += self._regular
        gradient[3:6] += PELVIS_WEIGHT * task.pelvis_acc_B
        gradient[6:] += self._posture_weight * task.posture_acc
        np.negative(gradient, out=g[:size])

    def _constraints(
        self,
        programme: dict[str, Any],
        task: Task,
        *,
        feet: list[int],
        M: Array,
        known: Array,
        contact_jac: list[Array],
    ) -> None:
        """Fill A and its bounds: dynamics, torques, cones, and the cap on normal forces."""
        size = self.size
        joints = size - 6
        A, lower, upper = programme["A"], programme["lower"], programme["upper"]
        A[: 6 + joints, :size] = M
        for k, local in enumerate(contact_jac):
            column = size + 6 * k
            A[: 6 + joints, column : column + 6] = -local.T
            row = 6 + joints + CONE_ROWS * k
            A[row : row + CONE_ROWS, column : column + 6] = self._cones[feet[k]]
            upper[row + CONE_ROWS - 1] = task.max_force_n[feet[k]]
        lower[:6] = upper[:6] = -known[:6]
        limit = self.torque_limit
        lower[6 : 6 + joints] = -limit - known[6:]
        upper[6 : 6 + joints] = limit - known[6:]


def as_index(indices: NDArray[np.int64]) -> slice | NDArray[np.int64]:
    """A slice where the indices run on without a gap (views instead of copies), else themselves."""
    first, last = int(indices[0]), int(indices[-1])
    if np.array_equal(indices, np.arange(first, last + 1)):
        return slice(first, last + 1)
    return indices
