"""Reaching through the workspace with a weight in the hand."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from benchmarks.rig import Rig
from robot.messages import MoveArm, Payload, Side
from robot.model.body import BodyModel
from robot.se3 import SE3, Array

RATE_RAD_S = 1.5
SHORTEST_S = 0.8
SETTLE_S = 0.4


def reach(*, side: Side, mass_kg: float, known: bool, poses: int, seed: int) -> dict[str, Any]:
    """Visit random arm postures with a mass fixed at the grasp point; no fall is the point.

    The tip's error is where the grasp point truly is in the torso's frame against where it would
    be with the arm exactly as commanded.
    """
    rig = Rig(seed=seed)
    if mass_kg:
        load(rig, side, mass_kg)
    rig.run(0.5)
    if known:
        rig.send(Payload, side=side, mass_kg=mass_kg)
    arm = Workspace(rig, side, np.random.default_rng([seed, poses]))
    errors: list[float] = []
    statuses: list[str] = []
    for _ in range(poses):
        q, duration_s = arm.draw()
        rig.send(MoveArm, side=side, times_s=(duration_s,), positions_rad=(tuple(q.tolist()),))
        statuses.append(rig.wait(f"{side}_arm", duration_s + 4.0))  # type: ignore[arg-type]
        if statuses[-1] == "fell" or not rig.run(SETTLE_S):
            break
        errors.append(1000.0 * math.dist(arm.truth(), arm.wanted()))
    visited = len(errors)
    return {
        "ok": visited == poses and rig.upright,
        "visited": visited,
        "done": statuses.count("done"),
        "tip_median_mm": round(float(np.median(errors)), 1) if errors else None,
        "tip_max_mm": round(max(errors), 1) if errors else None,
    }


def load(rig: Rig, side: Side, mass_kg: float) -> None:
    """Fix a point mass at the grasp point of the simulated hand."""
    model = rig.plant.model
    hand = int(model.body(rig.robot.hands[side].body).id)
    grasp = model.site(rig.robot.hands[side].grasp_site).pos
    own = float(model.body_mass[hand])
    model.body_ipos[hand] = (own * model.body_ipos[hand] + mass_kg * grasp) / (own + mass_kg)
    model.body_mass[hand] = own + mass_kg
    mujoco.mj_setConst(model, mujoco.MjData(model))


class Workspace:
    """Draws postures of one arm, free of self-collision, with a free straight way between."""

    def __init__(self, rig: Rig, side: Side, rng: np.random.Generator) -> None:
        """Begin at the posture that the robot stands in."""
        self._rig, self._rng = rig, rng
        self._body = BodyModel(rig.robot)
        self._data = self._body.data()
        self._q: Array = np.array(rig.robot.posture("nominal"))
        self._arm = np.array(rig.robot.indices(f"{side}_arm"))
        self._site = self._body.grasp_site[side]
        self._name = rig.robot.hands[side].grasp_site
        margin = 0.05
        self._lower = self._body.lower_rad[self._arm] + margin
        self._upper = self._body.upper_rad[self._arm] - margin

    def draw(self) -> tuple[Array, float]:
        """The next posture and how long to take for it."""
        start = self._q[self._arm].copy()
        while True:
            q = self._rng.uniform(self._lower, self._upper)
            if self._in_front(q) and all(
                self._free(start + share * (q - start)) for share in np.linspace(0.0, 1.0, 25)
            ):
                self._q[self._arm] = q
                return q, max(SHORTEST_S, float(np.abs(q - start).max()) / RATE_RAD_S)

    def wanted(self) -> Array:
        """Grasp point [m] in the torso's frame with the joints as commanded."""
        self._pose(self._q[self._arm])
        return self._in_torso(self._data.site_xpos[self._site], self._data)

    def truth(self) -> Array:
        """Grasp point [m] truly in the torso's frame."""
        plant = self._rig.plant
        body = plant.data.body(self._rig.robot.torso_body)
        X_WT = SE3.from_rotation(body.xmat.reshape(3, 3), body.xpos)
        return X_WT.inverse().apply(plant.data.site(self._name).xpos)

    def _in_torso(self, point: Array, data: Any) -> Array:
        torso = self._body.torso_body
        X_NT = SE3.from_rotation(data.xmat[torso].reshape(3, 3), data.xpos[torso])
        return X_NT.inverse().apply(point)

    def _in_front(self, q: Array) -> bool:
        """The grasp point ahead of the pelvis and above the thighs."""
        self._pose(q)
        x, _, z = self._data.site_xpos[self._site]
        return x > 0.12 and z > -0.15

    def _free(self, q: Array) -> bool:
        self._pose(q)
        mujoco.mj_collision(self._body.model, self._data)
        return self._data.ncon == 0

    def _pose(self, q: Array) -> None:
        whole = self._q.copy()
        whole[self._arm] = q
        self._body.write_base(self._data, SE3())
        self._body.write_joints(self._data, whole)
        mujoco.mj_kinematics(self._body.model, self._data)
