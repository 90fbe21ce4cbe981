"""Learns the network's weights with JAX (`pip install -e .[train]`)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from intents.speech.filterbank import BANDS
from intents.speech.keywords import KEYWORDS
from intents.speech.network import DILATIONS, STRIDE, TAPS
from training.cries.mixing import Clips

CHANNELS = 64
RATE, RATE_END = 2.5e-3, 1e-5
_QUIET = 0.06
"""Weight of an answer that should be nothing; a cry weighs one."""
_KEPT = 0.99
"""The weights that are used are a running mean of those learnt."""
Weights = dict[str, Any]


def first(seed: int) -> Weights:
    """Weights to begin with."""
    rng = np.random.default_rng(seed)
    blocks, width, answers = len(DILATIONS), STRIDE * BANDS, 1 + len(KEYWORDS)
    drawn = {
        "enter": rng.normal(size=(width, CHANNELS)) / np.sqrt(width),
        "taps": rng.normal(size=(blocks, TAPS, CHANNELS)) / np.sqrt(TAPS),
        "mix": rng.normal(size=(blocks, CHANNELS, CHANNELS)) * np.sqrt(2.0 / CHANNELS),
        "leave": rng.normal(size=(CHANNELS, answers)) / np.sqrt(CHANNELS),
        "enter_bias": np.zeros(CHANNELS), "mix_bias": np.zeros((blocks, CHANNELS)),
        "leave_bias": np.eye(answers)[0] * 3.0,
    }  # fmt: skip
    return {name: jnp.asarray(value, jnp.float32) for name, value in drawn.items()}


def logits(w: Mapping[str, Any], bands: Any) -> Any:
    """As `intents.speech.network`, of whole clips, shape (clips, answers, 1 + keywords)."""
    clips, count = bands.shape[0], bands.shape[1] // STRIDE
    x = bands[:, : count * STRIDE].reshape(clips, count, -1) @ w["enter"] + w["enter_bias"]
    for block, dilation in enumerate(DILATIONS):
        seen = jnp.pad(x, ((0, 0), ((TAPS - 1) * dilation, 0), (0, 0)))
        taps = w["taps"][block]
        mixed = sum(taps[k] * seen[:, k * dilation : k * dilation + count] for k in range(TAPS))
        x = x + jax.nn.relu(_even(mixed) @ w["mix"][block] + w["mix_bias"][block])
    return _even(x) @ w["leave"] + w["leave_bias"]


def _even(x: Any) -> Any:
    centred = x - x.mean(axis=-1, keepdims=True)
    return centred / jnp.sqrt((centred**2).mean(axis=-1, keepdims=True) + 1e-5)


def loss(w: Weights, bands: Any, keyword: Any, window: Any, quiet: Any) -> Any:
    """How unlikely the clips' words are: told once in their window, and nothing elsewhere.

    A word may be told anywhere in its window [Sun et al. 2017, "Max-pooling loss training of long
    short-term memory networks for small-footprint keyword spotting"], here by a mean of the best.
    """
    told = jax.nn.log_softmax(logits(w, bands))
    count = min(told.shape[1], window.shape[1])
    told, window, quiet = told[:, :count], window[:, :count], quiet[:, :count]
    nothing = -_QUIET * jnp.sum(quiet * told[:, :, 0], axis=1)
    word = jnp.take_along_axis(told, jnp.maximum(keyword + 1, 1)[:, None, None], axis=2)[:, :, 0]
    inside = jnp.where(window > 0.0, 3.0 * word, -1e9)
    share = jax.nn.softmax(inside, axis=1)
    cried = -jnp.sum(share * jnp.where(window > 0.0, word, 0.0), axis=1)
    return jnp.mean(nothing + jnp.where(keyword >= 0, cried, 0.0))


class Step(NamedTuple):
    """A step of learning: the loss of its clips, and the weights after it."""

    loss: float
    weights: Weights


def learn(clips: Callable[[int], Clips], *, steps: int, batch: int, seed: int) -> Iterator[Step]:
    """Adam [Kingma, Ba 2015], with decaying weights, over clips.

    Args:
        clips: makes so many.
        steps: how many.
        batch: clips in each.
        seed: of the first weights.
    """

    @jax.jit
    def step(state: Any, rate: Any, clips: Any) -> Any:
        w, mean, square, kept, n = state
        value, slope = jax.value_and_grad(loss)(w, *clips)
        size = jnp.sqrt(sum(jnp.sum(one**2) for one in jax.tree.leaves(slope)))
        slope = jax.tree.map(lambda one: one * jnp.minimum(1.0, 2.0 / (size + 1e-9)), slope)
        n = n + 1
        mean = jax.tree.map(lambda m, s: 0.9 * m + 0.1 * s, mean, slope)
        square = jax.tree.map(lambda v, s: 0.999 * v + 0.001 * s * s, square, slope)
        w = jax.tree.map(
            lambda p, m, v: (1.0 - 1e-2 * rate) * p
            - rate * (m / (1.0 - 0.9**n)) / (jnp.sqrt(v / (1.0 - 0.999**n)) + 1e-8),
            w, mean, square,
        )  # fmt: skip
        keep = jnp.minimum(_KEPT, n / (n + 10.0))
        kept = jax.tree.map(lambda k, p: keep * k + (1.0 - keep) * p, kept, w)
        return (w, mean, square, kept, n), value

    w = first(seed)
    none = jax.tree.map(jnp.zeros_like, w)
    state = (w, none, none, w, jnp.float32(0.0))
    for number in range(steps):
        turn = 0.5 + 0.5 * np.cos(np.pi * number / steps)
        rate = (RATE_END + (RATE - RATE_END) * turn) * min(1.0, (number + 1) / 100.0)
        state, value = step(state, rate, tuple(clips(batch)))
        yield Step(float(value), state[3])
