"""Learns the finder: for each second pixel, whether it is of a thing and where its middle is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from robot.perception.things.inputs import sight, tensor
from robot.perception.things.instances import HALF, REACH_PX
from training.things import graphs, networks
from training.things.frames import Frame, load
from training.things.networks import Learnt
from training.things.working import each

GRAPH = graphs.finder()
MOST_RATE = 4e-3
CUT = (160, 192)
"""Rows and columns of a picture that are learnt from at a time."""
LEAST_PX = 12
"""Visible less, a thing need not be found, and may be."""
MIRRORED = np.array([1.0, -1.0, 1.0, 1.0], dtype=np.float32)
"""What becomes of an answer in a mirror."""


class Pictures(NamedTuple):
    """Many of them, at half precision.

    Attributes:
        images: as the finder takes them, shape (n, rows, columns, inputs.CHANNELS).
        wanted: what it should say (`answers`), shape (n, rows / 2, columns / 2, 4).
    """

    images: Any
    wanted: Any


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


def gathered(files: list[Path], *, jobs: int = 1) -> Pictures:
    """The pictures of all scenes."""
    made = [one for one in each(pictures, files, name="read pictures", jobs=jobs) if one]
    return Pictures(*(np.concatenate(parts) for parts in zip(*made, strict=True)))


def pictures(path: Path) -> Pictures | None:
    """The pictures of one scene; None if it has none."""
    images, wanted = [], []
    for frame in load(path):
        seen = sight(frame.image, frame.X_WC)
        assert seen is not None
        images.append(tensor(seen).astype(np.float16))
        wanted.append(answers(frame).astype(np.float16))
    return Pictures(np.stack(images), np.stack(wanted)) if images else None


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
    given: Pictures, *, steps: int, batch: int, seed: int, minutes: float = math.inf
) -> Iterator[tuple[float, Learnt]]:
    """The loss of each step, and what was learnt until then."""
    state, one = networks.first(GRAPH, graphs.FINDER_IN, seed), networks.step(loss, varied)
    held, rng = jax.device_put(given), np.random.default_rng(seed)
    for number, rate in enumerate(networks.rates(steps, MOST_RATE, minutes)):
        chosen = rng.integers(len(given.images), size=batch)
        state, value = one(state, rate, held, chosen, jax.random.key(number))
        yield float(value), state


def varied(given: Pictures, chosen: Any, key: Any) -> dict[str, Any]:
    """Cuts of some of them, mirrored or not, in other light, from another height."""
    count, (rows, columns) = len(chosen), given.images.shape[1:3]
    keys = jax.random.split(key, 5)
    v = 4 * jax.random.randint(keys[0], (count,), 0, (rows - CUT[0]) // 4 + 1)
    u = 4 * jax.random.randint(keys[1], (count,), 0, (columns - CUT[1]) // 4 + 1)

    def cut(pictures: Any, parts: int) -> Any:
        shape = (1, CUT[0] // parts, CUT[1] // parts, pictures.shape[-1])

        def one(k: Any, v: Any, u: Any) -> Any:
            return jax.lax.dynamic_slice(pictures, (k, v // parts, u // parts, 0), shape)[0]

        return jax.vmap(one)(chosen, v, u).astype(jnp.float32)

    image, wanted = cut(given.images, 1), cut(given.wanted, HALF)
    turned = jax.random.bernoulli(keys[2], 0.5, (count, 1, 1, 1))
    image = jnp.where(turned, image[:, :, ::-1], image)
    wanted = jnp.where(turned, wanted[:, :, ::-1] * MIRRORED, wanted)
    gain = jnp.exp(0.12 * jax.random.normal(keys[3], (count, 1, 1, 3)))
    higher_m = 0.05 * jax.random.normal(keys[4], (count, 1, 1))
    image = image.at[..., :3].set((image[..., :3] + 0.5) * gain - 0.5)
    image = image.at[..., 4].add((image[..., 5] > 0.0) * higher_m)
    return {"image": image, "wanted": wanted}
