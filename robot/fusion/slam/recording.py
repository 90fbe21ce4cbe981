"""A recording of a planar lidar and of odometry, from an npz."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np

from robot.archives import Archive, Plain
from robot.errors import ConfigError, Problem
from robot.fusion.slam.scan import Scan, scan_of
from robot.se3 import Array

MOST_BYTES = 400_000_000
"""Of one array: 5 hours of a lidar with 360 beams, 30 times a second, in 2 bytes a beam."""
WHAT = "a lidar recording"
CURE = "docs/localisation.md says what a recording holds"
NAMES = {
    "odom": True, "ranges_cm": True, "angle_min": True, "angle_inc": True,
    "t": False, "max_valid": False,
}  # fmt: skip
NO_RETURN_M = 81.0
"""What the widespread SICK lidars say where nothing came back: 81 m and above, in centimetres."""
MOST_SCANS = 1_000_000
FEWEST_BEAMS, MOST_BEAMS = 8, 10_000
LARGEST_M = 1e6
PILE = 20.0
"""The largest range of a recording is no return, too, if it is this much commoner than those just
below it."""
BELOW_M = 0.5


@dataclass(frozen=True, eq=False)
class Recording:
    """Sweeps with what odometry said at each, in the order in which they were taken.

    Attributes:
        stamps_s: (n,); NaN where it is not known. They may be out of order.
        odometry: (n, 3) of x, y [m] and heading [rad].
        ranges_cm: (n, beams).
        angle_min_rad: of the first beam.
        angle_step_rad: to the next one; negative in a lidar that turns clockwise.
        range_max_m: ranges from here on are no returns.
    """

    stamps_s: Array
    odometry: Array
    ranges_cm: Plain
    angle_min_rad: float
    angle_step_rad: float
    range_max_m: float

    def __len__(self) -> int:
        """How many sweeps."""
        return len(self.stamps_s)

    def scan(self, index: int) -> Scan:
        """One sweep."""
        return scan_of(
            np.asarray(self.ranges_cm[index], dtype=float) * 0.01,
            self.angle_min_rad,
            self.angle_step_rad,
            range_max_m=self.range_max_m,
        )


def read(path: Path) -> Recording:
    """Read an npz of `odom`, `ranges_cm`, `angle_min`, `angle_inc`, `t` and `max_valid`.

    Raises:
        ConfigError: it is none, or what it holds cannot be meant.
    """
    found = Archive(path, limit=MOST_BYTES, cure=CURE).arrays(NAMES, what=WHAT)
    wrong = _mistake(found)
    if wrong:
        raise ConfigError([Problem(wrong, str(path), suggestion=CURE)])
    ranges = found["ranges_cm"]
    odometry = np.asarray(found["odom"], dtype=float)
    stamps = found.get("t")
    limit_m = _number(found["max_valid"]) if "max_valid" in found else NO_RETURN_M
    limit_m = limit_m if 0.0 < limit_m < NO_RETURN_M else NO_RETURN_M
    return Recording(
        stamps_s=np.full(len(odometry), np.nan) if stamps is None else np.asarray(stamps, float),
        odometry=odometry,
        ranges_cm=ranges,
        angle_min_rad=_number(found["angle_min"]),
        angle_step_rad=_number(found["angle_inc"]),
        range_max_m=min(limit_m, _pile_m(ranges)),
    )


def _mistake(found: dict[str, Plain]) -> str:
    """What cannot be meant; "" if all can."""
    for name, array in found.items():
        if array.dtype.kind not in "iuf":
            return f"{name} does not hold numbers"
    odometry, ranges = found["odom"], found["ranges_cm"]
    if ranges.ndim != 2:
        return "ranges_cm must have a row a sweep and a column a beam"
    if odometry.shape != (len(ranges), 3):
        return f"odom must have {len(ranges)} rows of x, y and heading, as many as ranges_cm"
    if "t" in found and found["t"].shape != (len(ranges),):
        return f"t must have {len(ranges)} stamps, as many as ranges_cm has rows"
    if not 0 < len(ranges) <= MOST_SCANS:
        return f"it has {len(ranges)} sweeps; 1 to {MOST_SCANS} can be read"
    if not FEWEST_BEAMS <= ranges.shape[1] <= MOST_BEAMS:
        return f"it has {ranges.shape[1]} beams; {FEWEST_BEAMS} to {MOST_BEAMS} can be read"
    odometry = np.asarray(odometry, dtype=float)
    bad = ~np.all(np.isfinite(odometry) & (np.abs(odometry) < LARGEST_M), axis=1)
    if bad.any():
        return f"row {int(np.argmax(bad))} of odom is no pose"
    for name in ("angle_min", "angle_inc", "max_valid"):
        if name in found and (found[name].size != 1 or not np.isfinite(_number(found[name]))):
            return f"{name} must be one number"
    whole = abs(_number(found["angle_inc"])) * ranges.shape[1]
    if not 1e-3 < whole < 2.1 * np.pi:
        return f"angle_inc makes {np.degrees(whole):.3g} degrees of {ranges.shape[1]} beams"
    return ""


def _number(array: Plain) -> float:
    return float(cast("float", array.reshape(-1)[0]))


def _pile_m(ranges_cm: Plain) -> float:
    """The largest range, if it is what this lidar says for no return; else infinity."""
    some = np.asarray(ranges_cm[:: max(1, len(ranges_cm) // 2000)], dtype=float).ravel()
    some = some[np.isfinite(some) & (some < 100.0 * NO_RETURN_M)]
    if not len(some):
        return float("inf")
    top = float(some.max())
    at_top = np.count_nonzero(some > top - 0.5)
    below = np.count_nonzero((some > top - 100.0 * BELOW_M) & (some <= top - 0.5))
    a_centimetre = below / (100.0 * BELOW_M)
    return 0.01 * top - 0.005 if at_top > PILE * max(a_centimetre, 1.0) else float("inf")
