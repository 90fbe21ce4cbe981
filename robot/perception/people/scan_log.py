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

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import overload

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files.archives import Archive, Plain
from robot.perception.people.scan import PlanarScan

MOST_SCANS, MOST_BEAMS = 200_000, 10_000
LARGEST_S, LARGEST_M, LARGEST_RAD = 1e12, 1e6, 100.0
"""Of a stamp (some 30,000 years), of where the laser is, and of an angle."""
NO_RETURN_CM = 8100.0
_LAYOUTS = "docs/perception.md tells how a log of scans looks"

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ScanLog(Sequence[PlanarScan]):
    """The scans of a log: each is made of what is stored when it is asked for.

    Attributes:
        stamps_s: shape (n,).
        ranges: as stored, shape (n, beams).
        per_m: what is stored for 1 m.
        no_return: stored ranges from here on are none.
        bearings: the first, and the step [rad].
        poses: x, y [m], yaw [rad] of the laser, shape (n, 3); None where it stands still.
    """

    stamps_s: Array
    ranges: Plain
    per_m: float
    no_return: float
    bearings: Array
    poses: Array | None

    def __len__(self) -> int:
        """How many scans."""
        return len(self.stamps_s)

    def __iter__(self) -> Iterator[PlanarScan]:
        """One after the other."""
        return map(self.__getitem__, range(len(self)))

    @overload
    def __getitem__(self, index: int) -> PlanarScan: ...
    @overload
    def __getitem__(self, index: slice) -> list[PlanarScan]: ...
    def __getitem__(self, index: int | slice) -> PlanarScan | list[PlanarScan]:
        """A scan, or some."""
        if isinstance(index, slice):
            return [self[number] for number in range(len(self))[index]]
        ranges = self.ranges[index].astype(np.float64)
        first, step = self.bearings.tolist()
        return PlanarScan(
            t_s=float(self.stamps_s[index]),
            ranges_m=np.where(ranges >= self.no_return, 0.0, ranges / self.per_m),
            angle_min_rad=first,
            angle_step_rad=step,
            pose=_pose(self.poses, index),
        )


def read_scans(path: Path) -> ScanLog:
    """The scans of a log, in its order.

    Raises:
        ConfigError: it cannot be read, or is no such log; the message says what is wrong.
    """
    archive = Archive(path, cure=_LAYOUTS)
    prefix = "training_" if "training_scan_t" in archive.names else ""
    if f"{prefix}scan_t" in archive.names:
        log = ScanLog(
            stamps_s=archive.numbers(f"{prefix}scan_t", shape=(None,), most_rows=MOST_SCANS),
            ranges=archive.array(f"{prefix}scan_ranges_mm", shape=(None, None)),
            per_m=1000.0,
            no_return=np.inf,
            bearings=archive.numbers(f"{prefix}scan_angle", shape=(2,)),
            poses=None,
        )
    elif "ranges_cm" in archive.names:
        ends = (archive.numbers(name, shape=()) for name in ("angle_min", "angle_inc"))
        odom = "odom" in archive.names
        log = ScanLog(
            stamps_s=archive.numbers("t", shape=(None,), most_rows=MOST_SCANS),
            ranges=archive.array("ranges_cm", shape=(None, None)),
            per_m=100.0,
            no_return=NO_RETURN_CM,
            bearings=np.array([float(end) for end in ends]),
            poses=archive.numbers("odom", shape=(None, 3)) if odom else None,
        )
    else:
        held = ", ".join(sorted(archive.names)[:10]) or "nothing"
        raise _wrong(path, f"this is no log of scans: it holds {held}")
    _check(path, log)
    return log


def _check(path: Path, log: ScanLog) -> None:
    (scans, beams), bearings = log.ranges.shape, log.bearings
    if len(log) != scans:
        raise _wrong(path, f"it has {scans} scans, and stamps of {len(log)}")
    if not 0 < beams <= MOST_BEAMS:
        raise _wrong(path, f"its scans have {beams} beams; 1 to {MOST_BEAMS} can be read")
    if not (np.abs(log.stamps_s) < LARGEST_S).all():
        raise _wrong(path, "a stamp is not finite, or no time")
    if not np.isfinite(bearings).all() or abs(bearings[0]) > LARGEST_RAD:
        raise _wrong(path, "the angles are not two finite numbers: the first, and the step")
    if not 1e-4 <= bearings[1] <= 0.2 or beams * bearings[1] > 2.0 * np.pi + bearings[1]:
        raise _wrong(path, "the step between the beams is not 1e-4 to 0.2 rad, once around at most")
    poses = log.poses
    if poses is not None and (len(poses) != scans or not (np.abs(poses) < LARGEST_M).all()):
        raise _wrong(path, "odom does not say x, y and yaw of each scan")


def _pose(poses: Array | None, number: int) -> tuple[float, float, float]:
    if poses is None:
        return (0.0, 0.0, 0.0)
    x_m, y_m, yaw_rad = poses[number].tolist()
    return x_m, y_m, yaw_rad


def _wrong(path: Path, message: str) -> ConfigError:
    return ConfigError([Problem(message=message, file=str(path), suggestion=_LAYOUTS)])
