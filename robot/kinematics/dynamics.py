"""Rigid-body quantities of the whole robot at one instant, computed once a control tick."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

from robot.model.body import SIDES, BodyModel
from robot.se3 import Array

LEAST_LOAD = 0.08
"""Share of the weight under which a foot tells nothing of how the base turns."""


class Dynamics:
    """Mass matrix, bias forces, Jacobians and centre of mass, from estimated base and joints.

    The free joint's linear velocity is in N, its angular velocity in B (MuJoCo's convention).

    Attributes:
        M: mass matrix with armature, shape (nv, nv).
        h: Coriolis, centrifugal and gravity forces less passive forces, shape (nv,):
            M qdd + h = S^T tau + sum J_c^T f_c.
        jac: of the soles in N, left over right, each translation over rotation, shape (12, nv).
        jac_sole: the same a sole, views of shape (6, nv).
        bias: Jdot qd of the soles, shape (12,).
        sole_velocity: of the soles, linear over angular, in N, shape (12,).
        sole_position, sole_rotation: of each sole in N, views of shape (3,), (3, 3).
        com, com_velocity: of the whole robot in N, shape (3,).
    """

    def __init__(self, body: BodyModel) -> None:
        """Allocate everything once."""
        self.body = body
        self.data = body.data()
        nv = body.model.nv
        self.M: Array = np.zeros((nv, nv))
        self.h: Array = np.zeros(nv)
        self.jac: Array = np.zeros((12, nv))
        self.jac_sole: list[Array] = [self.jac[:6], self.jac[6:]]
        self._jac_rows = [self.jac[k : k + 3] for k in (0, 3, 6, 9)]
        self._jac_dot: Array = np.zeros((12, nv))
        self._jac_dot_rows = [self._jac_dot[k : k + 3] for k in (0, 3, 6, 9)]
        self.bias: Array = np.zeros(12)
        self.sole_velocity: Array = np.zeros(12)
        self._sites = [body.sole_site[side] for side in SIDES]
        self._feet = [body.foot_body[side] for side in SIDES]
        self.sole_position: list[Array] = [self.data.site_xpos[site] for site in self._sites]
        self.sole_rotation: list[Array] = [
            self.data.site_xmat[site].reshape(3, 3) for site in self._sites
        ]
        self.com: Array = self.data.subtree_com[body.base_body]
        self.com_velocity: Array = np.zeros(3)
        self._qvel: Array = self.data.qvel
        self._damping: Array = np.array(body.model.dof_damping)

    def kinematics(self) -> None:
        """After base, joints and velocities were written: poses, sole Jacobians and velocities."""
        model, data = self.body.model, self.data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        left_p, left_r, right_p, right_r = self._jac_rows
        left, right = self._sites
        mujoco.mj_jacSite(model, data, left_p, left_r, left)
        mujoco.mj_jacSite(model, data, right_p, right_r, right)
        self.jac.dot(self._qvel, out=self.sole_velocity)

    def turn_by_soles(self, qd: Array, load: Sequence[float]) -> Array:
        """How fast the base turns if the soles that bear do not, in B [rad/s], shape (3,).

        By the Jacobians of the last `kinematics`, which change little in a tick.

        Args:
            qd: of the motors, shape (n,).
            load: share of the weight on each foot; nothing turns where none bears.
        """
        whole = max(sum(load), 1e-9)
        turn: Array = np.zeros(3)
        for jac, share in zip(self.jac_sole, load, strict=True):
            if share > LEAST_LOAD:
                turn -= share / whole * (jac[3:, self.body.dof_of] @ qd)
        return self.data.xmat[self.body.base_body].reshape(3, 3).T @ turn

    def shift_base_velocity(self, shift_m_s: tuple[float, float, float]) -> None:
        """Add to the base's linear velocity, after `kinematics`."""
        self._qvel[:3] += shift_m_s
        self.sole_velocity[:3] += shift_m_s
        self.sole_velocity[6:9] += shift_m_s

    def dynamics(self) -> None:
        """After `kinematics` and the base velocity: mass matrix, bias, Jdot qd, CoM velocity."""
        model, data, qvel = self.body.model, self.data, self._qvel
        mujoco.mj_crb(model, data)
        mujoco.mj_fullM(model, data, self.M)
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 0, self.h)
        self.h += self._damping * qvel
        left_p, left_r, right_p, right_r = self._jac_dot_rows
        left, right = self.sole_position
        mujoco.mj_jacDot(model, data, left_p, left_r, left, self._feet[0])
        mujoco.mj_jacDot(model, data, right_p, right_r, right, self._feet[1])
        self._jac_dot.dot(qvel, out=self.bias)
        self.M[:3].dot(qvel, out=self.com_velocity)
        self.com_velocity /= self.body.mass_kg
