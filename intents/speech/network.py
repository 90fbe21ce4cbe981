"""A network of causal convolutions over a stream of frames, a few microseconds each.

Three frames are taken together; blocks of a depthwise convolution and one over the channels add to
what runs through ("depthwise separable", as in keyword spotters since [Zhang et al. 2017, "Hello
Edge"]). Nothing looks ahead: each layer keeps the frames that it still needs.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from intents.speech.filterbank import BANDS, Bands

STRIDE = 3
"""Frames taken together: the network answers every 30 ms."""
DILATIONS = (1, 1, 2, 4, 8)
"""Of each block, in answers; with five taps each it looks back 1.9 s."""
TAPS = 5

Array = NDArray[np.float32]


class Network:
    """Follows one stream."""

    def __init__(self, weights: Mapping[str, Array]) -> None:
        """Begin after silence; `weights` are named as by `training.cries.learning`."""
        self._weights = weights
        channels = weights["enter"].shape[1]
        self._rest = np.zeros((0, BANDS), np.float32)
        self._before = [
            np.zeros(((TAPS - 1) * dilation, channels), np.float32) for dilation in DILATIONS
        ]

    def push(self, bands: Bands) -> Array:
        """The logits of nothing and of each keyword, shape (answers, 1 + keywords)."""
        w = self._weights
        bands = np.concatenate([self._rest, bands])
        count = len(bands) // STRIDE
        self._rest = bands[count * STRIDE :]
        x = bands[: count * STRIDE].reshape(count, STRIDE * BANDS) @ w["enter"] + w["enter_bias"]
        for block, dilation in enumerate(DILATIONS):
            seen = np.concatenate([self._before[block], x])
            taps, kept = w["taps"][block], (TAPS - 1) * dilation
            self._before[block] = seen[len(seen) - kept :]
            mixed = sum(taps[k] * seen[k * dilation : k * dilation + count] for k in range(TAPS))
            x = x + np.maximum(_even(mixed) @ w["mix"][block] + w["mix_bias"][block], 0.0)
        return _even(x) @ w["leave"] + w["leave_bias"]


def _even(x: Array) -> Array:
    """Each answer's channels with mean 0 and deviation 1."""
    centred = x - x.mean(axis=1, keepdims=True)
    return centred / np.sqrt((centred**2).mean(axis=1, keepdims=True) + 1e-5)
