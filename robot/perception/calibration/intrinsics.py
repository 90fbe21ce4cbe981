"""The camera that explains pictures of a board: focal lengths, centre, distortion, residuals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.perception.calibration import opencv
from robot.perception.calibration.board import Board, Charuco
from robot.perception.calibration.views import WINDOW_PX, Rejected, View, Views, find_views

COVERED = (8, 6)
"""Columns and rows of the parts of the picture of which coverage tells."""
OUTLYING, LEAST_OUTLYING, LEAST_OUTLYING_PX = 3.0, 1.5, 0.3
"""A picture is outlying where its residual is so many robust deviations above the median, so many
times the median, and more than this."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Explained:
    """How well the camera explains one picture."""

    name: str
    corners: int
    rms: float
    """Root of the mean square of what is left between a corner and where it should be [px]."""
    tilt_deg: float
    """Between the board's normal and the line of sight's direction."""


@dataclass(frozen=True, kw_only=True)
class Camera:
    """A calibrated pinhole camera with distortion k1, k2, p1, p2, k3 [Zhang2000]."""

    rms: float
    """Over all corners [px]."""
    width: int
    height: int
    matrix: tuple[tuple[float, float, float], ...]
    distortion: tuple[float, ...]
    deviation: tuple[float, ...]
    """Standard deviations of fx, fy, cx, cy [px], then of the distortion, from the residuals."""
    coverage: float
    """Part of the picture, cut into 8 x 6, in which there was a corner: 0 to 1."""
    images: tuple[Explained, ...]
    outliers: tuple[str, ...]
    """Pictures that fit much worse than the others do."""
    rejected: tuple[Rejected, ...]
    hints: tuple[str, ...]
    """What would make it better."""


def calibrate(
    paths: Sequence[Path],
    board: Board,
    *,
    window_px: int = WINDOW_PX,
    progress: Callable[[int], None] = lambda _done: None,
) -> Camera:
    """Find the board in pictures of one camera, and the camera that explains them.

    Args:
        paths: of the pictures, all of one size.
        board: that is in them.
        window_px: half the window in which a chessboard's corner is looked for more closely.
        progress: is told how many pictures are done.

    Raises:
        ConfigError: OpenCV is missing, pictures are of several sizes, too few show the board.
    """
    found = find_views(paths, board, window_px=window_px, progress=progress)
    return explain(found, board, window_px=window_px)


def explain(looked: Views, board: Board, *, window_px: int = WINDOW_PX) -> Camera:
    """The camera that explains views of a board; raises ConfigError if they determine none."""
    views, size = looked.views, looked.size
    found = opencv.solve([(view.points_m, view.pixels) for view in views], size)
    numbers = np.concatenate((found.matrix.ravel(), found.distortion, [found.rms_px]))
    if not np.isfinite(numbers).all():
        text = "these views do not determine a camera"
        cure = "add pictures with the board tilted, near and far"
        raise ConfigError([Problem(text, suggestion=cure)])
    tilts_deg = [
        float(np.degrees(np.arccos(min(1.0, abs(float(rotation[2, 2]))))))
        for rotation in found.rotations
    ]
    images = tuple(
        Explained(name=view.name, corners=len(view.pixels), rms=rms, tilt_deg=tilt_deg)
        for view, rms, tilt_deg in zip(views, found.each_px.tolist(), tilts_deg, strict=True)
    )
    outliers = _outlying(images)
    hints = list(_hints(views, outliers, tilts_deg, window_px=window_px, board=board))
    return Camera(
        rms=found.rms_px,
        width=size[0],
        height=size[1],
        matrix=tuple((row[0], row[1], row[2]) for row in found.matrix.tolist()),
        distortion=tuple(found.distortion.tolist()),
        deviation=tuple(found.deviations.tolist()),
        coverage=_coverage(views, size),
        images=images,
        outliers=outliers,
        rejected=looked.rejected,
        hints=tuple(hints),
    )


def _outlying(images: Sequence[Explained]) -> tuple[str, ...]:
    residuals = np.array([image.rms for image in images])
    median = float(np.median(residuals))
    deviation = 1.4826 * float(np.median(np.abs(residuals - median)))
    bound = max(median + OUTLYING * deviation, LEAST_OUTLYING * median, LEAST_OUTLYING_PX)
    return tuple(image.name for image in images if image.rms > bound)


def _coverage(views: Sequence[View], size: tuple[int, int]) -> float:
    pixels = np.concatenate([view.pixels for view in views])
    cells = np.floor(pixels / np.array(size) * np.array(COVERED)).astype(int)
    cells = np.clip(cells, 0, np.array(COVERED) - 1)
    return len({(column, row) for column, row in cells.tolist()}) / (COVERED[0] * COVERED[1])


def _hints(
    views: Sequence[View],
    outliers: tuple[str, ...],
    tilts_deg: Sequence[float],
    *,
    window_px: int,
    board: Board,
) -> list[str]:
    """What would make it better."""
    hints: list[str] = []
    small = {view.name: view.apart_px for view in views if view.apart_px < 3 * window_px}
    disturbed = [name for name in outliers if name in small and not isinstance(board, Charuco)]
    if disturbed:
        smaller = max(2, int(min(small[name] for name in disturbed) / 4))
        names = ", ".join(disturbed[:5])
        hints.append(
            f"{names}: squares of {min(small[name] for name in disturbed):.0f} px are small for "
            f"{window_px} px on each side of a corner: try --corner-window {smaller}"
        )
    elif outliers:
        hints.append(f"look at {', '.join(outliers[:5])}: blurred, bent, or of another camera?")
    if max(tilts_deg) < 20.0:
        hints.append("the board was never tilted by 20 degrees: focal length and distance mix")
    if len(views) < 8:
        hints.append(f"{len(views)} pictures are few: take 10 to 20")
    return hints
