"""The layers of a graph in JAX (`pip install -e .[train]`), and the steps that learn them."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from training.things.graphs import Graph, widths

Weights = dict[str, Any]
EVEN = 1e-3
_KEPT = 0.97
"""The means and variances that are used are running means of those of the batches."""
DECAY = 2e-2
WARM_STEPS = 60


class Learnt(NamedTuple):
    """What learning changes: weights, running statistics of the normalisations, Adam's means."""

    weights: Weights
    even: Weights
    mean: Weights
    square: Weights
    steps: Any


def first(graph: Graph, given: dict[str, int], seed: int) -> Learnt:
    """Weights to begin with [He et al. 2015]."""
    rng, sizes = np.random.default_rng(seed), widths(graph, given)
    weights: Weights = {}
    even: Weights = {}
    for layer in graph:
        if layer.kind not in ("conv", "plain", "dense", "leave"):
            continue
        into, out = sizes[layer.of[0]], sizes[layer.name]
        shape = (layer.size, layer.size, into, out)
        if layer.kind in ("dense", "leave"):
            shape = (into, out)
        spread = np.sqrt(2.0 / np.prod(shape[:-1]))
        spread *= 0.3 if layer.kind in ("plain", "leave") else 1.0
        weights[f"{layer.name}/w"] = jnp.asarray(rng.normal(0.0, spread, shape), jnp.float32)
        weights[f"{layer.name}/b"] = jnp.zeros(out)
        if layer.kind == "conv":
            weights[f"{layer.name}/g"] = jnp.ones(out)
            even[f"{layer.name}/m"], even[f"{layer.name}/v"] = jnp.zeros(out), jnp.ones(out)
    mean, square = (jax.tree.map(jnp.zeros_like, weights) for _ in range(2))
    return Learnt(weights, even, mean, square, jnp.float32(0.0))


def run(
    graph: Graph, weights: Weights, even: Weights, given: dict[str, Any], *, learns: bool
) -> tuple[Any, Weights]:
    """What a network answers, and its running statistics after that.

    Args:
        graph: the network.
        weights: of it.
        even: running statistics of its normalisations.
        given: pictures, shape (n, rows, columns, channels), and numbers, shape (n, k).
        learns: whether the statistics are those of the batch.
    """
    found, kept = dict(given), dict(even)
    for layer in graph:
        x = found[layer.of[0]]
        match layer.kind:
            case "conv" | "plain":
                pad = layer.size // 2
                x = jax.lax.conv_general_dilated(
                    x, weights[f"{layer.name}/w"], (layer.stride,) * 2, ((pad, pad), (pad, pad)),
                    dimension_numbers=("NHWC", "HWIO", "NHWC"),
                )  # fmt: skip
                if layer.kind == "conv":
                    mean, variance = kept[f"{layer.name}/m"], kept[f"{layer.name}/v"]
                    if learns:
                        now = x.mean(axis=(0, 1, 2))
                        spread = jnp.maximum((x * x).mean(axis=(0, 1, 2)) - now * now, 0.0)
                        kept[f"{layer.name}/m"] = _KEPT * mean + (1 - _KEPT) * now
                        kept[f"{layer.name}/v"] = _KEPT * variance + (1 - _KEPT) * spread
                        mean, variance = now, spread
                    scale = weights[f"{layer.name}/g"] / jnp.sqrt(variance + EVEN)
                    x = jax.nn.relu((x - mean) * scale + weights[f"{layer.name}/b"])
                else:
                    x = x + weights[f"{layer.name}/b"]
            case "fold":
                n, h, w, c = x.shape
                x = x.reshape(n, h // 2, 2, w // 2, 2, c).transpose(0, 1, 3, 2, 4, 5)
                x = x.reshape(n, h // 2, w // 2, 4 * c)
            case "up":
                n, h, w, c = x.shape
                x = jnp.broadcast_to(x[:, :, None, :, None], (n, h, 2, w, 2, c))
                x = x.reshape(n, 2 * h, 2 * w, c)
            case "join":
                x = jnp.concatenate([found[one] for one in layer.of], axis=-1)
            case "add":
                x = x + found[layer.of[1]]
            case "mean":
                x = x.mean(axis=(1, 2))
            case _:
                x = x @ weights[f"{layer.name}/w"] + weights[f"{layer.name}/b"]
                x = jax.nn.relu(x) if layer.kind == "dense" else x
        found[layer.name] = x
    return found[graph[-1].name], kept


def step(loss: Callable[..., Any], varied: Callable[..., Any]) -> Callable[..., tuple[Learnt, Any]]:
    """A step of Adam [Kingma, Ba 2015] with decaying weights.

    Args:
        loss: of weights, statistics and a batch; it gives its value, and the statistics after it.
        varied: makes the batch of all that there is to learn from, the numbers of what is chosen
            of it, and a random key.
    """

    def one(state: Learnt, rate: Any, given: Any, chosen: Any, key: Any) -> tuple[Learnt, Any]:
        batch = varied(given, chosen, key)
        (value, even), slope = jax.value_and_grad(loss, has_aux=True)(
            state.weights, state.even, batch
        )
        size = jnp.sqrt(sum(jnp.sum(leaf**2) for leaf in jax.tree.leaves(slope)))
        slope = jax.tree.map(lambda leaf: leaf * jnp.minimum(1.0, 5.0 / (size + 1e-9)), slope)
        n = state.steps + 1
        mean = jax.tree.map(lambda m, s: 0.9 * m + 0.1 * s, state.mean, slope)
        square = jax.tree.map(lambda v, s: 0.999 * v + 0.001 * s * s, state.square, slope)
        weights = jax.tree.map(
            lambda p, m, v: (1.0 - DECAY * rate * (p.ndim > 1)) * p
            - rate * (m / (1.0 - 0.9**n)) / (jnp.sqrt(v / (1.0 - 0.999**n)) + 1e-8),
            state.weights, mean, square,
        )  # fmt: skip
        return Learnt(weights, even, mean, square, n), value

    return jax.jit(one, donate_argnums=0)


def rates(steps: int, most: float, minutes: float) -> Iterator[float]:
    """How far each step goes: warming up, then falling as a cosine does.

    Args:
        steps: how many at most.
        most: the furthest that one goes.
        minutes: after so long it is the last one, on a machine that has other things to do.
    """
    begun_s = time.monotonic()
    for number in range(steps):
        share = max(number / steps, (time.monotonic() - begun_s) / (60.0 * minutes))
        if share >= 1.0:
            return
        turn = 0.5 + 0.5 * math.cos(math.pi * share)
        yield (0.01 + 0.99 * turn) * most * min(1.0, (number + 1) / WARM_STEPS)
