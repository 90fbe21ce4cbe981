"""What `humanoid calibrate camera` does."""

from __future__ import annotations

from pathlib import Path

from rich.table import Table

from executive.frontends.new_files import refuse_taken
from executive.frontends.output import say, table_screen, write_json
from executive.frontends.recordings.progress import counted
from robot.errors import ConfigError
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import write_ordinary
from robot.files.pictures import pictures_in
from robot.perception.calibration.board import read_board
from robot.perception.calibration.camera_info import camera_info
from robot.perception.calibration.intrinsics import Camera, calibrate


def calibrate_camera(
    images: Path, *, board: str, window_px: int, out: Path | None, name: str, as_json: bool
) -> int:
    """Calibrate a camera from pictures; print what came of it, and write it down.

    Raises:
        ConfigError: something that was given cannot be used.
    """
    described = read_board(board)
    if out is not None:
        refuse_taken(out)
    paths = pictures_in(images)
    with counted("Looking for the board", len(paths)) as progress:
        camera = calibrate(paths, described, window_px=window_px, progress=progress)
    if out is not None:
        try:
            write_ordinary(out, camera_info(camera, name=name).encode(), anew=True)
        except OSError as error:
            raise ConfigError(f"{out} cannot be written: {error.strerror}") from None
    if as_json:
        write_json(camera)
        return ExitStatus.DONE
    _tell(camera)
    if out is not None:
        say(f"Done: {out}")
    return ExitStatus.DONE


def _tell(camera: Camera) -> None:
    (fx, _, cx), (_, fy, cy), _ = camera.matrix
    sfx, sfy, scx, scy = camera.deviation[:4]
    say(
        f"{len(camera.images)} pictures of {camera.width} x {camera.height}: "
        f"rms {camera.rms:.4f} px, corners in {100 * camera.coverage:.0f} % of the picture"
    )
    say(f"  f  {fx:.2f} ± {sfx:.2f}, {fy:.2f} ± {sfy:.2f} px")
    say(f"  c  {cx:.2f} ± {scx:.2f}, {cy:.2f} ± {scy:.2f} px")
    say(f"  k1 k2 p1 p2 k3  {'  '.join(f'{number:.5f}' for number in camera.distortion)}")
    table = Table(box=None, pad_edge=False)
    for head in ("picture", "corners", "rms [px]", "tilt [deg]", ""):
        table.add_column(head, justify="left" if head in ("picture", "") else "right")
    for image in camera.images:
        note = "outlying" if image.name in camera.outliers else ""
        cells = (str(image.corners), f"{image.rms:.3f}", f"{image.tilt_deg:.0f}", note)
        table.add_row(image.name, *cells)
    table_screen().print(table)
    for one in camera.rejected:
        say(f"left out: {one.name}: {one.reason}")
    for hint in camera.hints:
        say(f"Hint: {hint}")
