"""A recording of a planar lidar and of odometry, from an npz."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from robot.files.archives import Archive, Plain
from robot.fusion.slam.scan import Scan, scan_of
from robot.se3 import Array

MOST_BYTES = 250_000_000
"""Of all arrays: 3 hours of a lidar with 360 beams, 30 times a second, in 2 bytes a beam."""
WHAT = "a lidar recording"
CURE = "docs/localisation.md says what a recording holds"
NEEDED = ["odom", "ranges_cm", "angle_min", "angle_inc"]
NO_RETURN_M = 81.0
"""What the widespread SICK lidars say where nothing came back: 81 m and above, in centimetres."""
MOST_SCANS = 1_000_000
FEWEST_BEAMS, MOST_BEAMS = 8, 10_000
LARGEST_M = 1e6
LARGEST_RAD = 1e3
"""Of the first beam's angle."""
SAMPLED = 5_000_000
"""Ranges of a recording that are looked at for what no return is."""
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
    archive = Archive(path, limit=MOST_BYTES, cure=CURE)
    archive.need(NEEDED, what=WHAT)
    odometry = archive.numbers("odom", shape=(None, 3), most_rows=MOST_SCANS)
    ranges = archive.array("ranges_cm", shape=(None, None))
    stamps = np.full(len(odometry), np.nan)
    if "t" in archive.names:
        stamps = archive.numbers("t", shape=(None,), most_rows=MOST_SCANS)
    first_rad, step_rad = (_number(archive, name) for name in ("angle_min", "angle_inc"))
    limit_m = _number(archive, "max_valid") if "max_valid" in archive.names else NO_RETURN_M
    taken = Recording(
        stamps_s=stamps,
        odometry=odometry,
        ranges_cm=ranges,
        angle_min_rad=first_rad,
        angle_step_rad=step_rad,
        range_max_m=limit_m if 0.0 < limit_m < NO_RETURN_M else NO_RETURN_M,
    )
    wrong = _mistake(taken)
    if wrong:
        raise archive.wrong(wrong)
    return replace(taken, range_max_m=min(taken.range_max_m, _pile_m(ranges)))


def _mistake(taken: Recording) -> str:
    """What cannot be meant; "" if all can."""
    odometry, ranges = taken.odometry, taken.ranges_cm
    if len(odometry) != len(ranges):
        return f"odom must have {len(ranges)} rows of x, y and heading, as many as ranges_cm"
    if len(taken.stamps_s) != len(ranges):
        return f"t must have {len(ranges)} stamps, as many as ranges_cm has rows"
    if not len(ranges):
        return f"it has no sweeps; 1 to {MOST_SCANS} can be read"
    if not FEWEST_BEAMS <= ranges.shape[1] <= MOST_BEAMS:
        return f"it has {ranges.shape[1]} beams; {FEWEST_BEAMS} to {MOST_BEAMS} can be read"
    bad = ~np.all(np.abs(odometry) < LARGEST_M, axis=1)  # NaN is not less
    if bad.any():
        return f"row {int(np.argmax(bad))} of odom is no pose"
    if abs(taken.angle_min_rad) > LARGEST_RAD:
        return f"angle_min is {taken.angle_min_rad:g} rad, more than {LARGEST_RAD:g}"
    whole = abs(taken.angle_step_rad) * ranges.shape[1]
    if not 1e-3 < whole < 2.1 * np.pi:
        return f"angle_inc makes {np.degrees(whole):.3g} degrees of {ranges.shape[1]} beams"
    return ""


def _number(archive: Archive, name: str) -> float:
    """One finite number, alone or in an array of one."""
    axes = len(archive.claim(name).shape)
    number = archive.numbers(name, shape=(1,) * axes)
    if not np.isfinite(number).all():
        raise archive.wrong(f"{name} must be one number")
    return float(number.reshape(-1)[0])


def _pile_m(ranges_cm: Plain) -> float:
    """The largest range, if it is what this lidar says for no return; else infinity."""
    every = max(1, len(ranges_cm) // 2000, -(-ranges_cm.size // SAMPLED))
    some = np.asarray(ranges_cm[::every], dtype=float).ravel()
    some = some[np.isfinite(some) & (some < 100.0 * NO_RETURN_M)]
    if not len(some):
        return float("inf")
    top = float(some.max())
    at_top = np.count_nonzero(some > top - 0.5)
    below = np.count_nonzero((some > top - 100.0 * BELOW_M) & (some <= top - 0.5))
    a_centimetre = below / (100.0 * BELOW_M)
    return 0.01 * top - 0.005 if at_top > PILE * max(a_centimetre, 1.0) else float("inf")
