"""Learns the finder: for each second pixel, whether it is of a thing and where its middle is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from robot.perception.things.inputs import sight, tensor
from robot.perception.things.instances import HALF, REACH_PX
from training.things import graphs, networks
from training.things.frames import Frame, load
from training.things.networks import Learnt

GRAPH = graphs.finder()
MOST_RATE = 4e-3
CUT = (160, 192)
"""Rows and columns of a picture that are learnt from at a time."""
LEAST_PX = 12
"""Visible less, a thing need not be found, and may be."""
SCENES = 2
"""Of a batch."""


def answers(frame: Frame) -> np.ndarray:
    """What the finder should say of a picture, shape (rows, columns, 4).

    Whether a thing is there, the offset to the middle of what is visible of it, and how much the
    answer counts.
    """
    shape = frame.who.shape[0] // HALF, frame.who.shape[1] // HALF
    blocks = frame.who.reshape(shape[0], HALF, shape[1], HALF).max(axis=(1, 3))
    wanted = np.zeros((*shape, 4), dtype=np.float32)
    wanted[..., 3] = 1.0
    for number in np.unique(blocks[blocks >= 0]).tolist():
        here = blocks == number
        if frame.truth.pixels[number] < LEAST_PX:
            wanted[here, 3] = 0.0
            continue
        v, u = np.nonzero(here)
        wanted[v, u, 0] = 1.0
        wanted[v, u, 1] = (u.mean() - u) / REACH_PX
        wanted[v, u, 2] = (v.mean() - v) / REACH_PX
        wanted[v, u, 3] = 1.0 + 12.0 / np.sqrt(len(u))  # small ones count more than their pixels
    return wanted


def loss(weights: Any, even: Any, batch: Any) -> Any:
    """Of odds (binary cross-entropy), and of offsets where a thing is."""
    said, even = networks.run(GRAPH, weights, even, {graphs.IMAGE: batch["image"]}, learns=True)
    wanted, counts = batch["wanted"][..., :3], batch["wanted"][..., 3]
    there = wanted[..., 0]
    odds = counts * (jax.nn.softplus(said[..., 0]) - there * said[..., 0])
    off = jnp.abs(said[..., 1:] - wanted[..., 1:]).sum(axis=-1) * there * counts
    total = jnp.maximum((there * counts).sum(), 100.0)
    return (odds.sum() + 2.0 * off.sum()) / total, even


def learn(
    files: list[Path], *, steps: int, seed: int, minutes: float = math.inf
) -> Iterator[tuple[float, Learnt]]:
    """The loss of each step, and what was learnt until then."""
    rng = np.random.default_rng(seed)
    state, one = networks.first(GRAPH, graphs.FINDER_IN, seed), networks.step(loss)
    for rate in networks.rates(steps, MOST_RATE, minutes):
        chosen = rng.choice(len(files), SCENES, replace=False)
        batch = _batch([frame for k in chosen for frame in load(files[int(k)])], rng)
        state, value = one(state, rate, batch)
        yield float(value), state


def _batch(frames: list[Frame], rng: np.random.Generator) -> dict[str, np.ndarray]:
    images, wanted = [], []
    count = 4 * SCENES  # of one size, so that JAX compiles once
    for frame in [frames[k % len(frames)] for k in range(count)]:
        seen = sight(frame.image, frame.X_WC)
        assert seen is not None
        rows, columns = frame.who.shape
        v = 4 * int(rng.integers((rows - CUT[0]) // 4 + 1)) * 1
        u = 4 * int(rng.integers((columns - CUT[1]) // 4 + 1))
        image = tensor(seen)[v : v + CUT[0], u : u + CUT[1]]
        goal = answers(frame)[v // 2 : (v + CUT[0]) // 2, u // 2 : (u + CUT[1]) // 2]
        if rng.random() < 0.5:
            image, goal = image[:, ::-1], goal[:, ::-1] * np.array([1.0, -1.0, 1.0, 1.0])
        image = image.copy()
        image[..., :3] = (image[..., :3] + 0.5) * np.exp(rng.normal(0.0, 0.12, 3)) - 0.5
        image[..., 4] += (image[..., 5] > 0.0) * rng.normal(0.0, 0.05)
        images.append(image.astype(np.float32))
        wanted.append(goal.astype(np.float32))
    return {"image": np.stack(images), "wanted": np.stack(wanted)}
