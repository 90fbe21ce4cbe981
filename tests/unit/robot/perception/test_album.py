"""Pictures are kept without anybody waiting for a disk."""

from __future__ import annotations

import io
import threading

import numpy as np
from PIL import Image

from robot import shots
from robot.messages import RgbdImage
from robot.perception.album import EVERY_S, Album

WIDE, HIGH = 32, 24


def picture(stamp_s: float, *, red: int = 200) -> RgbdImage:
    pixels = np.zeros((HIGH, WIDE, 3), np.uint8)
    pixels[:, :, 0] = red
    return RgbdImage(
        stamp_s=stamp_s,
        width=WIDE,
        height=HIGH,
        focal_px=(40.0, 41.0),
        centre_px=(15.0, 12.0),
        frame="head_camera",
        colours=pixels.tobytes(),
    )


def kept(path):
    return [shots.decode(line) for line in path.read_bytes().splitlines()]


def test_a_picture_comes_back_as_it_was_seen(tmp_path):
    path = tmp_path / shots.COLOUR_FILE
    with Album(path) as album:
        album.show(picture(2.0))
    (shot,) = kept(path)
    assert shot is not None and (shot.t_s, shot.kind, shot.source) == (2.0, "colour", "emulated")
    assert (shot.focal_px, shot.centre_px) == ((40.0, 41.0), (15.0, 12.0))
    pixels = np.asarray(Image.open(io.BytesIO(shot.data)))
    assert pixels.shape == (HIGH, WIDE, 3)
    np.testing.assert_allclose(pixels[..., 0], 200, atol=6)


def test_of_many_pictures_some_are_kept(tmp_path):
    path = tmp_path / shots.COLOUR_FILE
    with Album(path) as album:
        for tick in range(100):  # ten seconds
            album.show(picture(0.1 * tick))
    assert album.kept + album.passed_over == 10.0 / EVERY_S
    assert len(kept(path)) == album.kept >= 1


def test_a_disk_that_stalls_holds_nobody_up_and_costs_one_picture_of_memory(tmp_path, monkeypatch):
    path, moving = tmp_path / shots.COLOUR_FILE, threading.Event()
    write = Album._write

    def stalled(self, line):
        moving.wait()
        write(self, line)

    monkeypatch.setattr(Album, "_write", stalled)
    with Album(path) as album:
        for tick in range(50):
            album.show(picture(EVERY_S * tick))  # would never return if the disk were waited for
        moving.set()
    assert album.kept <= 3 and album.passed_over == 50 - album.kept
    assert kept(path)[-1].t_s == EVERY_S * 49  # type: ignore[union-attr]


def test_a_file_that_is_long_enough_takes_no_more(tmp_path):
    path = tmp_path / shots.COLOUR_FILE
    with Album(path, most_bytes=100) as album:
        album.show(picture(0.0))
    assert album.kept == 0 and path.stat().st_size == 0


def test_no_place_for_pictures_ends_nothing(tmp_path):
    with Album(tmp_path / "nowhere" / "at_all") as album:
        album.show(picture(0.0))
    assert album.kept == 0 and album.passed_over == 1
