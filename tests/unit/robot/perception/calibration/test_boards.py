"""Boards are described in a few words, and whatever describes none is refused with an example."""

import pytest

from robot.errors import ConfigError
from robot.perception.calibration.board import Charuco, Chessboard, read_board


def test_a_chessboard_counts_inner_corners():
    board = read_board("chessboard:7x4:0.03")
    assert board == Chessboard(columns=7, rows=4, square_m=0.03)
    assert board.corners_m.shape == (28, 3)
    assert board.corners_m[7] == pytest.approx([0.0, 0.03, 0.0])


def test_a_charuco_board_may_be_legacy():
    board = read_board("charuco:8x6:0.04:0.03:DICT_4X4_50:legacy")
    assert board == Charuco(
        columns=8, rows=6, square_m=0.04, marker_m=0.03, dictionary="DICT_4X4_50", legacy=True
    )
    assert not read_board("charuco:8x6:0.04:0.03:DICT_4X4_50").legacy  # type: ignore[union-attr]


@pytest.mark.parametrize(
    "text",
    [
        "", "chessboard", "chessboard:9x6", "chessboard:9x6:nan", "chessboard:9x6:-1",
        "chessboard:9x6:1e9", "chessboard:2x6:0.03", "chessboard:999x6:0.03", "chessboard:9*6:0.03",
        "charuco:8x6:0.03:0.04:DICT_4X4_50", "charuco:8x6:0.04:0.03:__class__",
        "charuco:8x6:0.04:0.03:DICT_4X4_50:new", "apriltag:3x3:0.1", "chessboard:9x6:0.03:0.02",
    ],
)  # fmt: skip
def test_what_describes_no_board_is_refused(text):
    with pytest.raises(ConfigError, match=r"chessboard:9x6:0\.025"):
        read_board(text)
