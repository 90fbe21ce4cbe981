"""Pictures of calibration boards, rendered through a camera that is known exactly."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from robot.perception.calibration import opencv
from robot.perception.calibration.board import Board, Charuco

PX_PER_M = 6000.0
FINER = 2
"""Rays for each pixel, across and down: a real pixel is no point either."""


@dataclass(frozen=True)
class KnownCamera:
    """A pinhole with distortion k1, k2, p1, p2, k3."""

    width: int = 640
    height: int = 480
    matrix: tuple[tuple[float, ...], ...] = ((560.0, 0, 331.0), (0, 556.0, 233.0), (0, 0, 1.0))
    distortion: tuple[float, ...] = (-0.24, 0.09, 0.0012, -0.0008, 0.0)


def drawn(board: Board) -> np.ndarray:
    """A board as printed, with a white margin of a square."""
    square = round(board.square_m * PX_PER_M)
    if isinstance(board, Charuco):
        size = (board.columns * square, board.rows * square)
        image = opencv.charuco(board).generateImage(size, marginSize=0)
    else:
        rows, columns = np.indices(((board.rows + 1) * square, (board.columns + 1) * square))
        image = np.where((rows // square + columns // square) % 2 == 0, 0, 255).astype(np.uint8)
    return np.pad(image, square, constant_values=255)


def board_poses(board: Board, *, count: int, seed: int) -> list[np.ndarray]:
    """Where a board is held before the camera, tilted, near and far: X_CT, each of shape (4, 4)."""
    random = np.random.default_rng(seed)
    margins = 1 if isinstance(board, Charuco) else 0  # T is at the first inner corner, or square
    columns, rows = board.columns - 1 + margins, board.rows - 1 + margins
    middle_m = 0.5 * board.square_m * np.array([columns, rows, 0.0])
    whole_m = board.square_m * (max(columns, rows) + 3)
    found: list[np.ndarray] = []
    for _ in range(count):
        pose = np.eye(4)
        pose[:3, :3] = cv2.Rodrigues(random.uniform(-0.55, 0.55, 3) * (1, 1, 0.6))[0]
        distance_m = random.uniform(0.95, 1.35) * whole_m
        centre_m = np.array([*(random.uniform(-0.25, 0.25, 2) * distance_m), distance_m])
        pose[:3, 3] = centre_m - pose[:3, :3] @ middle_m
        found.append(pose)
    return found


def rendered(
    board: Board, camera: KnownCamera, poses: list[np.ndarray], *, seed: int, noise: float = 3.0
) -> list[np.ndarray]:
    """Pictures of a board that is held so before a camera, with noise."""
    random = np.random.default_rng(seed)
    image = drawn(board)
    # From the board's frame to the drawing: a white margin, and of a chessboard one more square.
    begin_m = board.square_m * (1.0 if isinstance(board, Charuco) else 2.0)
    down, across = np.indices((camera.height * FINER, camera.width * FINER))
    pixels = np.stack([across, down], -1).reshape(-1, 1, 2).astype(np.float64)
    pixels = (pixels + 0.5) / FINER - 0.5
    matrix, distortion = np.array(camera.matrix), np.array(camera.distortion)
    rays = cv2.undistortPoints(pixels, matrix, distortion).reshape(-1, 2)
    rays = np.column_stack((rays, np.ones(len(rays))))
    found: list[np.ndarray] = []
    for pose in poses:
        turn, origin = pose[:3, :3], pose[:3, 3]
        depth = (origin @ turn[:, 2]) / (rays @ turn[:, 2])
        on_board = ((depth[:, None] * rays - origin) @ turn)[:, :2]
        on_board = (on_board + begin_m) * PX_PER_M - 0.5
        at = on_board.reshape(*down.shape, 2).astype(np.float32)
        fine = cv2.remap(image, at[..., 0], at[..., 1], cv2.INTER_LINEAR, borderValue=200)
        seen = fine.reshape(camera.height, FINER, camera.width, FINER).mean(axis=(1, 3))
        seen = seen * 0.8 + 20.0 + random.normal(0.0, noise, seen.shape)
        found.append(np.clip(seen, 0, 255).astype(np.uint8))
    return found


def views(board: Board, camera: KnownCamera, *, count: int, seed: int) -> list[np.ndarray]:
    """Pictures of a board held before a camera."""
    return rendered(board, camera, board_poses(board, count=count, seed=seed), seed=seed)
