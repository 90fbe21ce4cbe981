"""A map as a file: an npz of plain arrays with a version, the same bytes for the same map."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files.archives import Archive, packed
from robot.files.ordinary_files import write_ordinary
from robot.fusion.slam.grid import Grid
from robot.fusion.slam.planar import turn
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

FORMAT = "humanoid map 1"
MOST_BYTES = 200_000_000
"""Of all arrays."""
MOST_CELLS, LONGEST_SIDE = 100_000_000, 30_000
"""Of a grid: half a kilometre square in cells of 5 cm."""
MOST_PLACES = 100_000
WHAT = "a map"
CURE = "make one with: humanoid map build --log LOG.npz --trajectory OUT.txt --out MAP.npz"
NEEDED = [
    "format", "cell_m", "origin_m", "grid", "trajectory", "keys", "surface", "place_names",
    "place_poses",
]  # fmt: skip
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
        height_m: of the lidar over the floor; NaN where it is not known.
    """

    grid: Grid
    trajectory: Array
    keys: Array
    surface: Array
    places: dict[str, Array]
    height_m: float = math.nan


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
            **({} if math.isnan(saved.height_m) else {"height_m": np.array(saved.height_m)}),
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
    archive = Archive(path, limit=MOST_BYTES, cure=CURE)
    archive.need(NEEDED, what=WHAT)
    if archive.claim("format").shape or str(archive.array("format")) != FORMAT:
        raise archive.wrong(f"this is no map of this version ({FORMAT!r})")
    saved = SavedMap(
        grid=Grid(
            cells=_cells(archive),
            cell_m=float(archive.numbers("cell_m", shape=()).reshape(-1)[0]),
            origin_m=archive.numbers("origin_m", shape=(2,)),
        ),
        trajectory=archive.numbers("trajectory", shape=(None, 4)),
        keys=archive.numbers("keys", shape=(None, 3)),
        surface=archive.numbers("surface", shape=(None, 5)),
        places=_places(archive),
        height_m=_height_m(archive),
    )
    wrong = _mistake(saved)
    if wrong:
        raise archive.wrong(wrong)
    return saved


def _height_m(archive: Archive) -> float:
    """Of the lidar; a map that was made without that says nothing of it."""
    if "height_m" not in archive.names:
        return math.nan
    return float(archive.numbers("height_m", shape=()).reshape(-1)[0])


def _cells(archive: Archive) -> NDArray[np.uint8]:
    claim = archive.claim("grid")
    if claim.dtype != np.uint8 or len(claim.shape) != 2 or not claim.size:
        raise archive.wrong("grid is none")
    if claim.size > MOST_CELLS or max(claim.shape) > LONGEST_SIDE:
        raise archive.wrong(f"grid has more than {MOST_CELLS} cells, or {LONGEST_SIDE} in a row")
    return cast("NDArray[np.uint8]", archive.array("grid"))


def _places(archive: Archive) -> dict[str, Array]:
    poses = archive.numbers("place_poses", shape=(None, 3), most_rows=MOST_PLACES)
    claim = archive.claim("place_names")
    if claim.dtype.kind != "U" or claim.shape != (len(poses),):
        raise archive.wrong("place_names does not go with place_poses")
    names = [str(name) for name in archive.array("place_names")]
    return dict(zip(names, poses, strict=True))


def _mistake(saved: SavedMap) -> str:
    """What cannot be meant; "" if all can."""
    places = np.array(list(saved.places.values())).reshape(-1, 3)
    for name, values in {
        "origin_m": saved.grid.origin_m, "trajectory": saved.trajectory[:, 1:],
        "keys": saved.keys, "surface": saved.surface, "place_poses": places,
    }.items():  # fmt: skip
        if not np.all(np.abs(values) < LARGEST_M):  # NaN is not less
            return f"{name} holds what is no place"
    if not 1e-3 <= saved.grid.cell_m <= 10.0:
        return "cell_m is no side of a cell"
    if not len(saved.surface) or not len(saved.keys):
        return "it holds no surfaces to localise with"
    return ""
