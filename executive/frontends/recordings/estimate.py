"""What `humanoid sensors estimate` does."""

from __future__ import annotations

import io
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from executive.frontends.new_files import refuse_inputs
from executive.frontends.output import Screen, say, write_json
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import write_ordinary
from robot.fusion.state_estimator import legged_body, legged_log, replay, urdf_chains
from robot.fusion.state_estimator.legged_body import LeggedBody
from robot.fusion.state_estimator.legged_log import LeggedLog
from robot.fusion.state_estimator.replay import Trajectory
from robot.se3 import SE3


def estimate(
    log_file: Path,
    urdf: Path,
    output: Path,
    *,
    causal: bool,
    feet: str,
    imu: str,
    as_json: bool,
) -> int:
    """Estimate the base's poses, and write them down.

    Raises:
        ConfigError: a file cannot be used or written, or they do not fit one another.
    """
    refuse_inputs([output], [log_file, urdf])
    soles = _pair(feet)
    log = legged_log.load(log_file)
    chains = urdf_chains.load(urdf)
    body = legged_body.find(chains, log, soles=soles, imu=imu or None)
    with _bar("Estimating", shown=not as_json) as progress:
        trajectory = replay.estimate(log, body, causal=causal, progress=progress)
    if not trajectory.finite:
        cure = "does the recording come from this robot? --feet and --imu name its links"
        raise ConfigError([Problem("no motion fits it", str(log_file), suggestion=cure)])
    try:
        write_ordinary(output, rows(log, trajectory).encode())
    except OSError as error:
        raise ConfigError(f"{output} cannot be written: {error.strerror}") from None
    told = _record(log, body, trajectory)
    if as_json:
        write_json({**told, "out": str(output)})
    else:
        for name, value in told.items():
            say(f"{name.replace('_', ' ')}: {value}")
        say(f"Done: {output}")
    return ExitStatus.DONE


def rows(log: LeggedLog, trajectory: Trajectory) -> str:
    """A line a sample: t [s], x, y, z [m], qw, qx, qy, qz."""
    quaternions = [SE3.from_rotation(R, (0.0, 0.0, 0.0)).quat_wxyz for R in trajectory.rotations]
    text = io.StringIO()
    np.savetxt(text, np.column_stack([log.t, trajectory.positions, quaternions]), fmt="%.9f")
    return text.getvalue()


def _record(log: LeggedLog, body: LeggedBody, trajectory: Trajectory) -> dict[str, object]:
    """What was found, for people and programs."""
    gyro = np.degrees(trajectory.gyro_bias_rad_s).round(4).tolist()
    return {
        "samples": len(log),
        "lasted_s": round(float(log.t[-1] - log.t[0]), 3),
        "soles": list(body.soles),
        "imu": body.imu,
        "gyro_bias_deg_s": gyro,
        "accel_bias_m_s2": trajectory.accel_bias_m_s2.round(4).tolist(),
        "slips": list(trajectory.slips),
        "samples_with_gaps": log.filled,
        "stamps_in_bursts": log.bursts,
    }


def _pair(feet: str) -> tuple[str, str] | None:
    """Two links out of LEFT,RIGHT."""
    if not feet:
        return None
    left, comma, right = feet.partition(",")
    if not comma or not left.strip() or not right.strip() or "," in right:
        cure = "--feet left_sole,right_sole"
        raise ConfigError([Problem(f"--feet {feet!r} are not two links", suggestion=cure)])
    return left.strip(), right.strip()


@contextmanager
def _bar(what: str, *, shown: bool) -> Generator[Callable[[float], None]]:
    """A bar on standard error, where that is a terminal; it is told the share that is done."""
    screen = Screen(err=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    hidden = not (shown and screen.is_terminal)
    with Progress(*columns, console=screen, transient=True, disable=hidden) as bar:
        task = bar.add_task(what, total=1.0)
        yield lambda share: bar.update(task, completed=share)
