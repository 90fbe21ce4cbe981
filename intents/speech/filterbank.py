"""How loud a stream is in bands of the ear, against how loud each was lately.

Per-channel energy normalisation [Wang et al. 2017, "Trainable frontend for robust and far-field
keyword spotting"]: the power E of each of 40 mel bands is divided by its own running mean M,
(E / (eps + M)^alpha + delta)^r - delta^r, so that neither the level nor steady noise matters.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from intents.speech.audio import RATE_HZ, Samples

BANDS = 40
HOP = RATE_HZ // 100
"""Samples from frame to frame."""
WIDTH, _FFT = 400, 512
_LOWEST_HZ, _HIGHEST_HZ = 100.0, 7_600.0
SMOOTH, _ALPHA, _DELTA, _ROOT, _EPSILON = 0.025, 0.98, 2.0, 0.5, 1e-6
"""Constants of the paper; the running mean is that of 0.4 s."""
_SCALE = 32_768.0**2
FLOOR = 1.0
"""Added to each power, which is that of samples of 16 bits: what rounding leaves in silence."""

Bands = NDArray[np.float32]
"""Shape (frames, 40): one row each 10 ms."""


def _filters() -> NDArray[np.float64]:
    """The weight of each line of the spectrum (257) in each band (40): triangles over the mel."""
    mels = np.linspace(_mel(_LOWEST_HZ), _mel(_HIGHEST_HZ), BANDS + 2)
    edges = 700.0 * (10.0 ** (mels / 2_595.0) - 1.0)
    low, middle, high = edges[:-2], edges[1:-1], edges[2:]
    lines = np.arange(_FFT // 2 + 1)[:, None] * (RATE_HZ / _FFT)
    rising, falling = (lines - low) / (middle - low), (high - lines) / (high - middle)
    return np.maximum(0.0, np.minimum(rising, falling))


def _mel(frequency_hz: float) -> float:
    return float(2_595.0 * np.log10(1.0 + frequency_hz / 700.0))


TO_BANDS = _filters()
_WINDOW = np.hanning(WIDTH) * np.sqrt(_SCALE / WIDTH)


class Filterbank:
    """Follows one stream."""

    def __init__(self) -> None:
        """Begin."""
        self._rest = np.zeros(0, np.float32)
        self._mean: NDArray[np.float32] | None = None

    def push(self, sound: Samples) -> Bands:
        """The frames that are whole with this block."""
        sound = np.concatenate([self._rest, sound])
        count = max(0, (len(sound) - WIDTH) // HOP + 1)
        self._rest = sound[count * HOP :]
        if not count:
            return np.zeros((0, BANDS), np.float32)
        power = powers(sound)
        means, mean = np.empty_like(power), power[0] if self._mean is None else self._mean
        for number, one in enumerate(power):
            means[number] = mean = mean + SMOOTH * (one - mean)
        self._mean = mean
        return against(power, means)


def powers(sound: Samples) -> Bands:
    """The power of each band in each whole frame of at least one [32768^-2 of full scale]."""
    frames = np.lib.stride_tricks.sliding_window_view(sound, WIDTH)[::HOP]
    lines = np.abs(np.fft.rfft(frames * _WINDOW, _FFT)) ** 2
    return (lines @ TO_BANDS + FLOOR).astype(np.float32)


def against(power: Bands, means: Bands) -> Bands:
    """Powers against their running means, of any shape."""
    ratio = power / (_EPSILON + means) ** _ALPHA
    return ((ratio + _DELTA) ** _ROOT - _DELTA**_ROOT).astype(np.float32)
