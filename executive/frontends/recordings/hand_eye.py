"""What `humanoid calibrate hand-eye` does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from rich.table import Table

from executive.frontends.output import say, table_screen, write_json
from executive.frontends.recordings.progress import counted
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.pictures import pictures_in
from robot.perception.calibration.board import read_board
from robot.perception.calibration.camera_info import read_camera_info
from robot.perception.calibration.hand_eye import Mounting, inverse, mounting
from robot.perception.calibration.intrinsics import explain
from robot.perception.calibration.poses import read_poses
from robot.perception.calibration.views import find_views
from robot.se3 import SE3


def calibrate_hand_eye(
    images: Path,
    *,
    poses: Path,
    board: str,
    camera: Path | None,
    window_px: int,
    eye_to_hand: bool,
    as_json: bool,
) -> int:
    """Find where a camera sits; print it.

    Raises:
        ConfigError: something that was given cannot be used.
    """
    described = read_board(board)
    paths = pictures_in(images)
    X_BG = read_poses(poses, [path.name for path in paths])
    known = read_camera_info(camera) if camera is not None else None
    with counted("Looking for the board", len(paths)) as progress:
        looked = find_views(paths, described, window_px=window_px, progress=progress)
    if known is None:
        found = explain(looked, described, window_px=window_px)
        known = np.array(found.matrix), np.array(found.distortion)
    views = [view for view in looked.views if view.name in X_BG]
    if not views:
        raise ConfigError([Problem("no picture with a pose shows the board", str(poses))])
    carried = [inverse(X_BG[view.name]) if eye_to_hand else X_BG[view.name] for view in views]
    placed = mounting(views, carried, *known)
    if as_json:
        write_json(_record(placed, eye_to_hand=eye_to_hand))
    else:
        _tell(placed, eye_to_hand=eye_to_hand)
    return ExitStatus.DONE


def _record(placed: Mounting, *, eye_to_hand: bool) -> dict[str, object]:
    pose = _se3(placed)
    return {
        "frame": "base" if eye_to_hand else "hand",
        "position": list(pose.p),
        "quat_wxyz": list(pose.quat_wxyz),
        "camera": placed.camera,
        "board": placed.board,
        "rms": placed.rms,
        "images": placed.images,
    }


def _se3(placed: Mounting) -> SE3:
    matrix = np.array(placed.camera)
    return SE3.from_rotation(matrix[:3, :3], matrix[:3, 3])


def _tell(placed: Mounting, *, eye_to_hand: bool) -> None:
    pose = _se3(placed)
    say(f"camera in the frame of the {'base' if eye_to_hand else 'hand'}: rms {placed.rms:.3f} px")
    say(f"  position   {', '.join(f'{number:.5f}' for number in pose.p)} m")
    say(f"  quat_wxyz  {', '.join(f'{number:.6f}' for number in pose.quat_wxyz)}")
    table = Table(box=None, pad_edge=False)
    for head in ("picture", "rms [px]", "off [mm]", "off [deg]"):
        table.add_column(head, justify="left" if head == "picture" else "right")
    for image in placed.images:
        off = (f"{image.position_mm:.2f}", f"{image.rotation_deg:.3f}")
        table.add_row(image.name, f"{image.rms:.3f}", *off)
    table_screen().print(table)
