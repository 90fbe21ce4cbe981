"""Takes made hard: other voices' lengths of throat, rooms, microphones, noise, talk beside them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve, lfilter

from intents.speech.audio import RATE_HZ
from intents.speech.filterbank import Filterbank
from intents.speech.network import STRIDE
from training.cries.takes import Spoken

CLIP_S = 2.6
EARLY_S, LATE_S = 0.1, 0.42
"""A cry is told so long before to so long after about the end of its word."""
FRAME_S = 0.01 * STRIDE
_CRIES, _AFTER_TALK = 0.5, 0.2
_TRACK_S, _TRACKS = 15.0, 40

Sound = NDArray[np.float32]


class Clip(NamedTuple):
    """What the network sees, and what it should say.

    Attributes:
        bands: shape (frames, 40).
        keyword: -1 if there is none.
        window: of the network's frames in which it should be told, shape (frames,).
        quiet: of those in which nothing should be, the same.
    """

    bands: NDArray[np.float32]
    keyword: int
    window: NDArray[np.float32]
    quiet: NDArray[np.float32]


class Mixer:
    """Makes clips of takes."""

    def __init__(self, cries: Sequence[Spoken], others: Sequence[Spoken], seed: int) -> None:
        """Let groups of people talk at once, for noise."""
        self._cries, self._others = cries, others
        self._rng = np.random.default_rng(seed)
        self._talk = [self._group() for _ in range(_TRACKS)]

    def clip(self) -> Clip:
        """A clip."""
        rng, count = self._rng, round(CLIP_S * RATE_HZ)
        sound, frames = np.zeros(count, np.float32), round(CLIP_S / FRAME_S)
        keyword, window, quiet = -1, np.zeros(frames, np.float32), np.ones(frames, np.float32)
        if rng.random() < _CRIES:
            take = self._cries[rng.integers(len(self._cries))]
            said, stretch = self._warped(take.sound)
            keyword, end_s, begin_s = take.keyword, stretch * take.end_s, stretch * take.begin_s
            at_s = rng.uniform(0.0, max(0.05, min(1.4, CLIP_S - end_s - LATE_S - 0.05)))
            _add(sound, said, round(at_s * RATE_HZ))
            if rng.random() < _AFTER_TALK:
                other, _ = self._warped(self._other())
                gap_s = rng.uniform(0.03, 0.5)
                _add(sound, other, round((at_s - gap_s) * RATE_HZ) - len(other))
            times = (np.arange(frames) + 1) * FRAME_S - at_s
            window[(times > end_s - EARLY_S) & (times < end_s + LATE_S)] = 1.0
            quiet[times > begin_s + 0.05] = 0.0
        elif rng.random() < 0.93:
            at = -round(rng.uniform(0.0, 1.5) * RATE_HZ)
            while at < count:
                said, _ = self._warped(self._other())
                _add(sound, said, at)
                at += len(said) + round(rng.uniform(0.05, 1.2) * RATE_HZ)
        else:
            _add(sound, 0.1 * rng.normal(size=count).astype(np.float32), 0)
        return Clip(Filterbank().push(self._heard(sound)), keyword, window, quiet)

    def _other(self) -> NDArray[np.int16]:
        return self._others[self._rng.integers(len(self._others))].sound

    def _warped(self, said: NDArray[np.int16]) -> tuple[Sound, float]:
        """A voice with another length of throat; and how much longer it takes."""
        stretch = float(np.exp(self._rng.normal(0.0, 0.07)))
        at = np.arange(0.0, len(said) - 1.0, 1.0 / stretch)
        return np.interp(at, np.arange(len(said)), said / 20_000.0).astype(np.float32), stretch

    def _heard(self, sound: Sound) -> Sound:
        """Through a room and a microphone, in noise."""
        rng = self._rng
        if rng.random() < 0.35:
            sound = self._echoed(sound)
        tilt = rng.uniform(-0.5, 0.5)
        sound = lfilter([1.0, -tilt], [1.0], sound).astype(np.float32)
        voiced = sound[np.abs(sound) > 0.02]
        level = float(np.sqrt(np.mean(voiced**2))) if len(voiced) else 0.1
        kind, snr_db = rng.random(), rng.uniform(6.0, 30.0)
        if kind < 0.55:
            noise = self._stretch_of_talk(len(sound))
        elif kind < 0.8:
            noise = lfilter([1.0], [1.0, -rng.uniform(0.0, 0.97)], rng.normal(size=len(sound)))
        else:
            noise, snr_db = rng.normal(size=len(sound)), 45.0
        noise = noise * (level * 10 ** (-snr_db / 20.0) / np.sqrt(np.mean(noise**2) + 1e-12))
        gain = 10 ** (rng.uniform(-34.0, -12.0) / 20.0) / level
        return np.clip(gain * (sound + noise), -1.0, 1.0).astype(np.float32)

    def _echoed(self, sound: Sound) -> Sound:
        decay_s = self._rng.uniform(0.05, 0.16)
        times = np.arange(round(4.0 * decay_s * RATE_HZ)) / RATE_HZ
        answer = self._rng.normal(size=len(times)) * np.exp(-times / decay_s)
        answer *= self._rng.uniform(0.2, 0.9) / np.sqrt(np.sum(answer**2))
        answer[0] += 1.0
        return fftconvolve(sound, answer)[: len(sound)].astype(np.float32)

    def _group(self) -> Sound:
        """Three to ten people who talk at once."""
        talk = np.zeros(round(_TRACK_S * RATE_HZ), np.float32)
        for _ in range(self._rng.integers(3, 11)):
            at, loud = -round(self._rng.uniform(0.0, 2.0) * RATE_HZ), self._rng.uniform(0.6, 1.4)
            while at < len(talk):
                said, _ = self._warped(self._other())
                _add(talk, loud * said / (said.std() + 1e-6), at)
                at += len(said)
        return talk

    def _stretch_of_talk(self, count: int) -> Sound:
        talk = self._talk[self._rng.integers(_TRACKS)]
        begin = self._rng.integers(0, len(talk) - count)
        return talk[begin : begin + count]


def _add(sound: Sound, part: Sound, at: int) -> None:
    """Add a part at a place, as far as it fits."""
    begin, end = max(0, at), min(len(sound), at + len(part))
    if begin < end:
        sound[begin:end] += part[begin - at : end - at]
