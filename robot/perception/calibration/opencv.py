# pyright: basic
# OpenCV is optional (extra: vision), and all that calibration asks of it is in this file.
"""OpenCV: corners in pictures, and the camera that explains them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files.pictures import Picture
from robot.perception.calibration.board import Board, Charuco, Chessboard

INSTALL = "pip install 'humanoid-executive[vision]'"
ITERATIONS, ENOUGH_PX = 30, 0.1
"""When the search for a corner is over, as in OpenCV's own calibration program."""

Floats = NDArray[np.float64]
Corners = tuple[NDArray[np.float32], NDArray[np.float32]]
"""Points of the board [m], shape (n, 3), and where they are in the picture [px], shape (n, 2)."""


@dataclass(frozen=True)
class Solution:
    """What OpenCV found."""

    rms_px: float
    matrix: Floats
    distortion: Floats
    deviations: Floats
    """Standard deviations of fx, fy, cx, cy, k1, k2, p1, p2, k3."""
    rotations: list[Floats]
    """Of the board in the camera's frame, one (3, 3) a picture."""
    each_px: Floats


def opencv() -> Any:
    """The library; raises ConfigError with the cure where it is missing."""
    try:
        import cv2
    except ImportError:
        raise _cannot("OpenCV is not installed", INSTALL) from None
    if not hasattr(cv2, "aruco") or not hasattr(cv2, "calibrateCameraExtended"):
        raise _cannot(f"OpenCV {cv2.__version__} lacks calibration", INSTALL)
    return cv2


def find_corners(board: Board, grey: Picture, *, window_px: int) -> Corners | None:
    """The corners of a board in a picture, None where it is not seen.

    Args:
        board: that is looked for, as a whole (chessboard) or in part (ChArUco).
        grey: the picture, shape (height, width).
        window_px: half the window in which a chessboard's corner is looked for more closely.

    Raises:
        ConfigError: OpenCV is missing, or does not know the board's markers.
    """
    cv2 = opencv()
    if isinstance(board, Chessboard):
        flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE
        flags |= cv2.CALIB_CB_FAST_CHECK
        found, corners = cv2.findChessboardCorners(grey, (board.columns, board.rows), flags=flags)
        if not found:
            return None
        until = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, ITERATIONS, ENOUGH_PX)
        corners = cv2.cornerSubPix(grey, corners, (window_px, window_px), (-1, -1), until)
        return board.corners_m, corners.reshape(-1, 2)
    printed = charuco(board)
    corners, ids, _, _ = cv2.aruco.CharucoDetector(printed).detectBoard(grey)
    if ids is None or len(ids) < 4:
        return None
    points_m, pixels = printed.matchImagePoints(corners, ids)
    if points_m is None or len(points_m) < 4 or np.linalg.matrix_rank(_flat(points_m)) < 3:
        return None
    return points_m.reshape(-1, 3), pixels.reshape(-1, 2)


def charuco(board: Charuco) -> Any:
    """OpenCV's own ChArUco board.

    Raises:
        ConfigError: OpenCV is missing, does not know the markers, or has too few of them.
    """
    cv2 = opencv()
    number = getattr(cv2.aruco, board.dictionary, None)
    if number is None:
        known = [name for name in dir(cv2.aruco) if name.startswith("DICT_")]
        raise _cannot(f"OpenCV knows no markers {board.dictionary}", f"one of {', '.join(known)}")
    markers = cv2.aruco.getPredefinedDictionary(number)
    needed, there = board.columns * board.rows // 2, len(markers.bytesList)
    if needed > there:
        text = f"{board.columns}x{board.rows} squares need {needed} markers, and there are {there}"
        raise _cannot(f"{text} in {board.dictionary}", "name the dictionary that was printed")
    size = (board.columns, board.rows)
    printed = cv2.aruco.CharucoBoard(size, board.square_m, board.marker_m, markers)
    printed.setLegacyPattern(board.legacy)
    return printed


def solve(views: Sequence[Corners], size: tuple[int, int]) -> Solution:
    """The pinhole camera with five coefficients of distortion that explains views best [Zhang2000].

    [Zhang2000] Z. Zhang, "A flexible new technique for camera calibration", PAMI 22(11).

    Args:
        views: corners of each picture.
        size: width and height of the pictures [px].

    Raises:
        ConfigError: OpenCV is missing, or the views do not determine a camera.
    """
    cv2 = opencv()
    points_m, pixels = [view[0] for view in views], [view[1] for view in views]
    try:
        rms_px, matrix, distortion, turns, _, deviations, _, each_px = cv2.calibrateCameraExtended(
            points_m, pixels, size, np.eye(3), np.zeros(5)
        )
    except cv2.error:
        text = "these views do not determine a camera"
        raise _cannot(text, "add pictures with the board tilted, near and far") from None
    return Solution(
        rms_px=float(rms_px),
        matrix=np.asarray(matrix, dtype=np.float64),
        distortion=np.asarray(distortion, dtype=np.float64).ravel()[:5],
        deviations=np.asarray(deviations, dtype=np.float64).ravel()[:9],
        rotations=[np.asarray(cv2.Rodrigues(turn)[0], dtype=np.float64) for turn in turns],
        each_px=np.asarray(each_px, dtype=np.float64).ravel(),
    )


def board_pose(view: Corners, matrix: Floats, distortion: Floats) -> Floats:
    """Where the board is in the camera's frame by one picture: X_CT, shape (4, 4) [m]."""
    cv2 = opencv()
    try:
        _, turn, place = cv2.solvePnP(view[0], view[1], matrix, distortion)
    except cv2.error:
        raise _cannot("a picture shows too little of the board", "leave it out") from None
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = cv2.Rodrigues(turn)[0], place.ravel()
    return result


def projected(
    points_m: NDArray[np.float32], X_CT: Floats, matrix: Floats, distortion: Floats
) -> Floats:
    """Where points of a board are in the picture [px], shape (n, 2)."""
    cv2 = opencv()
    turn = cv2.Rodrigues(np.ascontiguousarray(X_CT[:3, :3]))[0]
    points = points_m.astype(np.float64)  # OpenCV answers in the same precision
    pixels, _ = cv2.projectPoints(points, turn, X_CT[:3, 3], matrix, distortion)
    return np.asarray(pixels, dtype=np.float64).reshape(-1, 2)


def rectified(matrix: Floats, distortion: Floats, size: tuple[int, int]) -> Floats:
    """The pinhole camera of the undistorted picture without empty borders, shape (3, 3)."""
    new, _ = opencv().getOptimalNewCameraMatrix(matrix, distortion, size, 0.0)
    return np.asarray(new, dtype=np.float64)


def _flat(points_m: NDArray[np.float32]) -> NDArray[np.float32]:
    """Points of a plane in homogeneous form: of rank 3 unless they lie on one line."""
    flat = points_m.reshape(-1, 3).copy()
    flat[:, 2] = 1.0
    return flat


def _cannot(message: str, cure: str) -> ConfigError:
    return ConfigError([Problem(message=message, suggestion=cure)])
