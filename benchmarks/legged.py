"""`python -m benchmarks.legged`: how well the state estimator tells where a walking base is.

Walks of the simulated robot, recorded with the flaws of real sensors (`legged_walks`), and a real
recording if one is given. Errors are aligned on the first pose, as published figures are.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np
import typer

from benchmarks.legged_walks import Flaws, record, spoil
from benchmarks.markdown import table
from robot.fusion.state_estimator import legged_body, legged_log, replay, urdf_chains
from robot.fusion.state_estimator.legged_body import LeggedBody
from robot.fusion.state_estimator.legged_log import LeggedLog
from robot.fusion.state_estimator.replay import Trajectory
from robot.model import description
from robot.model import urdf as writer
from robot.se3 import SE3, rotation_vector

DEG = np.pi / 180.0
GROUNDS = {"hard, friction 0.8": (0.8, 0.02), "soft, friction 0.4": (0.4, 0.04)}
FLAWS = {
    "gyro bias 0.1 deg/s": Flaws(gyro_bias_rad_s=0.1 * DEG),
    "0.4 deg/s": Flaws(),
    "1.0 deg/s": Flaws(gyro_bias_rad_s=1.0 * DEG),
    "0.4 deg/s, feet twist 0.4 deg a step": Flaws(twist_rad=0.4 * DEG),
}
WALKS = ("slow", "curve", "aside and back", "in place")
Estimate = Callable[[LeggedLog, LeggedBody], Trajectory]
METHODS: dict[str, Estimate] = {
    "leg odometry": replay.leg_odometry,
    "causal": lambda log, body: replay.estimate(log, body, causal=True),
    "two passes": replay.estimate,
}
HEAD = ["", *(f"{name}: mm, deg, heading at the end" for name in METHODS)]


class Errors(msgspec.Struct, frozen=True):
    """Aligned on the first pose: RMSE of position [mm] and rotation [deg], last heading [deg]."""

    position_mm: float
    rotation_deg: float
    heading_deg: float


def errors(trajectory: Trajectory, fields: dict[str, Any]) -> Errors:
    """Hold a trajectory against the truth of a recording (`gt_base_pos`, `gt_base_rpy`)."""
    places = np.asarray(fields["gt_base_pos"])
    truth = [SE3.from_rpy(*rpy, (0.0, 0.0, 0.0)).rotation() for rpy in fields["gt_base_rpy"]]
    turn = truth[0] @ trajectory.rotations[0].T
    off = (trajectory.positions - trajectory.positions[0]) @ turn.T + places[0] - places
    turns = [
        rotation_vector(turn @ R @ true.T)
        for R, true in zip(trajectory.rotations, truth, strict=True)
    ]
    return Errors(
        1000.0 * float(np.sqrt(np.mean(np.sum(off**2, axis=1)))),
        float(np.sqrt(np.mean(np.sum(np.square(turns), axis=1)))) / DEG,
        abs(float(turns[-1][2])) / DEG,
    )


def main(
    *,
    seeds: Annotated[int, typer.Option(help="sensors drawn for each walk and flaw")] = 2,
    recording: Annotated[
        Path | None, typer.Option(help="a folder with model.urdf and recordings (.npz)")
    ] = None,
) -> None:
    """Measure, and print a table."""
    rows = list[list[str]]()
    if recording is not None:
        chains = urdf_chains.load(recording / "model.urdf")
        for path in sorted(recording.glob("*.npz")):
            rows.append([path.stem, *_cells([_try(path, chains)])])
    with tempfile.TemporaryDirectory() as folder:
        robot = Path(folder) / "robot.urdf"
        robot.write_text(writer.urdf(description.load()), encoding="utf-8")
        chains = urdf_chains.load(robot)
        for ground, (friction, softness_s) in GROUNDS.items():
            truths = [record(walk, friction=friction, softness_s=softness_s) for walk in WALKS]
            for name, flaws in FLAWS.items():
                found = list[dict[str, Errors]]()
                for truth in truths:
                    for seed in range(seeds):
                        path = Path(folder) / "log.npz"
                        np.savez(path, **spoil(truth, flaws, seed=seed))
                        found.append(_try(path, chains))
                rows.append([f"{ground}; {name}", *_cells(found)])
    print(table(HEAD, rows))


def _try(path: Path, chains: urdf_chains.Chains) -> dict[str, Errors]:
    log = legged_log.load(path)
    body = legged_body.find(chains, log)
    with np.load(path) as fields:
        truth = {name: fields[name] for name in ("gt_base_pos", "gt_base_rpy")}
    return {name: errors(method(log, body), truth) for name, method in METHODS.items()}


def _cells(found: list[dict[str, Errors]]) -> list[str]:
    cells: list[str] = []
    for name in METHODS:
        values = np.array([msgspec.structs.astuple(each[name]) for each in found]).mean(axis=0)
        cells.append("{:.1f}, {:.2f}, {:.2f}".format(*values))
    return cells


if __name__ == "__main__":
    typer.run(main)
