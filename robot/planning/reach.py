"""Whether the arm gets there from a stance: joints for the poses of a grasp, and their margin."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from robot.messages import Side
from robot.planning.body import Arm, Body
from robot.planning.grasps import HandOption
from robot.planning.stances import LEANS, Candidates
from robot.se3 import SE3, Array

WOBBLE = ((0.02, 0.02, 0.03), (0.02, -0.02, -0.03), (-0.02, 0.02, -0.03), (-0.02, -0.02, 0.03))
"""Errors of the stance that a good one bears: x, y [m], yaw [rad]."""
LIMIT_SHARE = 4.0
DEXTERITY_SHARE = 9.0


@dataclass(frozen=True, slots=True)
class Targets:
    """Poses of the hand in W: orientations (n, 3, 3) and positions (n, 3)."""

    R: Array
    p: Array

    def moved(self, *, along_m: Array | float = 0.0, up_m: float = 0.0) -> Targets:
        """Shifted along the approach direction, and up."""
        shift = self.R[:, :, 0] * np.reshape(along_m, (-1, 1))
        return Targets(self.R, self.p + shift + np.array([0.0, 0.0, up_m]))

    def pose(self, i: int) -> SE3:
        """X_WG of one."""
        return SE3.from_rotation(self.R[i], self.p[i])


@dataclass(frozen=True, slots=True)
class Bases:
    """Poses of the base in W, upright: position (n, 3), yaw (n,); and the chain's waist (n, k)."""

    p: Array
    yaw: Array
    q_chain: Array


@dataclass(frozen=True, slots=True)
class Reached:
    """Chain values (n, k), whether the target was met (n,), error left [m] (n,)."""

    q: Array
    ok: np.ndarray
    short_m: Array


def targets_of(candidates: Candidates, options: list[HandOption], references: Array) -> Targets:
    """The grasp of every candidate."""
    R0 = np.stack([option.R0 for option in options])[candidates.option]
    offset = np.stack([option.offset for option in options])[candidates.option]
    turn = rotations_z(candidates.heading)
    at = references[candidates.reference] + (turn @ offset[..., None])[..., 0]
    return Targets(turn @ R0, at)


def bases_of(body: Body, side: Side, candidates: Candidates, *, upright: bool = False) -> Bases:
    """Where the base is at every candidate's stance, in its posture (or standing upright)."""
    arm = body.arms[side]
    standing = [body.standing(lean.posture(side)) for lean in LEANS]
    if upright:
        standing = [standing[0]] * len(LEANS)
    offset = np.array([X_SB.p for X_SB, _ in standing])[candidates.lean]
    chain = np.array([q[arm.motors] for _, q in standing])[candidates.lean]
    yaw = candidates.stance[:, 2]
    feet = np.concatenate([candidates.stance[:, :2], np.zeros((len(yaw), 1))], axis=1)
    return Bases(feet + (rotations_z(yaw) @ offset[..., None])[..., 0], yaw, chain)


def wobbled(bases: Bases, error: tuple[float, float, float]) -> Bases:
    """The same, standing off by (x, y, yaw) in the base's own frame."""
    shift = rotations_z(bases.yaw) @ np.array([error[0], error[1], 0.0])
    return Bases(bases.p + shift, bases.yaw + error[2], bases.q_chain)


def reach(
    arm: Arm, bases: Bases, targets: Targets, q_near: Array, *, iterations: int = 24
) -> Reached:
    """Joints for every target, starting at `q_near`, shape (n, k); the waist stays as in `bases`."""
    into = rotations_z(-bases.yaw)
    q0 = bases.q_chain.copy()
    q0[:, arm.free] = q_near[:, arm.free]
    solved = arm.chain.solve(
        into @ targets.R,
        (into @ (targets.p - bases.p)[..., None])[..., 0],
        q0,
        free=arm.free,
        iterations=iterations,
    )
    return Reached(solved.q, solved.ok(), solved.position_error_m)


def first_reach(body: Body, arm: Arm, bases: Bases, targets: Targets) -> Reached:
    """From the robot's own postures; the second is tried where the first led nowhere."""
    result: Reached | None = None
    for name in ("carry", "nominal"):
        posture = name if name in body.description.postures else "nominal"
        seed = np.array(body.description.posture(posture))[arm.motors]
        rows = np.arange(len(targets.p)) if result is None else np.flatnonzero(~result.ok)
        if not len(rows):
            break
        some = Bases(bases.p[rows], bases.yaw[rows], bases.q_chain[rows])
        tried = reach(
            arm, some, Targets(targets.R[rows], targets.p[rows]), np.tile(seed, (len(rows), 1))
        )
        if result is None:
            result = tried
        else:
            better = tried.short_m < result.short_m[rows]
            result.q[rows[better]] = tried.q[better]
            result.ok[rows[better]] = tried.ok[better]
            result.short_m[rows[better]] = tried.short_m[better]
    assert result is not None
    return result


def margins(arm: Arm, q: Array) -> Array:
    """0 (at a limit or stretched out) to 1 (far from both), shape (n,)."""
    limits = LIMIT_SHARE * arm.chain.margin(q, arm.free)
    dexterity = DEXTERITY_SHARE * arm.chain.dexterity(q, arm.free)
    return np.clip(np.minimum(limits, dexterity), 0.0, 1.0)


def rotations_z(yaw: Array) -> Array:
    """Turns about the vertical, shape (n,) to (n, 3, 3)."""
    result = np.zeros((len(yaw), 3, 3))
    c, s = np.cos(yaw), np.sin(yaw)
    result[:, 0, 0], result[:, 0, 1] = c, -s
    result[:, 1, 0], result[:, 1, 1] = s, c
    result[:, 2, 2] = 1.0
    return result


def base_pose(bases: Bases, i: int) -> SE3:
    """X_WB of one."""
    half = 0.5 * float(bases.yaw[i])
    x, y, z = (float(value) for value in bases.p[i])
    return SE3((x, y, z), (math.cos(half), 0.0, 0.0, math.sin(half)))
