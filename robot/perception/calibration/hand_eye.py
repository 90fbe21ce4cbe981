"""Where a camera sits on the hand (or the head) that carries it, from pictures of a board.

The board stands still. Frames: B the base, G the hand, C the camera, T the board.
X_BT = X_BG @ X_GC @ X_CT is the same in all pictures. First in closed form from the motions between
pictures [Park1994], then the reprojection error of all corners is made least over X_GC and X_BT. Of
a camera that stands still and sees a board in the hand, the same is done with the inverse of X_BG;
what is found is then X_BC.

[Park1994] F. C. Park, B. J. Martin, "Robot sensor calibration: solving AX = XB on the Euclidean
group", IEEE Transactions on Robotics and Automation 10(5).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from robot.errors import ConfigError, Problem
from robot.perception.calibration import opencv, turns
from robot.perception.calibration.turns import Array
from robot.perception.calibration.views import FEWEST_VIEWS, View

LEAST_TURN_RAD = np.radians(3.0)
"""Motions that turn less say nothing of how the camera is turned."""
MOST_PAIRS = 3000
PLAIN = 0.05
"""Motions whose axes spread less than this, against the most, do not determine the camera."""


@dataclass(frozen=True, kw_only=True)
class Fit:
    """How well one picture fits."""

    name: str
    rms: float
    """Of its corners [px]."""
    position_mm: float
    rotation_deg: float
    """Between where the board is, and where it is by this picture alone."""


@dataclass(frozen=True, kw_only=True)
class Mounting:
    """Where the camera is."""

    camera: tuple[tuple[float, ...], ...]
    """X_GC (X_BC where the camera stands still), row by row, shape (4, 4) [m]."""
    board: tuple[tuple[float, ...], ...]
    """X_BT (X_GT where the board is in the hand)."""
    rms: float
    """Over all corners [px]."""
    images: tuple[Fit, ...]


def mounting(
    views: Sequence[View], poses: Sequence[Array], matrix: Array, distortion: Array
) -> Mounting:
    """Where the camera sits on the hand.

    Args:
        views: the corners of each picture.
        poses: X_BG of each, shape (4, 4); its inverse where the camera stands still.
        matrix: of the camera, shape (3, 3).
        distortion: of the camera, k1, k2, p1, p2, k3.

    Raises:
        ConfigError: the motions do not determine it.
    """
    if len(views) < FEWEST_VIEWS:
        text = f"{len(views)} pictures show the board and have a pose; {FEWEST_VIEWS} are needed"
        raise ConfigError([Problem(text, suggestion="take 10 to 20, turned about several axes")])
    seen = [opencv.board_pose((v.points_m, v.pixels), matrix, distortion) for v in views]
    guess = closed_form(poses, seen)
    start = (guess, poses[0] @ guess @ seen[0])

    def residuals(numbers: Array) -> Array:
        X_CG = inverse(turns.pose(numbers[:6]))
        board = turns.pose(numbers[6:])
        return np.concatenate(
            [
                _left_over(view, X_CG @ inverse(X_BG) @ board, matrix, distortion).ravel()
                for view, X_BG in zip(views, poses, strict=True)
            ]
        )

    found = turns.least(residuals, np.concatenate([turns.six_numbers(one) for one in start]))
    X_GC, X_BT = turns.pose(found[:6]), turns.pose(found[6:])
    images: list[Fit] = []
    for view, X_BG, X_CT in zip(views, poses, seen, strict=True):
        expected = inverse(X_BG @ X_GC) @ X_BT
        left = _left_over(view, expected, matrix, distortion)
        off = inverse(X_BT) @ X_BG @ X_GC @ X_CT
        images.append(
            Fit(
                name=view.name,
                rms=_rms(left),
                position_mm=1000.0 * float(np.linalg.norm(off[:3, 3])),
                rotation_deg=float(np.degrees(np.linalg.norm(turns.to_vector(off[:3, :3])))),
            )
        )
    return Mounting(
        camera=_rows(X_GC),
        board=_rows(X_BT),
        rms=_rms(residuals(found).reshape(-1, 2)),
        images=tuple(images),
    )


def closed_form(poses: Sequence[Array], seen: Sequence[Array]) -> Array:
    """X_GC from the motions between all pictures, shape (4, 4) [Park1994].

    Args:
        poses: X_BG of each picture.
        seen: X_CT of each.

    Raises:
        ConfigError: the hand was not turned about two axes at least.
    """
    motions = [
        (inverse(poses[j]) @ poses[i], seen[j] @ inverse(seen[i]))
        for i, j in list(combinations(range(len(poses)), 2))[:MOST_PAIRS]
    ]
    hand = np.array([motion[0] for motion in motions])
    eye = np.array([motion[1] for motion in motions])
    axes_G, axes_C = turns.to_vector(hand[:, :3, :3]), turns.to_vector(eye[:, :3, :3])
    turned = np.linalg.norm(axes_G, axis=1) > LEAST_TURN_RAD
    spread = np.linalg.svd(axes_G[turned], compute_uv=False) if turned.sum() >= 2 else np.zeros(3)
    if spread[1] < PLAIN * max(float(spread[0]), 1e-9):
        text = "the poses do not determine the camera: all turns are about one axis"
        cure = "turn the hand about two axes at least, by 20 degrees and more"
        raise ConfigError([Problem(text, suggestion=cure)])
    # axes_G = R_GC @ axes_C, by least squares (Kabsch).
    left, _, right = np.linalg.svd(axes_G[turned].T @ axes_C[turned])
    R_GC = left @ np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))]) @ right
    rows = (hand[:, :3, :3] - np.eye(3)).reshape(-1, 3)
    wanted = (eye[:, :3, 3] @ R_GC.T - hand[:, :3, 3]).ravel()
    result = np.eye(4)
    result[:3, :3] = R_GC
    result[:3, 3] = np.linalg.pinv(rows) @ wanted
    return result


def inverse(pose: Array) -> Array:
    """X_BA of X_AB, shape (4, 4)."""
    result = np.eye(4)
    result[:3, :3] = pose[:3, :3].T
    result[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return result


def _left_over(view: View, X_CT: Array, matrix: Array, distortion: Array) -> Array:
    return opencv.projected(view.points_m, X_CT, matrix, distortion) - view.pixels


def _rms(left: Array) -> float:
    return float(np.sqrt((left**2).sum(axis=-1).mean()))


def _rows(matrix: Array) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row) for row in matrix.tolist())
