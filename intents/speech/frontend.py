"""An utterance made ready for the decoder: trimmed, levelled, on a steady background.

The decoder subtracts the mean of the cepstrum over the utterance, so what stands around the words
counts. Digital silence, which no microphone delivers and every synthesiser does, would shift it
far: hence a background of noise below the speech, which also dithers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from intents.speech.audio import RATE_HZ, Samples

MARGIN_S = 0.2
"""Kept around the words."""
LEVEL = 0.06
"""Root mean square of the words, full scale being 1."""
BACKGROUND_DB = -30.0
"""The noise that is added, below the words."""
_WINDOW = RATE_HZ // 50
_WORDS_DB = -30.0
"""What is this far below the loudest is no part of the words."""
_NOTHING = 1e-12
_SEED = 3
_HOP = 256
_TAPER = np.sqrt(0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(2 * _HOP) / (2 * _HOP)))
_QUIET_PERCENT = 15
_QUIET_BIAS = 1.3
_SMOOTH = 0.9
_GAIN_FLOOR = 0.1


def prepared(sound: Samples) -> bytes:
    """An utterance as 16-bit little-endian samples for the decoder; empty if there is nothing."""
    return prepared_from(sound)[0]


def prepared_from(sound: Samples) -> tuple[bytes, float]:
    """The same, and where in the sound it begins [s]."""
    if len(sound) < _WINDOW:
        return b"", 0.0
    sound = sound - sound.mean()
    power = np.convolve(sound**2, np.full(_WINDOW, 1.0 / _WINDOW), "same")
    loudest = float(power.max())
    if loudest <= _NOTHING:
        return b"", 0.0
    floor = max(loudest * 10 ** (_WORDS_DB / 10.0), 4.0 * float(np.percentile(power, 10)))
    words = np.flatnonzero(power >= min(floor, loudest))
    margin = round(MARGIN_S * RATE_HZ)
    first = max(0, int(words[0]) - margin)
    cut = cleaned(sound[first : words[-1] + margin])
    levelled = cut * (LEVEL / np.sqrt(power[words].mean()))
    noise = np.random.default_rng(_SEED).normal(size=len(cut))
    steady = levelled + LEVEL * 10 ** (BACKGROUND_DB / 20.0) * noise
    bounded: NDArray[np.float64] = np.clip(32_767.0 * steady, -32_768.0, 32_767.0)
    return bounded.round().astype("<i2").tobytes(), first / RATE_HZ


def cleaned(sound: Samples) -> Samples:
    """Sound with its steady background subtracted, by a Wiener filter over short spectra.

    The background is what the quietest frames hold, bin by bin; the gain follows the
    decision-directed estimate of [Ephraim, Malah 1984].
    """
    frames = _frames(sound)
    spectra = np.fft.rfft(frames, axis=1)
    power = np.abs(spectra) ** 2
    quiet = np.argsort(power.sum(axis=1))[: max(3, len(power) * _QUIET_PERCENT // 100)]
    noise = power[quiet].mean(axis=0) * _QUIET_BIAS + 1e-12
    gain = np.ones(power.shape[1])
    before = np.ones(power.shape[1])
    for number, loud in enumerate(power):
        after = loud / noise
        prior = _SMOOTH * gain**2 * before + (1.0 - _SMOOTH) * np.maximum(after - 1.0, 0.0)
        gain = np.maximum(prior / (1.0 + prior), _GAIN_FLOOR)
        before = after
        spectra[number] *= gain
    return _joined(spectra, len(sound))


def _frames(sound: Samples) -> NDArray[np.float64]:
    count = max(1, -(-len(sound) // _HOP) + 1)
    padded = np.zeros((count + 1) * _HOP)
    padded[_HOP : _HOP + len(sound)] = sound
    frames = np.lib.stride_tricks.sliding_window_view(padded, 2 * _HOP)[::_HOP]
    return frames * _TAPER


def _joined(spectra: NDArray[np.complex128], count: int) -> Samples:
    frames = np.fft.irfft(spectra, 2 * _HOP, axis=1) * _TAPER
    sound = np.zeros((len(frames) + 1) * _HOP)
    for number, frame in enumerate(frames):
        sound[number * _HOP : (number + 2) * _HOP] += frame
    return sound[_HOP : _HOP + count].astype(np.float32)
