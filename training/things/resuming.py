"""Goes on learning from a network that was written: what `export` folded together is parted again.

A normalisation with a batch's mean and variance would undo what was folded into its convolution; so
its scale and its shift are set to what some crops give there, and the network says what it said.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import onnx
from onnx import numpy_helper

from training.things import networks
from training.things.graphs import Graph
from training.things.networks import EVEN, Learnt


def read(path: Path, graph: Graph, given: dict[str, Any]) -> Learnt:
    """What a written network has learnt, with fresh means of Adam.

    Args:
        path: of the file.
        graph: the network.
        given: some of what it is given, as `networks.run` takes it.
    """
    written = {one.name: numpy_helper.to_array(one) for one in onnx.load(path).graph.initializer}
    weights: dict[str, Any] = {}
    even: dict[str, Any] = {}
    for place, layer in enumerate(graph):
        if layer.kind not in ("conv", "plain", "dense", "leave"):
            continue
        w, b = written[f"{layer.name}/w"], written[f"{layer.name}/b"]
        w = w.transpose(2, 3, 1, 0) if w.ndim == 4 else w
        weights[f"{layer.name}/w"], weights[f"{layer.name}/b"] = jnp.asarray(w), jnp.asarray(b)
        if layer.kind != "conv":
            continue
        alone = {**weights, f"{layer.name}/b": jnp.zeros(len(b))}
        upto = (*graph[:place], layer._replace(kind="plain"))
        said, _ = networks.run(upto, alone, even, given, learns=False)
        mean, variance = said.mean(axis=(0, 1, 2)), said.var(axis=(0, 1, 2))
        weights[f"{layer.name}/g"] = jnp.sqrt(variance + EVEN)
        weights[f"{layer.name}/b"] = jnp.asarray(b) + mean
        even[f"{layer.name}/m"], even[f"{layer.name}/v"] = mean, variance
    first, second = (jax.tree.map(jnp.zeros_like, weights) for _ in range(2))
    return Learnt(weights, even, first, second, jnp.float32(np.float32(0.0)))
