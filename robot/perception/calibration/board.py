"""What is in the pictures: a board, described in a few words on the command line.

chessboard:9x6:0.025                            inner corners, edge of a square [m]
charuco:11x8:0.030:0.022:DICT_5X5_100           squares, edges of a square and a marker [m]
charuco:11x8:0.030:0.022:DICT_5X5_100:legacy    as printed by OpenCV before 4.6
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem

EXAMPLES = "chessboard:9x6:0.025 or charuco:11x8:0.030:0.022:DICT_5X5_100[:legacy]"
MOST_CORNERS_A_SIDE = 50


@dataclass(frozen=True, kw_only=True)
class Chessboard:
    """Black and white squares; counted are the inner corners of a row and of a column."""

    columns: int
    rows: int
    square_m: float

    @property
    def corners_m(self) -> NDArray[np.float32]:
        """The inner corners in the board's frame, row by row, shape (columns * rows, 3)."""
        corners = np.zeros((self.rows * self.columns, 3), dtype=np.float32)
        corners[:, :2] = np.mgrid[: self.columns, : self.rows].T.reshape(-1, 2)
        return (corners * self.square_m).astype(np.float32)


@dataclass(frozen=True, kw_only=True)
class Charuco:
    """A chessboard with markers in its white squares; counted are squares.

    Before OpenCV 4.6 boards began with a white square where the number of rows is even: `legacy`.
    """

    columns: int
    rows: int
    square_m: float
    marker_m: float
    dictionary: str
    legacy: bool = False


Board = Chessboard | Charuco

_SIZE = re.compile(r"(\d{1,3})x(\d{1,3})")
_DICTIONARY = re.compile(r"DICT_[A-Z0-9_]{3,30}")


def read_board(text: str) -> Board:
    """A board from its description.

    Raises:
        ConfigError: it describes none.
    """
    kind, *parts = text.split(":")
    if kind == "chessboard" and len(parts) == 2:
        columns, rows = _size(parts[0], text)
        return Chessboard(columns=columns, rows=rows, square_m=_length_m(parts[1], text))
    if kind == "charuco" and len(parts) in (4, 5) and parts[4:] in ([], ["legacy"]):
        columns, rows = _size(parts[0], text)
        square_m, marker_m = _length_m(parts[1], text), _length_m(parts[2], text)
        if marker_m >= square_m:
            raise _wrong(text, "a marker is smaller than its square")
        if not _DICTIONARY.fullmatch(parts[3]):
            raise _wrong(text, f"{parts[3][:40]!r} is no dictionary of markers (DICT_5X5_100, ...)")
        return Charuco(
            columns=columns, rows=rows, square_m=square_m, marker_m=marker_m,
            dictionary=parts[3], legacy=len(parts) == 5,
        )  # fmt: skip
    raise _wrong(text, "this describes no board")


def _size(part: str, text: str) -> tuple[int, int]:
    found = _SIZE.fullmatch(part)
    columns, rows = (int(found[1]), int(found[2])) if found else (0, 0)
    if not (3 <= columns <= MOST_CORNERS_A_SIDE and 3 <= rows <= MOST_CORNERS_A_SIDE):
        raise _wrong(text, f"{part[:20]!r} is no size like 9x6, of 3 to {MOST_CORNERS_A_SIDE}")
    return columns, rows


def _length_m(part: str, text: str) -> float:
    try:
        length_m = float(part)
    except ValueError:
        length_m = 0.0
    if not 1e-4 <= length_m <= 10.0:
        raise _wrong(text, f"{part[:20]!r} is no length in metres, of 0.0001 to 10")
    return length_m


def _wrong(text: str, message: str) -> ConfigError:
    return ConfigError([Problem(message=f"--board {text[:80]}: {message}", suggestion=EXAMPLES)])
