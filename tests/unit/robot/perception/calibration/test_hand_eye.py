"""Where a camera sits is found again: from exact motions, from pictures, not from too little."""

import json

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.errors import ConfigError
from robot.perception.calibration.board import read_board
from robot.perception.calibration.camera_info import read_camera_info
from robot.perception.calibration.hand_eye import closed_form, inverse
from robot.perception.calibration.poses import read_poses
from robot.se3 import SE3

pytest.importorskip("cv2")
import cv2

from tests.fakes.boards import KnownCamera, board_poses, rendered

BOARD = "charuco:7x5:0.04:0.03:DICT_4X4_50"
X_GC = SE3.from_rpy(0.3, -0.2, 1.4, (0.03, -0.05, 0.09)).matrix()
X_BT = SE3.from_rpy(3.0, 0.1, -0.6, (0.5, 0.2, 0.02)).matrix()
KNOWN = KnownCamera()
COUNT = 8


def hands(seen: list[np.ndarray]) -> list[np.ndarray]:
    """Where the hand was when the board was seen there."""
    return [X_BT @ inverse(X_CT) @ inverse(X_GC) for X_CT in seen]


def off(found: np.ndarray, wanted: np.ndarray) -> tuple[float, float]:
    """Distance [m] and turn [rad] between two poses."""
    error = inverse(wanted) @ found
    turn = np.arccos(np.clip((np.trace(error[:3, :3]) - 1.0) / 2.0, -1.0, 1.0))
    return float(np.linalg.norm(error[:3, 3])), float(turn)


def test_exact_motions_give_the_exact_camera():
    seen = board_poses(read_board(BOARD), count=6, seed=1)
    assert closed_form(hands(seen), seen) == pytest.approx(X_GC, abs=1e-9)


def test_it_agrees_with_opencv_where_the_hand_is_off():
    random = np.random.default_rng(2)
    seen = board_poses(read_board(BOARD), count=12, seed=2)
    noisy = [
        pose @ SE3.from_rpy(*random.normal(0.0, 2e-3, 3), tuple(random.normal(0, 1e-3, 3))).matrix()
        for pose in hands(seen)
    ]
    turn, place = cv2.calibrateHandEye(
        [pose[:3, :3] for pose in noisy], [pose[:3, 3] for pose in noisy],
        [pose[:3, :3] for pose in seen], [pose[:3, 3] for pose in seen],
        method=cv2.CALIB_HAND_EYE_PARK,
    )  # fmt: skip
    theirs = np.eye(4)
    theirs[:3, :3], theirs[:3, 3] = turn, place.ravel()
    ours = closed_form(noisy, seen)
    assert off(ours, theirs)[0] < 2e-3
    assert off(ours, theirs)[1] < 2e-3
    assert off(ours, X_GC)[0] < 4e-3


def test_turns_about_one_axis_are_too_little():
    seen = [
        SE3.from_rpy(0.0, 0.0, 0.3 * number, (0.1 * number, 0.0, 0.5)).matrix()
        for number in range(6)
    ]
    with pytest.raises(ConfigError, match="about one axis"):
        closed_form(hands(seen), seen)
    with pytest.raises(ConfigError, match="about one axis"):
        closed_form(hands(seen[:1] * 4), seen[:1] * 4)


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """Pictures, and a table of where the hand was at each; one of them in the dark."""
    folder = tmp_path_factory.mktemp("scene")
    seen = board_poses(read_board(BOARD), count=COUNT, seed=4)
    rows = ["image,x,y,z,qw,qx,qy,qz"]
    images = rendered(read_board(BOARD), KNOWN, seen, seed=4)
    for number, (image, pose) in enumerate(zip(images, hands(seen), strict=True)):
        Image.fromarray(image).save(folder / f"{number}.png")
        as_se3 = SE3.from_rotation(pose[:3, :3], pose[:3, 3])
        rows.append(",".join([f"{number}.png", *map(repr, (*as_se3.p, *as_se3.quat_wxyz))]))
    Image.new("L", (KNOWN.width, KNOWN.height)).save(folder / "dark.png")
    (folder / "poses.csv").write_text("\n".join(rows) + "\n")
    (folder / "camera.yaml").write_text(
        "camera_matrix: {rows: 3, cols: 3, data: "
        f"{[float(number) for row in KNOWN.matrix for number in row]}}}\n"
        f"distortion_coefficients: {{rows: 1, cols: 5, data: {list(KNOWN.distortion)}}}\n"
    )
    return folder


def calibrated(scene, *options) -> dict:
    words = [
        "calibrate", "hand-eye", "--json", "--images", scene, "--board", BOARD,
        "--poses", scene / "poses.csv", *options,
    ]  # fmt: skip
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.exception
    return json.loads(result.stdout)


