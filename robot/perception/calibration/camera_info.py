"""A calibrated camera as the YAML file of ROS (`camera_info`: plumb_bob, row by row)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec
import numpy as np
import yaml
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files import config
from robot.perception.calibration import opencv
from robot.perception.calibration.intrinsics import Camera

Array = NDArray[np.float64]


def camera_info(camera: Camera, *, name: str) -> str:
    """The text of the file.

    The projection matrix is that of the undistorted picture without empty borders, as ROS's own
    calibrator writes it for a single camera.
    """
    matrix = np.array(camera.matrix)
    distortion = np.array(camera.distortion)
    seen = opencv.rectified(matrix, distortion, (camera.width, camera.height))
    projection = np.column_stack((seen, np.zeros(3)))
    return yaml.safe_dump(
        {
            "image_width": camera.width,
            "image_height": camera.height,
            "camera_name": name,
            "camera_matrix": _matrix(matrix.tolist()),
            "distortion_model": "plumb_bob",
            "distortion_coefficients": _matrix([distortion.tolist()]),
            "rectification_matrix": _matrix(np.eye(3).tolist()),
            "projection_matrix": _matrix(projection.tolist()),
        },
        sort_keys=False,
        default_flow_style=None,
        width=100,
    )


def _matrix(rows: Sequence[Sequence[float]]) -> dict[str, object]:
    return {
        "rows": len(rows),
        "cols": len(rows[0]),
        "data": [float(number) for row in rows for number in row],
    }


class _Matrix(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    rows: int
    cols: int
    data: tuple[float, ...]


class _File(msgspec.Struct, frozen=True):
    camera_matrix: _Matrix
    distortion_coefficients: _Matrix
    distortion_model: str = "plumb_bob"


def read_camera_info(path: Path) -> tuple[Array, Array]:
    """Matrix, shape (3, 3), and distortion k1, k2, p1, p2, k3, shape (5,), of such a file.

    Raises:
        ConfigError: it cannot be read, or is of another model of distortion.
    """
    file = config.load(path, _File)
    if file.distortion_model != "plumb_bob":
        text = f"its distortion_model is {file.distortion_model[:40]}, and not plumb_bob"
        raise ConfigError([Problem(text, str(path), suggestion="calibrate the camera anew")])
    matrix, distortion = (
        np.array(part.data) for part in (file.camera_matrix, file.distortion_coefficients)
    )
    sound = matrix.shape == (9,) and distortion.shape in ((4,), (5,))
    if not sound or not np.isfinite(np.concatenate((matrix, distortion))).all():
        text = "camera_matrix does not have 9 finite numbers, or the distortion not 5"
        raise ConfigError([Problem(text, str(path), suggestion="calibrate the camera anew")])
    return matrix.reshape(3, 3), np.append(distortion, np.zeros(5 - len(distortion)))
