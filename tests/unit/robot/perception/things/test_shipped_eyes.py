"""The networks that are shipped, on pictures of rooms that they never saw."""

import msgspec
import numpy as np
import pytest

from training.things.frames import Frame
from training.things.judging import Look, counts, looks, within
from training.things.scenes import Scene

pytest.importorskip("onnxruntime", reason="the extra `vision` is not installed")

from robot.perception.things.eyes import Eyes
from robot.perception.things.networks import FINDER, NAMER

SEEDS = range(900_000, 900_006)


@pytest.fixture(scope="module")
def eyes() -> Eyes:
    return Eyes()


@pytest.fixture(scope="module")
def frames() -> list[Frame]:
    scenes = [Scene("judge", seed) for seed in SEEDS]
    return [one for scene in scenes for k in range(3) if (one := scene.frame(k)) is not None]


@pytest.fixture(scope="module")
def looked(eyes: Eyes, frames: list[Frame]) -> list[Look]:
    return [one for frame in frames for one in looks(frame, eyes.look(frame.image, frame.X_WC))]


def test_most_things_are_found_and_placed(looked: list[Look]) -> None:
    near = [one for one in within(looked, 1.5, 200) if one.kind != "nothing"]
    assert len(near) >= 10
    found = [one for one in near if one.seen is not None]
    assert len(found) >= 0.6 * len(near)
    errors_m = [float(np.linalg.norm(one.error_m)) for one in found if one.error_m is not None]
    assert np.median(errors_m) < 0.02


def test_a_name_is_hardly_ever_wrong(eyes: Eyes, looked: list[Look]) -> None:
    some = within(looked, 2.5)
    at = counts(some, eyes, eyes.namer.sure)
    assert at.right > 0.1
    assert at.wrong <= 0.02


def test_looks_that_agree_have_to_be_surer_than_one(eyes: Eyes) -> None:
    """A coffee tin, which it never learnt, was taken for a tea box in eight looks of eight."""
    assert eyes.namer.voted.kind > eyes.namer.sure.kind
    assert eyes.namer.voted.family >= eyes.namer.voted.kind


def test_a_picture_twice_is_seen_twice_the_same(eyes: Eyes, frames: list[Frame]) -> None:
    first, second = (eyes.look(frames[0].image, frames[0].X_WC) for _ in range(2))
    assert [one.words for one in first] == [one.words for one in second]
    assert [one.p_W.tolist() for one in first] == [one.p_W.tolist() for one in second]


def test_without_depth_nothing_is_seen(eyes: Eyes, frames: list[Frame]) -> None:
    frame = frames[0]
    none = bytes(len(frame.image.depth_m))
    assert eyes.look(msgspec.structs.replace(frame.image, depth_m=none), frame.X_WC) == []
    assert eyes.look(msgspec.structs.replace(frame.image, depth_m=b""), frame.X_WC) == []


def test_a_black_picture_has_few_things_and_no_names(eyes: Eyes, frames: list[Frame]) -> None:
    frame = frames[0]
    black = msgspec.structs.replace(frame.image, colours=bytes(len(frame.image.colours)))
    assert not any(one.name.kind for one in eyes.look(black, frame.X_WC))


def test_pictures_of_odd_sizes_are_looked_at(eyes: Eyes, frames: list[Frame]) -> None:
    frame = frames[0]
    colours, depth_m = frame.image.picture()[:231, :313], frame.image.depth()
    assert depth_m is not None
    cut = msgspec.structs.replace(
        frame.image, width=313, height=231, colours=colours.tobytes(),
        depth_m=depth_m[:231, :313].tobytes(),
    )  # fmt: skip
    for one in eyes.look(cut, frame.X_WC):
        assert one.pixels.shape == (231, 313)


def test_networks_are_small() -> None:
    assert FINDER.stat().st_size + NAMER.stat().st_size < 5_000_000
