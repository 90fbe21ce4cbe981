"""Whether the arm gets there from a stance: joints for the poses of a grasp, and their margin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot.messages import Side
from robot.planning.grasps import HandOption
from robot.planning.numerics import Indices, Mask
from robot.planning.robot_body import Arm, Body
from robot.planning.stances import Candidates, posture_of
from robot.se3 import SE3, Array

WOBBLE = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
"""Errors of a stance that a good one bears: ahead, aside, turned, in parts of `ExactSteps.bears_*`.
Every second corner of that box stands for all eight."""
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

    def take(self, rows: Indices) -> Targets:
        """Some of them, or some several times."""
        return Targets(self.R[rows], self.p[rows])

    def pose(self, i: int) -> SE3:
        """X_WG of one."""
        return SE3.from_rotation(self.R[i], self.p[i])


@dataclass(frozen=True, slots=True)
class Trunks:
    """Where the arm hangs: stances (n, 3) and the arm's root T in S, (n, 3, 3) and (n, 3)."""

    stance: Array
    R_ST: Array
    p_ST: Array

    def into(self, targets: Targets) -> tuple[Array, Array]:
        """The targets in T."""
        turn = rotations_z(-self.stance[:, 2])
        p_W = targets.p - np.pad(self.stance[:, :2], ((0, 0), (0, 1)))
        p_S = (turn @ p_W[..., None])[..., 0]
        back = self.R_ST.transpose(0, 2, 1)
        return back @ turn @ targets.R, (back @ (p_S - self.p_ST)[..., None])[..., 0]

    def wobbled(self, error: tuple[float, float, float]) -> Trunks:
        """The same, standing off by (x, y, yaw) in S."""
        shift = rotations_z(self.stance[:, 2])[:, :, :2] @ np.array(error[:2])
        off = self.stance + shift
        off[:, 2] = self.stance[:, 2] + error[2]
        return Trunks(off, self.R_ST, self.p_ST)

    def take(self, rows: Indices) -> Trunks:
        """Some of them, or some several times."""
        return Trunks(self.stance[rows], self.R_ST[rows], self.p_ST[rows])


def joined(parts: list[Trunks]) -> Trunks:
    """One after the other."""
    names = ("stance", "R_ST", "p_ST")
    return Trunks(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


@dataclass(frozen=True, slots=True)
class Reached:
    """Chain values (n, k), whether the target was met (n,), error left [m] (n,)."""

    q: Array
    ok: Mask
    short_m: Array


def targets_of(candidates: Candidates, options: list[HandOption], references: Array) -> Targets:
    """The grasp of every candidate."""
    R0 = np.stack([option.R0 for option in options])[candidates.option]
    offset = np.stack([option.offset for option in options])[candidates.option]
    turn = rotations_z(candidates.heading)
    at = references[candidates.reference] + (turn @ offset[..., None])[..., 0]
    return Targets(turn @ R0, at)


def trunks_of(body: Body, side: Side, candidates: Candidates, *, upright: bool = False) -> Trunks:
    """Where the arm hangs at every candidate's stance, in its posture (or standing upright)."""
    leans = body.description.handy.reaching.leans
    poses = [body.standing(posture_of(lean, side), side).X_ST[side] for lean in leans]
    lean = np.zeros_like(candidates.lean) if upright else candidates.lean
    R_ST = np.stack([pose.rotation() for pose in poses])[lean]
    return Trunks(candidates.stance, R_ST, np.array([pose.p for pose in poses])[lean])


def reach(
    arm: Arm, trunks: Trunks, targets: Targets, q_near: Array, *, iterations: int = 24
) -> Reached:
    """Joints for every target, starting at `q_near`, shape (n, k)."""
    rotations, positions = trunks.into(targets)
    solved = arm.chain.solve(rotations, positions, q_near, iterations=iterations)
    return Reached(solved.q, solved.ok(), solved.position_error_m)


def first_reach(
    body: Body, arm: Arm, trunks: Trunks, targets: Targets, *, posture: str = ""
) -> Reached:
    """From the robot's own postures and the middle of the ranges; each where the last failed.

    With a `posture` from that instead of its own.
    """
    robot = body.description
    own = tuple(name for name in ("carry", "nominal") if name in robot.postures)
    names = (posture,) if posture else own
    seeds = [np.array(robot.posture(name))[arm.motors] for name in names]
    seeds.append(0.5 * (arm.lower + arm.upper))
    n = len(targets.p)
    result = Reached(np.tile(seeds[0], (n, 1)), np.zeros(n, dtype=bool), np.full(n, np.inf))
    for seed in seeds:
        rows = np.flatnonzero(~result.ok)
        if not len(rows):
            break
        tried = reach(arm, trunks.take(rows), targets.take(rows), np.tile(seed, (len(rows), 1)))
        better = tried.ok | (tried.short_m < result.short_m[rows])
        result.q[rows[better]] = tried.q[better]
        result.ok[rows[better]] = tried.ok[better]
        result.short_m[rows[better]] = tried.short_m[better]
    return result


def margins(arm: Arm, q: Array) -> Array:
    """0 (at a limit or stretched out) to 1 (far from both), shape (n,)."""
    limits = LIMIT_SHARE * arm.chain.margin(q)
    dexterity = DEXTERITY_SHARE * arm.chain.dexterity(q)
    return np.clip(np.minimum(limits, dexterity), 0.0, 1.0)


def rotations_z(yaw: Array) -> Array:
    """Turns about the vertical, shape (n,) to (n, 3, 3)."""
    result = np.zeros((len(yaw), 3, 3))
    c, s = np.cos(yaw), np.sin(yaw)
    result[:, 0, 0], result[:, 0, 1] = c, -s
    result[:, 1, 0], result[:, 1, 1] = s, c
    result[:, 2, 2] = 1.0
    return result
