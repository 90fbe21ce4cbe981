"""A crop at another size is what a camera would see of the thing so much larger and further."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robot.perception.things.crops import crop
from robot.perception.things.inputs import Sight
from robot.se3 import SE3

jax = pytest.importorskip("jax")

from training.things import misfits, naming  # noqa: E402

ROWS, COLUMNS, FOCAL_PX = 60, 80, 70.0
PITCH = 0.4


def seen_at(times: float) -> tuple[Sight, np.ndarray]:
    """A bowl before a wall, all lengths so many times as long, from 1.2 m above the floor."""
    rows, columns = np.mgrid[:ROWS, :COLUMNS]
    off = ((rows - 30) / 9.0) ** 2 + ((columns - 40) / 12.0) ** 2
    pixels = off < 1.0
    depth_m = np.where(pixels, 1.0 + 0.05 * off, 1.2) * times
    flat = SE3.from_rpy(0.0, PITCH, 0.3, (0.0, 0.0, 0.0)).rotation()
    R_WC = flat @ np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    X_WC = SE3.from_rotation(R_WC, (0.1, 0.2, 1.2))
    x, y = (columns - 40.0) / FOCAL_PX * depth_m, (rows - 30.0) / FOCAL_PX * depth_m
    height_m = (np.stack([x, y, depth_m], axis=-1) @ R_WC.T)[..., 2] + 1.2
    colours = np.full((ROWS, COLUMNS, 3), 90, dtype=np.uint8)
    seen = Sight(colours, depth_m.astype(np.float32), height_m.astype(np.float32), X_WC,
                 FOCAL_PX, (40.0, 30.0))  # fmt: skip
    return seen, pixels


@pytest.mark.parametrize("log", [-0.3, 0.2, 0.45])
def test_resized_crop_is_that_of_the_thing_so_much_larger_and_further_away(log: float) -> None:
    small, large = (crop(*seen_at(math.exp(one)), 0.9) for one in (0.0, log))
    assert small is not None and large is not None
    batch = {"planes": small.planes[None], "numbers": small.numbers[None],
             "rest": np.ones((1, 8), dtype=np.float32)}  # fmt: skip
    made = misfits.resized(
        {name: jax.numpy.asarray(value) for name, value in batch.items()}, jax.numpy.array([log])
    )
    assert np.asarray(made["numbers"])[0] == pytest.approx(large.numbers, abs=0.02)
    assert np.abs(np.asarray(made["planes"])[0] - large.planes).max() < 0.02
    assert np.asarray(made["rest"])[0] == pytest.approx([math.exp(log)] * 6 + [1.0, 1.0])


def test_what_is_as_large_as_another_kind_then_is_left_out() -> None:
    fits = misfits.fitting(naming.CLASSES)
    logs = np.linspace(misfits.LEAST, misfits.MOST, misfits.STEPS)
    column = misfits.STEPS + int(np.argmin(np.abs(logs - 0.17)))
    assert not fits[naming.CLASSES.index("espresso_cup"), column]  # a tea cup
    assert fits[naming.CLASSES.index("bean_can"), column]  # a coffee tin, which is never learnt
    assert fits[naming.CLASSES.index("banana")].all()
    assert not fits[[naming.CLASSES.index(one) for one in (naming.UNKNOWN, naming.NOTHING)]].any()


def test_a_share_of_known_things_is_shown_so_and_nothing_else() -> None:
    fits = jax.numpy.asarray(misfits.fitting(naming.CLASSES))
    banana, unknown = naming.CLASSES.index("banana"), naming.CLASSES.index(naming.UNKNOWN)
    names = jax.numpy.array([banana] * 2000 + [unknown] * 100)
    log = np.asarray(misfits.drawn(fits, names, 0.25, jax.random.key(0)))
    assert np.mean(log[:2000] != 0.0) == pytest.approx(0.25, abs=0.05)
    assert not log[2000:].any()
    assert (np.abs(log[log != 0.0]) >= misfits.LEAST - 1e-6).all()
