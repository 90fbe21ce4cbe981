"""`python -m benchmarks.slam`: planar SLAM on real recordings, beside published figures.

Two kinds: a recording with the relations of Kuemmerle et al. (2009), and logs of CARMEN with
corrected poses, about a metre apart. For these odometry is made: the true steps with errors of
their own, of several sizes. What is "true" there was estimated by others (RBPF), to a few
centimetres: the figures say how far we are from them, not from the truth.
"""

from __future__ import annotations

import gzip
import resource
import time
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from robot.fusion.slam import building, recording
from robot.fusion.slam.planar import between, compose
from robot.fusion.slam.recording import Recording
from robot.se3 import Array

RECORDINGS = Path(__file__).resolve().parent.parent.parent / "shared" / "recordings" / "lidar"
WITHIN_S = 0.02
NEAR_M, LATER = 3.0, 15
PUBLISHED = {
    "scan matching": "0.220±0.296 m",
    "particle filter (50)": "0.070±0.083 m",
    "graph mapping": "0.031±0.026 m",
    "Cartographer 2016": "0.0229±0.0239 m",
}
"""Intel Research Lab, the whole run (ours: its first 1088 s)."""


def main(
    recordings: Annotated[Path, typer.Option(help="the folder of the recordings")] = RECORDINGS,
    match: Annotated[str, typer.Option(help="only recordings whose name contains this")] = "",
) -> None:
    """Measure, and print the tables."""
    console = Console()
    for path in sorted(recordings.glob("*/*_dense_*.npz")):
        if match in path.name:
            console.print(_related(path, next(path.parent.glob("*.relations"))))
    table = Table("building", "odometry", "scans", "steps", "seen again", "far apart", "CPU")
    for path in sorted(recordings.glob("maps/*.log.gz")):
        if match in path.name:
            for scale in (1.0, 3.0):
                table.add_row(*_corrected(path, scale))
    console.print(table)


def _related(path: Path, relations: Path) -> Table:
    """A recording with relations of known poses."""
    taken = recording.read(path)
    begin_s = time.process_time()
    way = building.trajectory(taken, building.mapped(taken))
    cpu_s = time.process_time() - begin_s
    errors = _relation_errors(way, np.loadtxt(relations))
    metres, degrees = np.hypot(errors[:, 0], errors[:, 1]), np.degrees(np.abs(errors[:, 2]))
    share = cpu_s / float(np.nanmax(taken.stamps_s) - np.nanmin(taken.stamps_s))
    megabytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000
    table = Table("", "translation", "rotation", "cost", title=f"{path.stem}, {len(errors)} rel.")
    table.add_row(
        "this",
        f"{metres.mean():.4f}±{metres.std():.4f} m",
        f"{degrees.mean():.3f}±{degrees.std():.3f}°",
        f"{100 * share:.1f} % of a core, {megabytes:.0f} MB",
    )
    for name, figure in PUBLISHED.items():
        table.add_row(name, figure, "", "")
    return table


def _relation_errors(way: Array, relations: Array) -> Array:
    way = way[np.argsort(way[:, 0], kind="stable")]
    rows: list[Array] = []
    for relation in relations:
        found = [int(np.argmin(np.abs(way[:, 0] - stamp))) for stamp in relation[:2]]
        if all(
            abs(way[k, 0] - stamp) <= WITHIN_S for k, stamp in zip(found, relation[:2], strict=True)
        ):
            said = between(way[found[0], 1:], way[found[1], 1:])
            rows.append(between(relation[[2, 3, 7]], said))
    return np.array(rows)


def _corrected(path: Path, scale: float) -> list[str]:
    """A log with corrected poses, driven with odometry of a size of errors."""
    ranges, true = _read(path)
    taken = Recording(
        stamps_s=np.full(len(true), np.nan),
        odometry=_driven(true, scale),
        ranges_cm=ranges,
        angle_min_rad=-np.pi / 2,
        angle_step_rad=np.pi / (ranges.shape[1] // 180 * 180),
        range_max_m=recording.NO_RETURN_M,
    )
    begin_s = time.process_time()
    found = building.mapped(taken).trajectory()
    cpu_s = time.process_time() - begin_s
    away = np.hypot(*(true[:, None, :2] - true[None, :, :2]).transpose(2, 0, 1))
    first, second = np.nonzero(away < NEAR_M)
    again = second - first > LATER
    pairs = np.random.default_rng(0).integers(0, len(true), (len(true), 2))
    index = np.arange(len(true) - 1)
    return [
        path.name.split("-")[0],
        f"x {scale:g}",
        str(len(true)),
        _figure(found, true, index, index + 1),
        _figure(found, true, first[again], second[again]),
        _figure(found, true, pairs[:, 0], pairs[:, 1]),
        f"{cpu_s:.1f} s",
    ]


def _figure(found: Array, true: Array, first: Array, second: Array) -> str:
    error = between(between(true[first], true[second]), between(found[first], found[second]))
    metres = np.hypot(error[:, 0], error[:, 1])
    return f"{metres.mean():.3f} m, {np.degrees(np.abs(error[:, 2])).mean():.2f}°"


def _driven(true: Array, scale: float) -> Array:
    """What wheels might have said: 5 % of a step, 1 degree a metre, 5 % of a turn, and a bias."""
    rng = np.random.default_rng(1)
    steps = between(true[:-1], true[1:])
    way, turn = np.hypot(steps[:, 0], steps[:, 1]), np.abs(steps[:, 2])
    steps[:, :2] += 0.05 * scale * way[:, None] * rng.normal(size=(len(steps), 2))
    steps[:, :2] *= 1.0 + 0.03 * scale * rng.normal()
    blur = np.radians(0.5) + 0.05 * turn + np.radians(1.0) * way
    steps[:, 2] += scale * (blur * rng.normal(size=len(steps)) + np.radians(rng.normal()) * way)
    poses = [np.zeros(3)]
    for step in steps:
        poses.append(compose(poses[-1], step))
    return np.array(poses)


def _read(path: Path) -> tuple[Array, Array]:
    """Ranges [cm] and poses of the FLASER lines of a log."""
    ranges, poses = [], []
    with gzip.open(path, "rt") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "FLASER":
                beams = int(words[1])
                ranges.append([100.0 * float(word) for word in words[2 : 2 + beams]])
                poses.append([float(word) for word in words[2 + beams : 5 + beams]])
    return np.array(ranges), np.array(poses)


if __name__ == "__main__":
    typer.run(main)
