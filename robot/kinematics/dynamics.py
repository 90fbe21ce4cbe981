"""Rigid-body quantities of the whole robot at one instant, computed once a control tick."""

from __future__ import annotations

import mujoco
import numpy as np

from robot.model.body import SIDES, BodyModel
from robot.se3 import Array


class Dynamics:
    """Mass matrix, bias forces, Jacobians and centre of mass, from estimated base and joints.

    The free joint's linear velocity is in N, its angular velocity in B (MuJoCo's convention).

    Attributes:
        M: mass matrix with armature, shape (nv, nv).
        h: Coriolis, centrifugal and gravity forces less passive forces, shape (nv,):
            M qdd + h = S^T tau + sum J_c^T f_c.
        jac_sole: translation over rotation of each sole, in N, each (6, nv).
        bias_sole: Jdot qd of each sole, each (6,).
        com, com_velocity: of the whole robot in N, shape (3,).
    """

    def __init__(self, body: BodyModel) -> None:
        """Allocate everything once."""
        self.body = body
        self.data = body.data()
        nv = body.model.nv
        self.M: Array = np.zeros((nv, nv))
        self.h: Array = np.zeros(nv)
        self.jac_sole: list[Array] = [np.zeros((6, nv)) for _ in SIDES]
        self.bias_sole: list[Array] = [np.zeros(6) for _ in SIDES]
        self._jac_dot: Array = np.zeros((6, nv))
        self._sites = [body.sole_site[side] for side in SIDES]
        self._feet = [body.foot_body[side] for side in SIDES]
        self.com: Array = np.zeros(3)
        self.com_velocity: Array = np.zeros(3)

    def kinematics(self) -> None:
        """After base, joints and velocities were written: poses and sole Jacobians."""
        model, data = self.body.model, self.data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        for i, site in enumerate(self._sites):
            jac = self.jac_sole[i]
            mujoco.mj_jacSite(model, data, jac[:3], jac[3:], site)

    def dynamics(self) -> None:
        """After `kinematics` and the base velocity: mass matrix, bias, Jdot qd, CoM velocity."""
        model, data = self.body.model, self.data
        mujoco.mj_crb(model, data)
        mujoco.mj_fullM(model, data, self.M)
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 0, self.h)
        self.h += model.dof_damping * data.qvel
        for i, site in enumerate(self._sites):
            jac = self._jac_dot
            point = data.site_xpos[site]
            mujoco.mj_jacDot(model, data, jac[:3], jac[3:], point, self._feet[i])
            np.dot(jac, data.qvel, out=self.bias_sole[i])
        self.com = data.subtree_com[self.body.base_body]
        self.com_velocity = self.M[:3] @ data.qvel / self.body.mass_kg
