"""How everything stands, in shared memory: written by the plant, read by who renders pictures.

The plant is never held up by a picture: it writes a record (`robot.drivers.simulation.seqlock`),
and does not know who reads it.
"""

from __future__ import annotations

import contextlib
import mmap
from pathlib import Path

import mujoco
import numpy as np

from robot.closing import Closing
from robot.drivers.simulation.seqlock import Seqlock
from robot.errors import DriverError
from robot.se3 import Array

NAME = "scene"
"""Of the file."""


class SceneMemory(Closing):
    """One record: the time, and all that says where the bodies of a model are."""

    def __init__(self, model: mujoco.MjModel, folder: Path, *, create: bool) -> None:
        """Map the file; the plant creates it.

        Raises:
            DriverError: it is not there, or of another model.
        """
        path, count = folder / NAME, 1 + model.nq + model.nv + 7 * model.nmocap
        size = Seqlock.bytes_for(count)
        if create:
            fresh = path.with_suffix(".new")
            fresh.write_bytes(bytes(size))
            fresh.rename(path)  # a reader sees all of it or no file
        try:
            with path.open("r+b") as file:
                if file.seek(0, 2) != size:
                    raise DriverError(f"the scene's memory {path} is of another world")
                self._map = mmap.mmap(file.fileno(), size)
        except OSError as error:
            raise DriverError(f"the scene's memory {path} cannot be mapped: {error}") from error
        self._record = Seqlock(self._map, 0, size=count)
        self._values: Array = np.zeros(count)
        self._cuts = np.cumsum([1, model.nq, model.nv, 3 * model.nmocap])

    def write(self, stamp_s: float, data: mujoco.MjData) -> None:
        """Tell how everything stands now."""
        parts = ([stamp_s], data.qpos, data.qvel, data.mocap_pos.ravel(), data.mocap_quat.ravel())
        np.concatenate(parts, out=self._values)
        self._record.write(self._values)

    def read(self, data: mujoco.MjData) -> float | None:
        """Put everything where it stands, and say when that was; None if that was read before."""
        values = self._record.news()
        if values is None:
            return None
        stamp, qpos, qvel, position, quat = np.split(values, self._cuts)
        data.qpos[:], data.qvel[:] = qpos, qvel
        data.mocap_pos[:] = position.reshape(-1, 3)
        data.mocap_quat[:] = quat.reshape(-1, 4)
        return float(stamp[0])

    def close(self) -> None:
        """Let go of the memory."""
        self._record.release()
        with contextlib.suppress(BufferError):  # somebody still looks at it
            self._map.close()
