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


def views(
    board: Board, camera: KnownCamera, *, count: int, seed: int, noise: float = 3.0
) -> list[np.ndarray]:
    """Pictures of a board held before a camera, tilted, near and far, with noise."""
    random = np.random.default_rng(seed)
    image = drawn(board)
    matrix = np.array(camera.matrix)
    down, across = np.indices((camera.height * FINER, camera.width * FINER))
    pixels = np.stack([across, down], -1).reshape(-1, 1, 2).astype(np.float64)
    pixels = (pixels + 0.5) / FINER - 0.5
    rays = cv2.undistortPoints(pixels, matrix, np.array(camera.distortion)).reshape(-1, 2)
    rays = np.column_stack((rays, np.ones(len(rays))))
    height, width = image.shape
    half_m = 0.5 * np.array([width, height]) / PX_PER_M
    found: list[np.ndarray] = []
    for _ in range(count):
        turn = cv2.Rodrigues(random.uniform(-0.55, 0.55, 3) * (1, 1, 0.6))[0]
        distance_m = random.uniform(0.9, 1.3) * 2.0 * half_m.max()
        centre = np.array([*(random.uniform(-0.25, 0.25, 2) * distance_m), distance_m])
        origin = centre - turn @ np.array([*half_m, 0.0])
        normal = turn[:, 2]
        depth = (origin @ normal) / (rays @ normal)
        on_board = ((depth[:, None] * rays - origin) @ turn)[:, :2] * PX_PER_M - 0.5
        at = on_board.reshape(*down.shape, 2).astype(np.float32)
        fine = cv2.remap(image, at[..., 0], at[..., 1], cv2.INTER_LINEAR, borderValue=200)
        seen = fine.reshape(camera.height, FINER, camera.width, FINER).mean(axis=(1, 3))
        seen = seen * 0.8 + 20.0 + random.normal(0.0, noise, seen.shape)
        found.append(np.clip(seen, 0, 255).astype(np.uint8))
    return found
