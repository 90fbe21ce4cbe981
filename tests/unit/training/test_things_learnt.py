"""Scenes to learn things from: the same for a seed, labels that fit; and networks that learn."""

from pathlib import Path

import numpy as np
import pytest

from robot.perception.things.inputs import point_W, sight
from sim.things import catalogue
from training.things.frames import DEPTH_STEP_M, Frame, load, save
from training.things.rendering import render
from training.things.scenes import Scene
from training.things.splits import ROOMS, STRANGERS, family, kinds


@pytest.fixture(scope="module")
def frame() -> Frame:
    scene = Scene("train", 3)
    found = next(one for number in range(6) if (one := scene.frame(number)) is not None)
    assert isinstance(found, Frame)
    return found


def test_a_seed_makes_the_same_pictures(frame: Frame) -> None:
    scene = Scene("train", 3)
    again = next(one for number in range(6) if (one := scene.frame(number)) is not None)
    assert again.image == frame.image
    assert np.array_equal(again.who, frame.who)
    other = Scene("train", 4).frame(0)
    assert other is None or other.image != frame.image


def test_labels_are_where_things_are(frame: Frame) -> None:
    seen, truth = sight(frame.image, frame.X_WC), frame.truth
    assert seen is not None
    looked = [k for k in range(len(truth.kinds)) if truth.pixels[k] >= 40]
    assert frame.target in range(len(truth.kinds))
    assert looked
    for thing in looked:
        pixels = (frame.who == thing) & (seen.depth_m > 0.0)
        if pixels.sum() < 20:
            continue
        rows, columns = np.nonzero(pixels)
        middle = len(rows) // 2
        v, u = int(rows[middle]), int(columns[middle])
        p_W = point_W(seen, u, v, float(seen.depth_m[v, u]))
        reach_m = float(np.linalg.norm(truth.size_m[thing])) / 2 + 0.06  # handles, noise
        assert np.linalg.norm(p_W - truth.p_W[thing]) < reach_m


def test_frames_come_back_from_their_file(frame: Frame, tmp_path: Path) -> None:
    save([frame, frame], tmp_path / "scene.npz")
    first, second = load(tmp_path / "scene.npz")
    assert first.image.colours == second.image.colours == frame.image.colours
    was, now = frame.image.depth(), first.image.depth()
    assert was is not None
    assert now is not None
    assert np.abs(was - now).max() < DEPTH_STEP_M
    assert first.truth.kinds == frame.truth.kinds
    assert np.array_equal(first.truth.pixels, frame.truth.pixels)
    assert first.X_WC.matrix() == pytest.approx(frame.X_WC.matrix(), abs=1e-9)
    assert first.target == frame.target


def test_what_is_rendered_is_not_rendered_again(tmp_path: Path) -> None:
    (made,) = render(tmp_path, "train", 3, 1)
    was = made.stat().st_mtime_ns
    assert render(tmp_path, "train", 3, 1) == [made]
    assert made.stat().st_mtime_ns == was


def test_what_is_judged_was_never_learnt() -> None:
    assert set(STRANGERS) <= set(catalogue.kinds())
    assert not set(STRANGERS) & set(kinds("train"))
    assert not set(STRANGERS) & set(kinds("choose"))
    assert set(STRANGERS) < set(kinds("judge"))
    train, judge = ROOMS["train"], ROOMS["judge"]
    assert train.hues[1] < judge.hues[0]
    assert not set(train.floors) & set(judge.floors)
    assert train.variants[1] <= ROOMS["choose"].variants[0]
    assert ROOMS["choose"].variants[1] <= judge.variants[0]
    assert len({family(kind) for kind in STRANGERS}) >= 6


@pytest.mark.rest
def test_networks_learn_and_their_files_answer_as_they_do(frame: Frame, tmp_path: Path) -> None:
    jax = pytest.importorskip("jax", reason="the extra `train` is not installed")
    pytest.importorskip("onnx", reason="the extra `dev` is not installed")
    pytest.importorskip("onnxruntime", reason="the extra `vision` is not installed")
    from robot.perception.things.crops import CHANNELS, NUMBERS, SIDE_PX
    from robot.perception.things.inputs import CHANNELS as SEEN
    from robot.perception.things.inputs import tensor
    from robot.perception.things.networks import Finder
    from training.things import export, finding, graphs, naming, networks

    scene = tmp_path / "000001.npz"
    save([frame], scene)
    made = list(finding.learn(finding.gathered([scene, scene]), steps=60, batch=8, seed=0))
    losses = [loss for loss, _ in made]
    assert np.mean(losses[-5:]) < 0.8 * np.mean(losses[:5])
    learnt = jax.tree.map(np.asarray, made[-1][1])
    path = tmp_path / "finder.onnx"
    export.write(path, finding.GRAPH, learnt, {graphs.IMAGE: ("rows", "columns", SEEN)}, {})
    seen = sight(frame.image, frame.X_WC)
    assert seen is not None
    given = tensor(seen)
    wanted, _ = networks.run(
        finding.GRAPH, learnt.weights, learnt.even, {graphs.IMAGE: given[None]}, learns=False
    )
    said = Finder(path)(given)
    assert said == pytest.approx(np.asarray(wanted)[0].transpose(2, 0, 1), abs=2e-3)

    lessons = naming.taught([scene] * 3, path, seed=0)
    assert lessons.planes.shape[1:] == (SIDE_PX, SIDE_PX, CHANNELS)
    assert lessons.numbers.shape[1:] == (NUMBERS,)
    told = [loss for loss, _ in naming.learn(lessons, steps=60, batch=4, seed=0)]
    assert np.mean(told[-10:]) < 0.8 * np.mean(told[:10])
