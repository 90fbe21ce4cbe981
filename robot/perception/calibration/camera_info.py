"""A calibrated camera as the YAML file of ROS (`camera_info`: plumb_bob, row by row)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import yaml

from robot.perception.calibration import opencv
from robot.perception.calibration.intrinsics import Camera


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
