"""Scans out of a recording: a NumPy archive in one of the two layouts below.

| | one | two |
|---|---|---|
| stamps [s] | `scan_t` | `t` |
| ranges, (scans, beams) | `scan_ranges_mm` [mm], 0: no return | `ranges_cm` [cm], >= 8100: none |
| bearings [rad] | `scan_angle`: the first, and the step | `angle_min`, `angle_inc` |
| the laser's pose | stands still | `odom` [m, m, rad], if there is one |

Names of the first may begin with `training_`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robot.archives import Archive
from robot.errors import ConfigError, Problem
from robot.perception.people.scan import PlanarScan

MOST_SCANS, MOST_BEAMS = 200_000, 10_000
NO_RETURN_CM = 8100.0
_LAYOUTS = "docs/perception.md tells how a log of scans looks"

Array = NDArray[np.float64]


def read_scans(path: Path) -> list[PlanarScan]:
    """The scans of a log, in its order.

    Raises:
        ConfigError: it cannot be read, or is no such log; the message says what is wrong.
    """
    archive = Archive(path)
    prefix = "training_" if "training_scan_t" in archive.names else ""
    if f"{prefix}scan_t" in archive.names:
        stamps_s = archive.numbers(f"{prefix}scan_t", axes=1)
        ranges_m = archive.numbers(f"{prefix}scan_ranges_mm", axes=2) / 1000.0
        bearings = archive.numbers(f"{prefix}scan_angle", axes=1)
        poses = None
    elif "ranges_cm" in archive.names:
        stamps_s = archive.numbers("t", axes=1)
        ranges_cm = archive.numbers("ranges_cm", axes=2)
        ranges_m = np.where(ranges_cm >= NO_RETURN_CM, 0.0, ranges_cm / 100.0)
        ends = (archive.numbers("angle_min", axes=0), archive.numbers("angle_inc", axes=0))
        bearings = np.array([float(end) for end in ends])
        poses = archive.numbers("odom", axes=2) if "odom" in archive.names else None
    else:
        held = ", ".join(sorted(archive.names)[:10]) or "nothing"
        raise _wrong(path, f"this is no log of scans: it holds {held}")
    _check(path, stamps_s, ranges_m, bearings)
    if poses is not None and (poses.shape != (len(ranges_m), 3) or not np.isfinite(poses).all()):
        raise _wrong(path, "odom does not say x, y and yaw of each scan")
    return [
        PlanarScan(
            t_s=float(stamp_s),
            ranges_m=ranges_m[number],
            angle_min_rad=float(bearings[0]),
            angle_step_rad=float(bearings[1]),
            pose=_pose(poses, number),
        )
        for number, stamp_s in enumerate(stamps_s)
    ]


def _check(path: Path, stamps_s: Array, ranges_m: Array, bearings: Array) -> None:
    scans, beams = ranges_m.shape
    if len(stamps_s) != scans:
        raise _wrong(path, f"it has {scans} scans, and stamps of {len(stamps_s)}")
    if scans > MOST_SCANS or beams > MOST_BEAMS:
        raise _wrong(path, f"more than {MOST_SCANS} scans of {MOST_BEAMS} beams are too many")
    if not np.isfinite(stamps_s).all():
        raise _wrong(path, "a stamp is not finite")
    if bearings.shape != (2,) or not np.isfinite(bearings).all():
        raise _wrong(path, "the angles are not two finite numbers: the first, and the step")
    if not 1e-4 <= bearings[1] <= 0.2 or beams * bearings[1] > 2.0 * np.pi + bearings[1]:
        raise _wrong(path, "the step between the beams is not 1e-4 to 0.2 rad, once around at most")


def _pose(poses: Array | None, number: int) -> tuple[float, float, float]:
    if poses is None:
        return (0.0, 0.0, 0.0)
    x_m, y_m, yaw_rad = poses[number].tolist()
    return x_m, y_m, yaw_rad


def _wrong(path: Path, message: str) -> ConfigError:
    return ConfigError([Problem(message=message, file=str(path), suggestion=_LAYOUTS)])
