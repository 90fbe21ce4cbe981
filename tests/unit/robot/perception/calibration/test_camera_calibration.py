"""A camera that is known is found again in pictures that were rendered through it."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from PIL import Image

from robot.errors import ConfigError
from robot.files.pictures import pictures_in
from robot.perception.calibration.board import read_board
from robot.perception.calibration.camera_info import camera_info
from robot.perception.calibration.intrinsics import Camera, calibrate

pytest.importorskip("cv2")
from tests.fakes.boards import KnownCamera, views
from tests.fakes.recordings import recordings

CHESSBOARD = "chessboard:8x5:0.03"
LEGACY = "charuco:9x6:0.035:0.026:DICT_4X4_100:legacy"
"""Six rows: the two patterns differ where the number of rows is even."""
KNOWN = KnownCamera()


def pictures(folder: Path, board: str, count: int = 8) -> list[Path]:
    paths = [folder / f"{number:02}.png" for number in range(count)]
    images = views(read_board(board), KNOWN, count=count, seed=3)
    for path, image in zip(paths, images, strict=True):
        Image.fromarray(image).save(path)
    return paths


@pytest.fixture(scope="module")
def of_chessboard(tmp_path_factory) -> list[Path]:
    return pictures(tmp_path_factory.mktemp("chessboard"), CHESSBOARD)


@pytest.fixture(scope="module")
def of_legacy(tmp_path_factory) -> list[Path]:
    return pictures(tmp_path_factory.mktemp("legacy"), LEGACY)


def check(camera: Camera) -> None:
    """Focal lengths and centre within a pixel, and the distortion where it bends the picture."""
    assert camera.rms < 0.15
    assert np.abs(np.array(camera.matrix) - np.array(KNOWN.matrix)).max() < 1.0
    # At the corner of the picture: how far a point is moved, by what is known and by what is found.
    x, y = 0.5, 0.38
    r2 = x**2 + y**2
    known, found = (
        560.0 * (k1 * r2 + k2 * r2**2 + k3 * r2**3)
        for k1, k2, _, _, k3 in (KNOWN.distortion, camera.distortion)
    )
    assert found == pytest.approx(known, abs=1.0)
    assert camera.distortion[2:4] == pytest.approx(KNOWN.distortion[2:4], abs=5e-4)


def test_a_chessboard(of_chessboard):
    camera = calibrate(of_chessboard, read_board(CHESSBOARD))
    check(camera)
    assert 0.4 < camera.coverage <= 1.0
    assert {image.corners for image in camera.images} == {40}


def test_both_patterns_of_charuco(of_legacy, tmp_path):
    check(calibrate(of_legacy, read_board(LEGACY)))
    new = LEGACY.removesuffix(":legacy")
    check(calibrate(pictures(tmp_path, new), read_board(new)))


def test_the_other_pattern_is_named_as_the_cure(of_legacy):
    with pytest.raises(ConfigError, match="add :legacy to --board"):
        calibrate(of_legacy, read_board(LEGACY.removesuffix(":legacy")))


def test_a_picture_that_does_not_fit_is_named(of_chessboard, tmp_path):
    bent = tmp_path / "bent.png"
    with Image.open(of_chessboard[0]) as image:
        # As if the board were bent: what is seen below is moved to the side, more and more.
        moved = [np.roll(row, number // 60) for number, row in enumerate(np.array(image))]
    Image.fromarray(np.array(moved)).save(bent)
    camera = calibrate([*of_chessboard[1:], bent], read_board(CHESSBOARD))
    assert camera.outliers == ("bent.png",)
    assert any("bent.png" in hint for hint in camera.hints)


def test_pictures_that_cannot_be_used_are_left_out_and_named(of_chessboard, tmp_path):
    broken, empty = tmp_path / "broken.png", tmp_path / "empty.png"
    broken.write_bytes(of_chessboard[0].read_bytes()[:2000])
    Image.new("L", (640, 480), 128).save(empty)
    camera = calibrate([broken, empty, *of_chessboard], read_board(CHESSBOARD))
    reasons = {one.name: one.reason for one in camera.rejected}
    assert set(reasons) == {"broken.png", "empty.png"}
    assert "broken" in reasons["broken.png"]
    assert "not seen" in reasons["empty.png"]


def test_two_sizes_are_two_cameras(of_chessboard, tmp_path):
    small = tmp_path / "small.png"
    Image.new("L", (320, 240)).save(small)
    with pytest.raises(ConfigError, match="320x240"):
        calibrate([*of_chessboard, small], read_board(CHESSBOARD))


def test_too_few_views_are_refused(of_chessboard):
    with pytest.raises(ConfigError, match="in 2 of 2 pictures"):
        calibrate(of_chessboard[:2], read_board(CHESSBOARD))


def test_camera_info_is_what_ros_reads(of_chessboard):
    camera = calibrate(of_chessboard, read_board(CHESSBOARD))
    info = yaml.safe_load(camera_info(camera, name="head"))
    assert (info["image_width"], info["image_height"]) == (640, 480)
    assert info["camera_name"] == "head"
    assert info["distortion_model"] == "plumb_bob"
    shapes = {
        "camera_matrix": (3, 3), "distortion_coefficients": (1, 5),
        "rectification_matrix": (3, 3), "projection_matrix": (3, 4),
    }  # fmt: skip
    for name, (rows, columns) in shapes.items():
        assert (info[name]["rows"], info[name]["cols"]) == (rows, columns)
        assert len(info[name]["data"]) == rows * columns
    assert info["camera_matrix"]["data"][:3] == pytest.approx(camera.matrix[0])
    assert info["projection_matrix"]["data"][3] == 0.0


def test_recordings_of_others():
    """The published figures of OpenCV's own pictures, with the settings of its own program."""
    folder = recordings("calibration", "opencv_stereo")
    board = read_board("chessboard:9x6:0.025")
    camera = calibrate(pictures_in(folder / "left*.jpg"), board)
    assert camera.rms <= 0.40
    assert camera.matrix[0][0] == pytest.approx(535.92, abs=0.5)
    assert camera.matrix[1][1] == pytest.approx(535.92, abs=0.5)
    assert "left02.jpg" in camera.outliers
    closer = calibrate(pictures_in(folder / "left*.jpg"), board, window_px=5)
    assert closer.rms < 0.25
    assert closer.outliers == ()
