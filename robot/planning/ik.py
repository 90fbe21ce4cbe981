"""Inverse kinematics of a chain for many targets at once.

The search over stances asks for hundreds of solutions in one request. A quadratic program a step
and a target (mink: 0.1 ms a step) costs seconds there; damped least squares on the whole batch
costs milliseconds, so it is done here with numpy, for any chain of hinges of an MJCF.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from robot.se3 import Array

STEP_LIMIT_RAD = 0.4
"""Largest change of a joint in one iteration [rad]."""


@dataclass(frozen=True, slots=True)
class Solutions:
    """Answers to n targets: joints (n, k) [rad], what is left of the error [m], [rad], shape (n,)."""

    q: Array
    position_error_m: Array
    rotation_error_rad: Array

    def ok(self, position_m: float = 1e-3, rotation_rad: float = 5e-3) -> np.ndarray:
        """Which targets were met, shape (n,), bool."""
        return (self.position_error_m < position_m) & (self.rotation_error_rad < rotation_rad)


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
        root = model.body(body).id
        at = int(model.site(site).bodyid[0])
        tip = (_matrix(model.site_quat[model.site(site).id]), model.site_pos[model.site(site).id])
        links: list[tuple[Array, Array, str, Array]] = []
        while at != root:
            if at == 0:
                raise ValueError(f"site {site!r} does not hang on body {body!r}")
            count, first = int(model.body_jntnum[at]), int(model.body_jntadr[at])
            if count > 1 or (count and model.jnt_type[first] != mujoco.mjtJoint.mjJNT_HINGE):
                raise ValueError(f"body {model.body(at).name!r} moves on other than one hinge")
            rotation, position = _matrix(model.body_quat[at]), model.body_pos[at].copy()
            if count:
                anchor = model.jnt_pos[first]
                if np.any(anchor != 0.0):
                    raise ValueError(f"joint {model.joint(first).name!r} is off its body's origin")
                axis = model.jnt_axis[first].copy()
                links.append((rotation, position, model.joint(first).name, axis))
            else:
                links.append((rotation, position, "", np.zeros(3)))
            at = int(model.body_parentid[at])
        links.reverse()
        self._links = links
        self._tip = tip
        self.joints = tuple(name for *_, name, _ in links if name)
        ranges = np.array([model.joint(name).range for name in self.joints])
        self.lower, self.upper = ranges[:, 0].copy(), ranges[:, 1].copy()
        self._middle = 0.5 * (self.lower + self.upper)
        self._half_range = 0.5 * (self.upper - self.lower)
        self._skew = [_skew(axis) for *_, name, axis in links if name]
        self._skew2 = [k @ k for k in self._skew]

    def forward(self, q: Array) -> tuple[Array, Array]:
        """Pose of the site in the body's frame: rotations (n, 3, 3), positions (n, 3) of q (n, k)."""
        rotation, position, _, _ = self._sweep(q)
        return rotation, position

    def _sweep(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Pose of the site, and axes and anchors of the joints, shape (n, k, 3)."""
        n, k = q.shape
        sin, cos = np.sin(q), 1.0 - np.cos(q)
        rotation = np.broadcast_to(np.eye(3), (n, 3, 3))
        position = np.zeros((n, 3))
        axes, anchors = np.empty((n, k, 3)), np.empty((n, k, 3))
        j = 0
        for fixed, offset, name, axis in self._links:
            position = position + rotation @ offset
            rotation = rotation @ fixed
            if name:
                axes[:, j] = rotation @ axis
                anchors[:, j] = position
                turn = sin[:, j, None, None] * self._skew[j] + cos[:, j, None, None] * self._skew2[j]
                rotation = rotation + rotation @ turn
                j += 1
        position = position + rotation @ self._tip[1]
        return rotation @ self._tip[0], position, axes, anchors

    def solve(
        self,
        rotations: Array,
        positions: Array,
        q0: Array,
        *,
        free: list[int] | None = None,
        iterations: int = 30,
    ) -> Solutions:
        """Joint values that bring the site to the targets, inside the limits.

        Levenberg-Marquardt with the damping of [Sugihara2011] and a pull to the middle of the
        ranges in the null space; values are clamped to the limits after every step.

        Args:
            rotations, positions: targets in the body's frame, shapes (n, 3, 3), (n, 3).
            q0: where to start, shape (n, k).
            free: which joints may move (all).
            iterations: at most so many.
        """
        free = list(range(len(self.joints))) if free is None else free
        q = np.clip(q0, self.lower, self.upper)
        best_q, best = q.copy(), np.full((len(q), 2), np.inf)
        active = np.arange(len(q))
        lower, upper = self.lower[free], self.upper[free]
        middle, half = self._middle[free], self._half_range[free]
        for step in range(iterations + 1):
            here, at, axes, anchors = self._sweep(q[active])
            error = np.empty((len(active), 6))
            error[:, :3] = positions[active] - at
            error[:, 3:] = _rotation_vector(rotations[active] @ here.transpose(0, 2, 1))
            size = np.stack(
                [np.linalg.norm(error[:, :3], axis=1), np.linalg.norm(error[:, 3:], axis=1)], axis=1
            )
            better = size @ (1.0, 0.2) < best[active] @ (1.0, 0.2)
            best[active[better]], best_q[active[better]] = size[better], q[active[better]]
            going = (size[:, 0] > 2e-4) | (size[:, 1] > 1e-3)
            if step == iterations or not going.any():
                break
            active, error = active[going], error[going]
            arms = at[going, None, :] - anchors[going]
            jacobian = np.concatenate(
                [np.cross(axes[going], arms), axes[going]], axis=2
            ).transpose(0, 2, 1)[:, :, free]
            change = _damped_step(jacobian, error, (middle - q[np.ix_(active, free)]) / half**2)
            q[np.ix_(active, free)] = np.clip(q[np.ix_(active, free)] + change, lower, upper)
        return Solutions(best_q, best[:, 0], best[:, 1])

    def margin(self, q: Array, free: list[int]) -> Array:
        """Distance to the nearest limit as a share of half the joint's range, shape (n,)."""
        room = np.minimum(q - self.lower, self.upper - q)[:, free]
        return np.min(room / self._half_range[free], axis=1)

    def dexterity(self, q: Array, free: list[int]) -> Array:
        """Smallest singular value of the Jacobian in metres and radians / 2, shape (n,)."""
        _, at, axes, anchors = self._sweep(q)
        linear = np.cross(axes, at[:, None, :] - anchors)
        jacobian = np.concatenate([linear, 0.5 * axes], axis=2)[:, free, :]
        return np.linalg.svd(jacobian, compute_uv=False)[:, -1]


def _damped_step(jacobian: Array, error: Array, pull: Array) -> Array:
    """One step for every target, shape (n, free)."""
    transposed = jacobian.transpose(0, 2, 1)
    damping = 1e-4 + 0.02 * np.sum(error**2, axis=1)
    normal = jacobian @ transposed + damping[:, None, None] * np.eye(6)
    size = np.linalg.norm(error, axis=1)
    gain = np.minimum(0.05, size)[:, None]
    wanted = error - (jacobian @ (gain * pull)[..., None])[..., 0]
    change = (transposed @ np.linalg.solve(normal, wanted[..., None]))[..., 0] + gain * pull
    largest = np.max(np.abs(change), axis=1, keepdims=True)
    return change * np.minimum(1.0, STEP_LIMIT_RAD / np.maximum(largest, 1e-9))


def _rotation_vector(rotation: Array) -> Array:
    """Axis times angle of rotation matrices, shape (n, 3); exact but near pi, where it is safe."""
    r = rotation
    axis = 0.5 * np.stack(
        [r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1]], axis=1
    )
    sin = np.linalg.norm(axis, axis=1)
    cos = 0.5 * (np.trace(r, axis1=1, axis2=2) - 1.0)
    angle = np.arctan2(sin, cos)
    return axis * (angle / np.maximum(sin, 1e-6))[:, None]


def _matrix(quat_wxyz: Array) -> Array:
    result = np.empty(9)
    mujoco.mju_quat2Mat(result, np.asarray(quat_wxyz, dtype=np.float64))
    return result.reshape(3, 3)


def _skew(v: Array) -> Array:
    x, y, z = v
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
