"""Where the hand (or the head) was at each picture: a table of numbers in a text file.

With a head, in any order, separated by commas:

    image,x,y,z,qw,qx,qy,qz
    a.png,0.312,-0.020,0.411,0.7071,0.0,0.7071,0.0

Without one, a row a picture in the order of their names, separated by commas or blanks: 7 numbers
(x y z qw qx qy qz), 12 or 16 (a homogeneous matrix, row by row), or four rows of four a picture.
Metres, and unit quaternions.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files import yaml_nodes
from robot.se3 import quat_to_matrix

HEAD = ("image", "x", "y", "z", "qw", "qx", "qy", "qz")
FARTHEST_M = 20.0
"""Further than any arm: the numbers are millimetres, most likely."""
NO_ROTATION = 1e-2
_CURE = "docs/perception.md tells how a file of poses looks"

Array = NDArray[np.float64]


def read_poses(path: Path, names: Sequence[str]) -> dict[str, Array]:
    """The pose X_BG of each picture, shape (4, 4).

    Args:
        path: of the table.
        names: of the pictures, in order; those that the table does not name have no pose.

    Raises:
        ConfigError: it cannot be read, or is no such table.
    """
    lines = [line.strip() for line in yaml_nodes.read_text(path).splitlines()]
    rows = [line for line in lines if line and not line.startswith("#")]
    if not rows:
        raise _wrong(path, "there is no pose in it")
    head = tuple(word.strip().lower() for word in rows[0].split(","))
    if head == HEAD:
        cells = [[cell.strip() for cell in row.split(",")] for row in rows[1:]]
        poses = {cell[0]: _pose(path, row, cell[1:]) for row, cell in enumerate(cells, 1)}
        if len(poses) < len(cells):
            raise _wrong(path, "a picture has two poses")
        if not poses.keys() & set(names):
            raise _wrong(path, "it names none of the pictures")
        return poses
    numbers = [row.replace(",", " ").split() for row in rows]
    if len(numbers) == 4 * len(names) and all(len(row) == 4 for row in numbers):
        flat = [cell for row in numbers for cell in row]
        numbers = [flat[begin : begin + 16] for begin in range(0, len(flat), 16)]
    if len(numbers) != len(names):
        raise _wrong(path, f"it has {len(numbers)} rows, and there are {len(names)} pictures")
    return {
        name: _pose(path, number, row)
        for number, (name, row) in enumerate(zip(names, numbers, strict=True), 1)
    }


def _pose(path: Path, row: int, cells: Sequence[str]) -> Array:
    try:
        numbers = np.array([float(cell) for cell in cells])
    except ValueError:
        raise _wrong(path, f"pose {row} holds what is no number") from None
    if len(numbers) not in (7, 12, 16):
        raise _wrong(path, f"pose {row} has {len(numbers)} numbers, and not 7, 12 or 16")
    if not np.isfinite(numbers).all():
        raise _wrong(path, f"pose {row} holds a number that is not finite")
    pose = np.eye(4)
    if len(numbers) == 7:
        length = float(np.linalg.norm(numbers[3:]))
        if abs(length - 1.0) > NO_ROTATION:
            raise _wrong(path, f"the quaternion of pose {row} has length {length:.3g}, and not 1")
        w, x, y, z = (numbers[3:] / length).tolist()
        pose[:3, :3], pose[:3, 3] = quat_to_matrix((w, x, y, z)), numbers[:3]
    else:
        pose[:3] = numbers[:12].reshape(3, 4)
        turn = pose[:3, :3]
        if np.abs(turn @ turn.T - np.eye(3)).max() > NO_ROTATION or np.linalg.det(turn) < 0.0:
            raise _wrong(path, f"the matrix of pose {row} is no rotation")
    if np.abs(pose[:3, 3]).max() > FARTHEST_M:
        raise _wrong(path, f"pose {row} is further than {FARTHEST_M:g} m: are these millimetres?")
    return pose


def _wrong(path: Path, message: str) -> ConfigError:
    return ConfigError([Problem(message=message, file=str(path), suggestion=_CURE)])
