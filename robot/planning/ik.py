"""Inverse kinematics of a chain for many targets at once.

The search over stances asks for hundreds of solutions in one request. A quadratic program a step
and a target (mink: 0.1 ms a step) costs seconds there; damped least squares on the whole batch
costs milliseconds, so it is done here with numpy, for any chain of hinges of an MJCF.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from robot.planning import numerics
from robot.planning.numerics import Mask
from robot.se3 import Array, rotation_vectors

STEP_LIMIT_RAD = 0.4
"""Largest change of a joint in one iteration [rad]."""
RELAX_GAIN = 0.25
SWING_RAD = 0.2
"""Motion of the joints in one step of a swing of the elbow [rad]."""
LIMIT_ROOM_RAD = 0.1
"""A swing ends so far before a limit [rad]."""
STALL_STEPS, STALL_SHARE = 4, 0.6
"""A target is given up when so many iterations leave more than this share of the error."""


@dataclass(frozen=True, slots=True)
class Solutions:
    """Answers to n targets: joints (n, k) [rad]; what is left of the error [m], [rad], (n,)."""

    q: Array
    position_error_m: Array
    rotation_error_rad: Array

    def ok(self, position_m: float = 1e-3, rotation_rad: float = 5e-3) -> Mask:
        """Which targets were met, shape (n,), bool."""
        return (self.position_error_m < position_m) & (self.rotation_error_rad < rotation_rad)


@dataclass(frozen=True, slots=True)
class _Link:
    """A hinge: its body's place on the link before (None: the identity), and its axis."""

    name: str
    fixed: Array | None
    offset: Array | None
    axis: Array
    skew: Array
    skew2: Array

    @staticmethod
    def of(name: str, fixed: Array, offset: Array, axis: Array) -> _Link:
        """With what follows from the axis; identities left out."""
        skew = _skew(axis)
        turned, shifted = not np.allclose(fixed, np.eye(3)), bool(np.any(offset != 0.0))
        return _Link(
            name, fixed if turned else None, offset if shifted else None, axis, skew, skew @ skew
        )

    def on(self, fixed: Array, offset: Array) -> _Link:
        """The same hinge seen from one body further in, which has no joint of its own."""
        own = np.eye(3) if self.fixed is None else self.fixed
        at = np.zeros(3) if self.offset is None else self.offset
        return _Link.of(self.name, fixed @ own, fixed @ at + offset, self.axis)


