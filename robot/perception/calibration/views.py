"""The pictures of one camera in which a board is seen, and its corners in each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files.pictures import read_grey
from robot.perception.calibration import opencv
from robot.perception.calibration.board import Board, Charuco

WINDOW_PX = 11
"""Half the window around a chessboard's corner, as in OpenCV's own calibration program."""
FEWEST_VIEWS = 3


@dataclass(frozen=True, kw_only=True)
class View:
    """The corners of a board in one picture."""

    name: str
    points_m: NDArray[np.float32]
    """On the board, shape (n, 3)."""
    pixels: NDArray[np.float32]
    """In the picture, shape (n, 2)."""

    @property
    def apart_px(self) -> float:
        """The least distance between corners in the picture."""
        far = self.pixels[:, None] - self.pixels[None]
        distances_px = np.linalg.norm(far, axis=-1)
        return float(distances_px[~np.eye(len(far), dtype=bool)].min())


@dataclass(frozen=True, kw_only=True)
class Rejected:
    """A picture that could not be used, and why."""

    name: str
    reason: str


@dataclass(frozen=True, kw_only=True)
class Views:
    """What was found in the pictures of a camera."""

    size: tuple[int, int]
    """Width and height of all of them [px]."""
    views: tuple[View, ...]
    rejected: tuple[Rejected, ...]


def find_views(
    paths: Sequence[Path],
    board: Board,
    *,
    window_px: int = WINDOW_PX,
    progress: Callable[[int], None] = lambda _done: None,
) -> Views:
    """Look for a board in pictures of one camera.

    Args:
        paths: of the pictures, all of one size.
        board: that is looked for.
        window_px: half the window in which a chessboard's corner is looked for more closely.
        progress: is told how many pictures are done.

    Raises:
        ConfigError: OpenCV is missing, pictures are of several sizes, too few show the board.
    """
    opencv.opencv()
    views: list[View] = []
    rejected: list[Rejected] = []
    size: tuple[int, int] | None = None
    for done, path in enumerate(paths, 1):
        progress(done)
        try:
            grey = read_grey(path)
        except ConfigError as error:
            rejected.append(Rejected(name=path.name, reason=error.problems[0].message))
            continue
        here = (grey.shape[1], grey.shape[0])
        if size is not None and size != here:
            text = f"there are pictures of {size[0]}x{size[1]} and of {here[0]}x{here[1]} pixels"
            cure = "calibrate each camera with its own pictures: --images 'FOLDER/left*.png'"
            raise ConfigError([Problem(text, str(path), suggestion=cure)])
        size = here
        corners = opencv.find_corners(board, grey, window_px=window_px)
        if corners is None:
            rejected.append(Rejected(name=path.name, reason="the board is not seen in it"))
        else:
            views.append(View(name=path.name, points_m=corners[0], pixels=corners[1]))
    if size is None or len(views) < FEWEST_VIEWS:
        raise _too_few(len(views), paths, board, window_px)
    return Views(size=size, views=tuple(views), rejected=tuple(rejected))


def _too_few(found: int, paths: Sequence[Path], board: Board, window_px: int) -> ConfigError:
    cure = "take 10 to 20 pictures with all of it in view, tilted, near and far"
    if isinstance(board, Charuco) and (other := _other_pattern(paths, board, window_px)):
        cure = other
    text = f"the board is seen in {found} of {len(paths)} pictures, and {FEWEST_VIEWS} are needed"
    return ConfigError([Problem(text, suggestion=cure)])


def _other_pattern(paths: Sequence[Path], board: Charuco, window_px: int) -> str:
    """What to say where the board is seen once it is taken for the other pattern."""
    other = Charuco(
        columns=board.columns, rows=board.rows, square_m=board.square_m, marker_m=board.marker_m,
        dictionary=board.dictionary, legacy=not board.legacy,
    )  # fmt: skip
    for path in paths[:5]:
        try:
            grey = read_grey(path)
        except ConfigError:
            continue
        if opencv.find_corners(other, grey, window_px=window_px) is not None:
            with_it = "add :legacy to" if other.legacy else "leave :legacy out of"
            return f"{with_it} --board: in {path.name} the pattern is the other one"
    return ""