def test_the_camera_is_found_in_pictures(scene):
    known = ("--camera", scene / "camera.yaml")
    for options, most_m, most_rad in (((), 1e-3, 5e-3), (known, 3e-4, 5e-4)):
        found = calibrated(scene, *options)
        distance_m, turn_rad = off(np.array(found["camera"]), X_GC)
        assert distance_m < most_m
        assert turn_rad < most_rad
        assert off(np.array(found["board"]), X_BT)[0] < most_m
        assert found["rms"] < 0.2
        assert [image["name"] for image in found["images"]] == [f"{n}.png" for n in range(COUNT)]
    assert found["position"] == pytest.approx(X_GC[:3, 3], abs=1e-3)


def test_a_camera_that_stands_still(scene, tmp_path):
    """The same pictures, told as those of a board in the hand: the base is where the hand was."""
    rows = [row.split(",") for row in (scene / "poses.csv").read_text().splitlines()[1:]]
    inverted = []
    for name, *numbers in rows:
        x, y, z, *quat = map(float, numbers)
        pose = SE3((x, y, z), (quat[0], quat[1], quat[2], quat[3])).inverse()
        inverted.append(",".join([name, *map(repr, (*pose.p, *pose.quat_wxyz))]))
    table = tmp_path / "poses.csv"
    table.write_text("\n".join(["image,x,y,z,qw,qx,qy,qz", *inverted]))
    camera = ("--camera", scene / "camera.yaml", "--eye-to-hand")
    found = calibrated(scene, "--poses", table, *camera)
    assert found["frame"] == "base"
    assert off(np.array(found["camera"]), X_GC)[0] < 1e-3


def test_poses_come_in_several_tables(tmp_path):
    names = ["a.png", "b.png"]
    first, second = np.eye(4), SE3.from_xy_yaw(0.1, 0.2, 0.5, z_m=0.3).matrix()
    half = 0.25
    tables = {
        "named": "image,x,y,z,qw,qx,qy,qz\nb.png, 0.1,0.2,0.3, "
        f"{np.cos(half)},0,0,{np.sin(half)}\na.png,0,0,0,1,0,0,0\n",
        "seven": f"# hand\n0 0 0 1 0 0 0\n0.1 0.2 0.3 {np.cos(half)} 0 0 {np.sin(half)}\n",
        "sixteen": "\n".join(",".join(map(str, pose.ravel())) for pose in (first, second)),
        "twelve": "\n".join(" ".join(map(str, pose[:3].ravel())) for pose in (first, second)),
        "blocks": "\n\n".join(
            "\n".join(" ".join(map(str, row)) for row in pose) for pose in (first, second)
        ),
    }
    for name, text in tables.items():
        path = tmp_path / name
        path.write_text(text)
        poses = read_poses(path, names)
        assert poses["a.png"] == pytest.approx(first), name
        assert poses["b.png"] == pytest.approx(second), name


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "no pose"),
        ("0 0 0 1 0 0 0\n", "1 rows, and there are 2 pictures"),
        ("0 0 0 1 0 0 0\n0 0 x 1 0 0 0\n", "no number"),
        ("0 0 0 1 0 0 0\n0 0 nan 1 0 0 0\n", "not finite"),
        ("0 0 0 1 0 0 0\n0 0 0 2 0 0 0\n", "length 2"),
        ("0 0 0 1 0 0 0\n0 0 500 1 0 0 0\n", "millimetres"),
        ("0 0 0 1 0 0 0\n0 0 0 1 0 0\n", "6 numbers"),
        ("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 -1 0\n", "no rotation"),
        ("image,x,y,z,qw,qx,qy,qz\nc.png,0,0,0,1,0,0,0\n", "names none of the pictures"),
        ("image,x,y,z,qw,qx,qy,qz\na.png,0,0,0,1,0,0,0\na.png,0,0,0,1,0,0,0\n", "two poses"),
    ],
)
def test_tables_that_cannot_be_meant_are_refused(text, says, tmp_path):
    path = tmp_path / "poses.txt"
    path.write_text(text)
    with pytest.raises(ConfigError, match=says):
        read_poses(path, ["a.png", "b.png"])


@pytest.mark.parametrize(
    "text",
    [
        "", "camera_matrix: 3\n", "camera_matrix: {rows: 3, cols: 3, data: [1, 2]}\n"
        "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n",
        "camera_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, .nan]}\n"
        "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n",
        "camera_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
        "distortion_coefficients: {rows: 1, cols: 4, data: [0, 0, 0, 0]}\n"
        "distortion_model: equidistant\n",
    ],
)  # fmt: skip
def test_a_file_that_is_no_camera_is_refused(text, tmp_path):
    path = tmp_path / "camera.yaml"
    path.write_text(text)
    with pytest.raises(ConfigError, match=r"camera\.yaml"):
        read_camera_info(path)