class Chain:
    """The hinges between a body and a site further out, and their limits.

    Attributes:
        joints: names from the body outwards.
        lower, upper: limits, shape (k,) [rad].
    """

    def __init__(self, model: mujoco.MjModel, body: str, site: str) -> None:
        """Follow the bodies from the site inwards to `body`.

        Raises:
            ValueError: if the site is not a descendant of the body, or a joint is no hinge.
        """
        self.body = body
        root = model.body(body).id
        tip_id = model.site(site).id
        at = int(model.site_bodyid[tip_id])
        self._tip = (_matrix(model.site_quat[tip_id]), model.site_pos[tip_id].copy())
        links: list[_Link] = []
        while at != root:
            if at == 0:
                raise ValueError(f"site {site!r} does not hang on body {body!r}")
            count, first = int(model.body_jntnum[at]), int(model.body_jntadr[at])
            if count > 1 or (count and model.jnt_type[first] != mujoco.mjtJoint.mjJNT_HINGE):
                raise ValueError(f"body {model.body(at).name!r} moves on other than one hinge")
            if count and np.any(model.jnt_pos[first] != 0.0):
                raise ValueError(f"joint {model.joint(first).name!r} is off its body's origin")
            fixed, offset = _matrix(model.body_quat[at]), model.body_pos[at].copy()
            if count:
                name = model.joint(first).name
                links.append(_Link.of(name, fixed, offset, model.jnt_axis[first].copy()))
            elif links:
                links[-1] = links[-1].on(fixed, offset)
            else:
                self._tip = (fixed @ self._tip[0], fixed @ self._tip[1] + offset)
            at = int(model.body_parentid[at])
        links.reverse()
        self._links = links
        self.joints = tuple(link.name for link in links)
        ranges = np.array([model.joint(name).range for name in self.joints])
        self.lower, self.upper = ranges[:, 0].copy(), ranges[:, 1].copy()
        self._middle = 0.5 * (self.lower + self.upper)
        self._half_range = 0.5 * (self.upper - self.lower)

    def forward(self, q: Array) -> tuple[Array, Array]:
        """Where the site is in the body's frame at q (n, k): rotations (n, 3, 3), points (n, 3)."""
        rotation, position, _, _ = self._sweep(q)
        return rotation, position

    def _sweep(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Pose of the site, and axes and anchors of the joints, shape (n, k, 3)."""
        n, k = q.shape
        sin, cos = np.sin(q), 1.0 - np.cos(q)
        rotation = np.broadcast_to(np.eye(3), (n, 3, 3))
        position = np.zeros((n, 3))
        axes, anchors = np.empty((n, k, 3)), np.empty((n, k, 3))
        for j, link in enumerate(self._links):
            if link.offset is not None:
                position = position + rotation @ link.offset
            if link.fixed is not None:
                rotation = rotation @ link.fixed
            axes[:, j] = rotation @ link.axis
            anchors[:, j] = position
            turn = sin[:, j, None, None] * link.skew + cos[:, j, None, None] * link.skew2
            rotation = rotation + rotation @ turn
        position = position + rotation @ self._tip[1]
        return rotation @ self._tip[0], position, axes, anchors

    def solve(
        self, rotations: Array, positions: Array, q0: Array, *, iterations: int = 30
    ) -> Solutions:
        """Joint values that bring the site to the targets, inside the limits.

        Levenberg-Marquardt with the damping of [Sugihara2011] and a pull to the middle of the
        ranges in the null space; values are clamped to the limits after every step. A target that
        is not approached any more is given up.

        Args:
            rotations: targets in the body's frame, shape (n, 3, 3).
            positions: the same, shape (n, 3).
            q0: where to start, shape (n, k).
            iterations: at most so many.
        """
        q = np.clip(q0, self.lower, self.upper)
        n = len(q)
        best_q, best = q.copy(), np.full((n, 2), np.inf)
        active, before = np.arange(n), np.full(n, np.inf)
        for step in range(iterations + 1):
            here, at, axes, anchors = self._sweep(q[active])
            error = np.empty((len(active), 6))
            error[:, :3] = positions[active] - at
            error[:, 3:] = rotation_vectors(rotations[active] @ here.transpose(0, 2, 1))
            size = np.sqrt((error**2).reshape(-1, 2, 3).sum(axis=2))
            weight = size[:, 0] + 0.2 * size[:, 1]
            better = weight < best[active] @ (1.0, 0.2)
            best[active[better]], best_q[active[better]] = size[better], q[active[better]]
            going = (size[:, 0] > 2e-4) | (size[:, 1] > 1e-3)
            if step % STALL_STEPS == STALL_STEPS - 1:
                going &= weight < STALL_SHARE * before[active]
                before[active] = weight
            if step == iterations or not going.any():
                break
            active, error = active[going], error[going]
            axes = axes[going]
            jacobian = np.empty((len(active), len(self.joints), 6))
            jacobian[:, :, :3] = _cross(axes, at[going, None, :] - anchors[going])
            jacobian[:, :, 3:] = axes
            pull = (self._middle - q[active]) / self._half_range**2
            change = _damped_step(jacobian, error, pull)
            q[active] = np.clip(q[active] + change, self.lower, self.upper)
        return Solutions(best_q, best[:, 0], best[:, 1])

    def relax(self, q: Array, *, iterations: int = 8) -> Array:
        """Joints with the site where it is at q, shape (n, k), and further from the limits."""
        if not len(q):
            return q
        q, (rotations, positions) = q.copy(), self.forward(q)
        for _ in range(iterations):
            here, at, axes, anchors = self._sweep(q)
            error = np.concatenate(
                [positions - at, rotation_vectors(rotations @ here.transpose(0, 2, 1))], axis=1
            )
            jacobian = np.concatenate([_cross(axes, at[:, None, :] - anchors), axes], axis=2)
            off = (self._middle - q) / self._half_range  # -1 at the upper limit, 1 at the lower
            pull = off**3 / self._half_range
            change = _damped_step(jacobian, error, pull, gain=np.full((len(q), 1), RELAX_GAIN))
            q = np.clip(q + change, self.lower, self.upper)
        return self.solve(rotations, positions, q, iterations=6).q

    def swing(self, q: Array, along: Array, *, steps: int) -> Array:
        """Joints with the site where it is at q, shape (n, k), and the middle hinge elsewhere.

        The middle hinge of an arm is its elbow: it swings about the line from shoulder to hand,
        `SWING_RAD` of joint motion a step, as far as that leads along a direction and the limits
        allow.

        Args:
            q: where to start.
            along: the direction in the body's frame, shape (n, 3).
            steps: how far.
        """
        if not len(q):
            return q
        q, (rotations, positions), middle = q.copy(), self.forward(q), len(self.joints) // 2
        for _ in range(steps):
            here, at, axes, anchors = self._sweep(q)
            error = np.concatenate(
                [positions - at, rotation_vectors(rotations @ here.transpose(0, 2, 1))], axis=1
            )
            jacobian = np.concatenate([_cross(axes, at[:, None, :] - anchors), axes], axis=2)
            lever = anchors[:, middle : middle + 1] - anchors[:, :middle]
            wanted = np.zeros_like(q)
            wanted[:, :middle] = np.sum(_cross(axes[:, :middle], lever) * along[:, None, :], axis=2)
            free = _damped_step(jacobian, np.zeros_like(error), wanted, np.ones((len(q), 1)))
            size = np.linalg.norm(free, axis=1, keepdims=True)
            turn = SWING_RAD * free / np.maximum(size, 1e-6)
            room = np.where(turn > 0, self.upper - q, q - self.lower) - LIMIT_ROOM_RAD
            turn *= np.clip(np.min(room / np.maximum(np.abs(turn), 1e-9), axis=1), 0, 1)[:, None]
            q = q + turn + _damped_step(jacobian, error, np.zeros_like(q))
            q = np.clip(q, self.lower, self.upper)
        return self.solve(rotations, positions, q, iterations=6).q

    def margin(self, q: Array) -> Array:
        """Distance to the nearest limit as a share of half the joint's range, shape (n,)."""
        return np.min(np.minimum(q - self.lower, self.upper - q) / self._half_range, axis=1)

    def dexterity(self, q: Array) -> Array:
        """Smallest singular value of the Jacobian in metres and radians / 2, shape (n,)."""
        _, at, axes, anchors = self._sweep(q)
        jacobian = np.concatenate([_cross(axes, at[:, None, :] - anchors), 0.5 * axes], axis=2)
        return numerics.smallest_singular_values(jacobian)


def _damped_step(transposed: Array, error: Array, pull: Array, gain: Array | None = None) -> Array:
    """One step for every target, shape (n, k); the Jacobians come transposed, (n, k, 6)."""
    jacobian = transposed.transpose(0, 2, 1)
    squared = np.sum(error**2, axis=1)
    damping = 1e-4 + 0.02 * squared
    normal = jacobian @ transposed + damping[:, None, None] * np.eye(6)
    follow = np.minimum(0.05, np.sqrt(squared))[:, None] if gain is None else gain
    wanted = error - (jacobian @ (follow * pull)[..., None])[..., 0]
    solved = numerics.solve_all(normal, wanted)
    change = (transposed @ solved[..., None])[..., 0] + follow * pull
    largest = np.max(np.abs(change), axis=1, keepdims=True)
    return change * np.minimum(1.0, STEP_LIMIT_RAD / np.maximum(largest, 1e-9))


def _cross(a: Array, b: Array) -> Array:
    """Cross product over the last axis (numpy's own is slow for small arrays)."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def _matrix(quat_wxyz: Array) -> Array:
    result = np.empty(9)
    mujoco.mju_quat2Mat(result, np.asarray(quat_wxyz, dtype=np.float64))
    return result.reshape(3, 3)


def _skew(v: Array) -> Array:
    x, y, z = v
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
