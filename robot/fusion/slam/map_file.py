"""A map as a file: an npz of plain arrays with a version, the same bytes for the same map."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from robot.archives import Archive, Plain, packed
from robot.errors import ConfigError, Problem
from robot.fusion.slam.grid import Grid
from robot.fusion.slam.planar import turn
from robot.fusion.slam.scan import Scan
from robot.ordinary_files import write_ordinary
from robot.se3 import Array

FORMAT = "humanoid map 1"
MOST_BYTES = 400_000_000
"""Of one array."""
WHAT = "a map"
CURE = "make one with: humanoid map build --log LOG.npz --trajectory OUT.txt --out MAP.npz"
NAMES = {
    "format": True, "cell_m": True, "origin_m": True, "grid": True, "trajectory": True,
    "keys": True, "surface": True, "place_names": True, "place_poses": True,
}  # fmt: skip
SURFACE_M = 0.05
"""Of the points in a cell of this side one is kept to localise with."""
LARGEST_M = 1e5


@dataclass(frozen=True, eq=False)
class SavedMap:
    """What is kept of a building.

    Attributes:
        grid: occupancy.
        trajectory: (n, 4) of stamp [s], x, y [m], heading [rad] of every scan.
        keys: (k, 3) poses of the key frames.
        surface: (p, 5) points [m], their normals, and their spans [m]: what scans are matched to.
        places: poses (3,) by name.
    """

    grid: Grid
    trajectory: Array
    keys: Array
    surface: Array
    places: dict[str, Array]


def surface_of(scans: list[Scan], poses: Array) -> Array:
    """Points, normals and spans of scans at poses, thinned, shape (p, 5)."""
    parts: list[Array] = []
    for scan, pose in zip(scans, poses, strict=True):
        rotation = turn(float(pose[2]))
        points, normals = scan.points @ rotation + pose[:2], scan.normals @ rotation
        parts.append(np.column_stack([points, normals, scan.spans_m]))
    everything = np.concatenate(parts)
    cells = np.floor(everything[:, :2] / SURFACE_M).astype(np.int64)
    _, first = np.unique(cells, axis=0, return_index=True)
    return everything[np.sort(first)]


def save(path: Path, saved: SavedMap) -> None:
    """Write a map in place of the file of that name, if there is one.

    Raises:
        ConfigError: it cannot be written.
    """
    names = sorted(saved.places)
    data = packed(
        {
            "format": np.array(FORMAT),
            "cell_m": np.array(saved.grid.cell_m),
            "origin_m": saved.grid.origin_m,
            "grid": saved.grid.cells,
            "trajectory": saved.trajectory,
            "keys": saved.keys,
            "surface": saved.surface.astype(np.float32),
            "place_names": np.array(names, dtype="U64"),
            "place_poses": np.array([saved.places[name] for name in names]).reshape(-1, 3),
        }
    )
    try:
        write_ordinary(path, data)
    except OSError as error:
        raise ConfigError(
            [
                Problem(
                    f"cannot be written: {error.strerror}", str(path), suggestion="choose another"
                )
            ]
        ) from None


def load(path: Path) -> SavedMap:
    """Read a map.

    Raises:
        ConfigError: it is none, of another version, or what it holds cannot be meant.
    """
    found = Archive(path, limit=MOST_BYTES, cure=CURE).arrays(NAMES, what=WHAT)
    wrong = _mistake(found)
    if wrong:
        raise ConfigError([Problem(wrong, str(path), suggestion=CURE)])
    names = [str(name) for name in found["place_names"]]
    poses = np.asarray(found["place_poses"], dtype=float)
    return SavedMap(
        grid=Grid(
            cells=cast("NDArray[np.uint8]", found["grid"]),
            cell_m=float(np.asarray(found["cell_m"], dtype=float).reshape(-1)[0]),
            origin_m=np.asarray(found["origin_m"], dtype=float),
        ),
        trajectory=np.asarray(found["trajectory"], dtype=float),
        keys=np.asarray(found["keys"], dtype=float),
        surface=np.asarray(found["surface"], dtype=float),
        places=dict(zip(names, poses, strict=True)),
    )


SHAPES: dict[str, tuple[int | None, ...]] = {
    "origin_m": (2,), "trajectory": (None, 4), "keys": (None, 3), "surface": (None, 5),
    "place_poses": (None, 3),
}  # fmt: skip


def _mistake(found: dict[str, Plain]) -> str:
    """What cannot be meant; "" if all can."""
    text = str(found["format"]) if found["format"].ndim == 0 else ""
    if text != FORMAT:
        return f"this is no map of this version ({FORMAT!r})"
    for name, shape in SHAPES.items():
        array = found[name]
        if array.dtype.kind != "f" or len(array.shape) != len(shape):
            return f"{name} is none"
        if any(want not in (None, got) for want, got in zip(shape, array.shape, strict=True)):
            return f"{name} is none"
        values = array[:, 1:] if name == "trajectory" else array
        if not np.all(np.abs(np.asarray(values, dtype=float)) < LARGEST_M):  # NaN is not less
            return f"{name} holds what is no place"
    if found["grid"].dtype != np.uint8 or found["grid"].ndim != 2 or not found["grid"].size:
        return "grid is none"
    if found["cell_m"].dtype.kind != "f" or found["cell_m"].size != 1:
        return "cell_m is none"
    if not 1e-3 <= float(np.asarray(found["cell_m"], dtype=float).reshape(-1)[0]) <= 10.0:
        return "cell_m is no side of a cell"
    if not len(found["surface"]) or not len(found["keys"]):
        return "it holds no surfaces to localise with"
    names = found["place_names"]
    if names.dtype.kind != "U" or names.shape != (len(found["place_poses"]),):
        return "place_names does not go with place_poses"
    return ""
