"""A recording becomes a trajectory and a map."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from robot.fusion.slam.grid import occupancy
from robot.fusion.slam.map_file import SavedMap, surface_of
from robot.fusion.slam.mapper import Mapper
from robot.fusion.slam.recording import Recording
from robot.se3 import Array


def mapped(recording: Recording, *, progress: Callable[[int], None] = lambda _done: None) -> Mapper:
    """Run SLAM over a whole recording, in the order of its sweeps.

    Args:
        recording: the sweeps.
        progress: told after each sweep how many are done.
    """
    mapper = Mapper()
    for index in range(len(recording)):
        mapper.add(recording.scan(index), recording.odometry[index])
        progress(index + 1)
    mapper.finish()
    return mapper


def trajectory(recording: Recording, mapper: Mapper) -> Array:
    """Rows of stamp [s], x, y [m], heading [rad], one a sweep, in the order of the file."""
    return np.column_stack([recording.stamps_s, mapper.trajectory()])


def saved_map(way: Array, mapper: Mapper) -> SavedMap:
    """All that is kept, of a trajectory and the key frames."""
    return SavedMap(
        grid=occupancy(mapper.scans, mapper.poses),
        trajectory=way,
        keys=mapper.poses,
        surface=surface_of(mapper.scans, mapper.poses),
        places={"start": way[0, 1:], "end": way[-1, 1:]},
    )
