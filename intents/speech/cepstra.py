"""Mel-frequency cepstra, number for number those that PocketSphinx computes itself.

They are computed here so that they can be fitted to a voice before the decoder sees them
(`intents.speech.speaker`). Source: CMU Sphinx, fe_sigproc.c, with the constants of the model's
feat.params: 25 triangular filters of unit area from 130 to 6800 Hz, an orthonormal cosine
transform, a lifter of 22 [Davis, Mermelstein 1980].
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from intents.speech.audio import RATE_HZ

Cepstra = NDArray[np.float64]
"""Shape (frames, 13): one row each 10 ms, the first column is the loudness."""
COUNT = 13
HOP = RATE_HZ // 100
"""Samples from frame to frame."""
_WIDTH, _FFT = 410, 512
_FILTERS, _LOWEST_HZ, _HIGHEST_HZ = 25, 130.0, 6800.0
_EMPHASIS, _FLOOR, _LIFTER = 0.97, 1e-4, 22


def _mel(frequency_hz: float) -> float:
    return 2595.0 * np.log10(1.0 + frequency_hz / 700.0)


def _filters() -> NDArray[np.float64]:
    """The weight of each line of the spectrum (257) in each filter (25)."""
    line_hz = RATE_HZ / _FFT
    mels = np.linspace(_mel(_LOWEST_HZ), _mel(_HIGHEST_HZ), _FILTERS + 2)
    edges = np.floor(700.0 * (10.0 ** (mels / 2595.0) - 1.0) / line_hz + 0.5) * line_hz
    low, middle, high = edges[:-2], edges[1:-1], edges[2:]
    lines = np.arange(_FFT // 2 + 1)[:, None] * line_hz
    rising, falling = (lines - low) / (middle - low), (high - lines) / (high - middle)
    return np.maximum(0.0, np.minimum(rising, falling)) * 2.0 / (high - low)


def _cosines() -> NDArray[np.float64]:
    """The logarithms of the filters (25) to liftered cepstra (13)."""
    order, band = np.arange(COUNT), np.arange(_FILTERS) + 0.5
    cosines = np.cos(np.pi / _FILTERS * np.outer(band, order)) * np.sqrt(2.0 / _FILTERS)
    cosines[:, 0] = np.sqrt(1.0 / _FILTERS)
    return cosines * (1.0 + _LIFTER / 2 * np.sin(np.pi * order / _LIFTER))


_WINDOW = np.hamming(_WIDTH)
_TO_FILTERS, _TO_CEPSTRA = _filters(), _cosines()


def cepstra(data: bytes) -> Cepstra:
    """The cepstra of 16-bit little-endian samples at 16 kHz, at least one frame of them."""
    samples = np.frombuffer(data, "<i2").astype(np.float64)
    sharp = np.append(samples[:1], samples[1:] - _EMPHASIS * samples[:-1])
    count = 1 + max(0, -(-(len(sharp) - _WIDTH) // HOP))
    padded = np.zeros((count - 1) * HOP + _WIDTH)
    padded[: len(sharp)] = sharp
    frames = np.lib.stride_tricks.sliding_window_view(padded, _WIDTH)[::HOP]
    power = np.abs(np.fft.rfft(frames * _WINDOW, _FFT)) ** 2
    return np.log(power @ _TO_FILTERS + _FLOOR) @ _TO_CEPSTRA


def centred(values: Cepstra) -> Cepstra:
    """Less their mean, which is that of the microphone: the mean of the frames that are loud."""
    loud = values[:, 0] >= 0.0
    return values - values[loud if loud.any() else slice(None)].mean(axis=0)


def with_changes(values: Cepstra) -> tuple[Cepstra, Cepstra, Cepstra]:
    """Cepstra, how they change, and how that changes: what the model looks at."""
    count = len(values)
    padded = np.pad(values, ((3, 3), (0, 0)), mode="edge")
    at = {shift: padded[3 + shift : 3 + shift + count] for shift in (-3, -2, -1, 1, 2, 3)}
    return values, at[2] - at[-2], (at[3] - at[-1]) - (at[1] - at[-3])
