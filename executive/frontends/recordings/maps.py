"""What the commands of `humanoid map` do."""

from __future__ import annotations

import io
import time
from pathlib import Path

import numpy as np

from executive.frontends.new_files import refuse_inputs
from executive.frontends.output import say, write_json
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import write_ordinary
from robot.fusion.slam import building, map_file, picture, recording
from robot.fusion.slam.recording import Recording
from robot.fusion.slam.relocalising import Relocaliser
from robot.printable import printable_line
from robot.se3 import Array

SAID_EVERY_S = 5.0


def build(log: Path, trajectory: Path, *, out: Path | None, as_json: bool) -> int:
    """Run SLAM over a recording, and write what comes of it; returns the exit status.

    Raises:
        ConfigError: a file cannot be read or written.
    """
    refuse_inputs([trajectory, out], [log])
    taken = recording.read(log)
    mapper = building.mapped(taken, progress=_Progress(taken, silent=as_json))
    way = building.trajectory(taken, mapper)
    _put(trajectory, _rows(way).encode())
    if out is not None:
        map_file.save(out, building.saved_map(way, mapper))
    length_m = float(np.hypot(*np.diff(way[:, 1:3], axis=0).T).sum())
    if as_json:
        write_json(
            {
                "sweeps": len(taken),
                "key_frames": len(mapper.scans),
                "loops": mapper.graph.loops,
                "way_m": round(length_m, 2),
            }
        )
        return ExitStatus.DONE
    say(
        f"{len(taken)} sweeps along {length_m:.1f} m: {len(mapper.scans)} key frames, "
        f"{mapper.graph.loops} of them seen again"
    )
    say(f"Done: {trajectory}" + (f" and {out}" if out is not None else ""))
    return ExitStatus.DONE


def show(path: Path, *, snapshot: Path | None, as_json: bool) -> int:
    """Say what a map holds, and draw it; returns the exit status.

    Raises:
        ConfigError: a file cannot be read or written.
    """
    if snapshot is not None and snapshot.suffix.lower() != ".png":
        cure = f"call it {snapshot.stem or 'map'}.png"
        raise ConfigError([Problem("maps are drawn as .png", str(snapshot), suggestion=cure)])
    refuse_inputs([snapshot], [path])
    saved = map_file.load(path)
    if snapshot is not None:
        _put(snapshot, picture.drawn(saved))
    cells, cell_m = saved.grid.cells, saved.grid.cell_m
    width_m, depth_m = (size * cell_m for size in cells.shape)
    free_m2 = float(np.count_nonzero(cells < 64)) * cell_m**2
    length_m = float(np.hypot(*np.diff(saved.trajectory[:, 1:3], axis=0).T).sum())
    if as_json:
        write_json(
            {
                "width_m": round(width_m, 2),
                "depth_m": round(depth_m, 2),
                "cell_m": cell_m,
                "free_m2": round(free_m2, 1),
                "sweeps": len(saved.trajectory),
                "way_m": round(length_m, 2),
                "places": {name: pose.tolist() for name, pose in saved.places.items()},
            }
        )
        return ExitStatus.DONE
    say(f"{width_m:.1f} x {depth_m:.1f} m in cells of {100 * cell_m:g} cm, {free_m2:.0f} m² free")
    say(f"{len(saved.trajectory)} sweeps along {length_m:.1f} m, {len(saved.keys)} key frames")
    for name, (x, y, heading) in saved.places.items():
        at = f"x {x:.2f} m, y {y:.2f} m, heading {np.degrees(heading):.0f} degrees"
        say(f"{printable_line(name)}: {at}")
    if snapshot is not None:
        say(f"Done: {snapshot}")
    return ExitStatus.DONE


def locate(path: Path, *, log: Path, trajectory: Path | None, as_json: bool) -> int:
    """Follow a recording through a map; returns the exit status.

    Raises:
        ConfigError: a file cannot be read or written.
    """
    refuse_inputs([trajectory], [path, log])
    relocaliser = Relocaliser(map_file.load(path))
    taken = recording.read(log)
    progress = _Progress(taken, silent=as_json)
    way = np.full((len(taken), 4), np.nan)
    way[:, 0] = taken.stamps_s
    for index in range(len(taken)):
        pose = relocaliser.locate(taken.scan(index), taken.odometry[index])
        if pose is not None:
            way[index, 1:] = pose
        progress(index + 1)
    if trajectory is not None:
        _put(trajectory, _rows(way).encode())
    known = np.isfinite(way[:, 1])
    first = int(np.argmax(known)) if known.any() else None
    pose = relocaliser.pose
    status = ExitStatus.FAILED if pose is None else ExitStatus.DONE
    if as_json:
        write_json(
            {
                "sweeps": len(taken),
                "located": int(known.sum()),
                "first": first,
                "pose": None if pose is None else [float(value) for value in pose],
            }
        )
        return status
    if first is None:
        say(f"Lost: no place of the map is sure after {len(taken)} sweeps")
        return status
    say(f"Found at sweep {first + 1}; located at {int(known.sum())} of {len(taken)} sweeps")
    if pose is None:
        say("Lost at the end")
    else:
        say(f"At the end: x {pose[0]:.2f} m, y {pose[1]:.2f} m, {np.degrees(pose[2]):.0f} degrees")
    return status


class _Progress:
    """Says now and then how far it is."""

    def __init__(self, taken: Recording, *, silent: bool) -> None:
        self._of = len(taken)
        self._silent = silent
        self._said_s = time.monotonic()

    def __call__(self, done: int) -> None:
        now_s = time.monotonic()
        if self._silent or now_s - self._said_s < SAID_EVERY_S:
            return
        self._said_s = now_s
        say(f"{done} of {self._of} sweeps", err=True)


def _rows(way: Array) -> str:
    file = io.StringIO()
    np.savetxt(file, way, fmt=["%.6f", "%.5f", "%.5f", "%.6f"])
    return file.getvalue()


def _put(path: Path, data: bytes) -> None:
    try:
        write_ordinary(path, data)
    except OSError as error:
        text = f"cannot be written: {error.strerror}"
        raise ConfigError([Problem(text, str(path), suggestion="choose another")]) from None
