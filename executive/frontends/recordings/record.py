"""`humanoid sensors record`: a recording to try the other commands on, with the truth beside it."""

from __future__ import annotations

import io
import shlex
from pathlib import Path

import msgspec
import numpy as np

from executive.frontends.composition_root import REALITY
from executive.frontends.new_files import refuse_taken, write
from executive.frontends.output import say, write_json
from executive.meaning.request import setting
from executive.runs import recorded_walk
from executive.runs.lidar_maps.kept import tell_on_screen
from robot.exit_status import ExitStatus
from robot.files.archives import packed
from robot.model.urdf import urdf

LIDAR, LEGS, URDF, TRUTH = "lidar.npz", "legs.npz", "robot.urdf", "truth.txt"


class Asked(msgspec.Struct, frozen=True, kw_only=True):
    """The options of `humanoid sensors record`."""

    world: str
    robot: str
    seed: int
    reality: str
    out: Path
    longest_s: float
    as_json: bool = False


def record(asked: Asked) -> int:
    """Lead the robot through the world, and write what its senses said; returns the exit status.

    Raises:
        ConfigError: something asked for cannot be meant, the folder cannot be written, or has such
            files already.
    """
    there = setting(REALITY.under(asked.reality), asked.world, robot=asked.robot)
    folder, model = asked.out, urdf(there.description).encode()
    for name in (LIDAR, LEGS, URDF, TRUTH):
        refuse_taken(folder / name)
    write(folder / URDF, model, run=folder)  # a folder that takes none is told before it walks
    try:
        walk = recorded_walk.record(
            there, seed=asked.seed, longest_s=asked.longest_s, tell=tell_on_screen
        )
    except BaseException:
        (folder / URDF).unlink(missing_ok=True)
        raise
    rows = io.StringIO()
    np.savetxt(rows, walk.truth, fmt="%.9f")
    write(folder / LIDAR, packed(walk.lidar), run=folder)
    write(folder / LEGS, packed(walk.legs), run=folder)
    write(folder / TRUTH, rows.getvalue().encode(), run=folder)
    told = {
        "out": str(folder),
        "lasted_s": round(float(walk.truth[-1, 0] - walk.truth[0, 0]), 2),
        "way_m": round(float(np.hypot(*np.diff(walk.truth[::100, 1:3], axis=0).T).sum()), 1),
        "scans": len(walk.lidar["t"]),
        "samples": len(walk.truth),
        "reality": asked.reality,
    }
    if asked.as_json:
        write_json(told)
        return ExitStatus.DONE
    say(
        f"{told['lasted_s']:g} s, {told['way_m']:g} m: {told['scans']} scans, {told['samples']} "
        f"samples of legs and IMU (emulated, reality {asked.reality}; led by the simulator's truth)"
    )
    say(f"Done: {folder}  ({LIDAR}, {LEGS}, {URDF}, {TRUTH})")
    for line in _next(folder):
        say(f"  {line}")
    return ExitStatus.DONE


def _next(folder: Path) -> list[str]:
    """What to do with it."""
    at = {name: shlex.quote(str(folder / name)) for name in (LIDAR, LEGS, URDF, "map.npz")}
    way, poses = (shlex.quote(str(folder / name)) for name in ("way.txt", "poses.txt"))
    return [
        f"humanoid map build --log {at[LIDAR]} --trajectory {way} --out {at['map.npz']}",
        f"humanoid sensors estimate --log {at[LEGS]} --urdf {at[URDF]} --out {poses}",
        f"humanoid people --log {at[LIDAR]}",
    ]
