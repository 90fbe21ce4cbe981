"""Takes made hard: other voices' lengths of throat, rooms, microphones, noise, talk beside them.

All of it is done to the powers of the bands, in which sounds add but for a little that depends on
their phases: a hundred times faster than to the samples.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from intents.speech.filterbank import BANDS, FLOOR, HOP, SMOOTH, TO_BANDS, WIDTH, against, powers
from intents.speech.network import STRIDE
from training.cries.takes import LOUDEST, Spoken

FRAMES = 258
"""Of a clip, 10 ms each."""
EARLY, LATE = 10, 42
"""A cry is told so many frames before to so many after about the end of its word."""
_CRIES, _AFTER_TALK, _SILENT = 0.5, 0.2, 0.05
_RATE = 100.0
"""Frames a second."""
_TRACK, _TRACKS = 1500, 60
_LINES = np.maximum(1.0, (TO_BANDS > 0.5).sum(axis=0))
"""About so many lines of the spectrum make a band."""

Powers = NDArray[np.float32]


class Take(NamedTuple):
    """A take as the network hears it.

    Attributes:
        logs: logarithms of the powers of its bands, shape (frames, 40).
        keyword: as in `training.cries.takes`.
        begin: the frame in which the first keyword of any kind may begin.
        end: about the frame in which the word that cries ends.
    """

    logs: NDArray[np.float16]
    keyword: int = -1
    begin: float = 0.0
    end: float = 0.0


def heard(take: Spoken) -> Take:
    """A take as the network hears it: as loud as can be, between silences."""
    around = (WIDTH // 2, WIDTH // 2 + HOP)
    logs = np.log(powers(np.pad(take.sound / np.float32(LOUDEST), around)))
    return Take(logs.astype(np.float16), take.keyword, _RATE * take.begin_s, _RATE * take.end_s)


class Clips(NamedTuple):
    """What the network sees, and what it should say.

    Attributes:
        bands: shape (clips, frames, 40).
        keyword: -1 where there is none.
        window: of the network's answers in which it should be told, shape (clips, answers).
        quiet: of those in which nothing should be, the same.
    """

    bands: Powers
    keyword: NDArray[np.int64]
    window: Powers
    quiet: Powers


class Mixer:
    """Makes clips of takes."""

    def __init__(self, cries: Sequence[Take], others: Sequence[Take], seed: int) -> None:
        """Let groups of people talk at once, for noise."""
        self._cries, self._others = cries, others
        self._rng = np.random.default_rng(seed)
        self._talk = [self._group() for _ in range(_TRACKS)]

    def clips(self, count: int) -> Clips:
        """So many clips."""
        made = [self._clip() for _ in range(count)]
        power = np.stack([one[0] for one in made])
        start = (1.0 - SMOOTH) * power[:, :1]
        means, _ = lfilter([SMOOTH], [1.0, SMOOTH - 1.0], power, axis=1, zi=start)
        told = [np.array([one[n] for one in made]) for n in (1, 2, 3)]
        return Clips(against(power, means.astype(np.float32)), told[0], told[1], told[2])

    def _clip(self) -> tuple[Powers, int, Powers, Powers]:
        rng, answers = self._rng, FRAMES // STRIDE
        power = np.zeros((FRAMES, BANDS), np.float32)
        keyword, window, quiet = -1, np.zeros(answers, np.float32), np.ones(answers, np.float32)
        if rng.random() < _CRIES:
            take = self._cries[rng.integers(len(self._cries))]
            said, stretch = self._said(take)
            keyword, begin, end = take.keyword, stretch * take.begin, stretch * take.end
            at = round(rng.uniform(0.0, max(5.0, min(140.0, FRAMES - end - LATE - 5.0))))
            _add(power, said, at)
            if rng.random() < _AFTER_TALK:
                other, _ = self._said(self._other())
                _add(power, other, at - round(rng.uniform(3.0, 50.0)) - len(other))
            times = (np.arange(answers) + 1) * STRIDE - at
            window[(times > end - EARLY) & (times < end + LATE)] = 1.0
            quiet[times > begin + 5.0] = 0.0
        elif rng.random() > _SILENT:
            at = -round(rng.uniform(0.0, 150.0))
            while at < FRAMES:
                said, _ = self._said(self._other())
                _add(power, said, at)
                at += len(said) + round(rng.uniform(5.0, 120.0))
        return self._heard(power), keyword, window, quiet

    def _other(self) -> Take:
        return self._others[self._rng.integers(len(self._others))]

    def _said(self, take: Take) -> tuple[Powers, float]:
        """A take by another throat, through another microphone; and how much longer it lasts."""
        rng = self._rng
        stretch, warp = np.exp(rng.normal(0.0, (0.10, 0.06)))
        rows = np.minimum(
            np.arange(0.0, len(take.logs), 1.0 / stretch).astype(int), len(take.logs) - 1
        )
        at = np.clip(np.arange(BANDS) * warp, 0.0, BANDS - 1.001)
        low = at.astype(int)
        share = (at - low).astype(np.float32)
        logs = take.logs[rows].astype(np.float32)
        logs = logs[:, low] * (1.0 - share) + logs[:, low + 1] * share
        places = np.linspace(-1.0, 1.0, BANDS)
        tilt = rng.normal(0.0, 0.7) * places + rng.normal(0.0, 0.4) * np.cos(
            rng.uniform(1.0, 6.0) * places + rng.uniform(0.0, 6.0)
        )
        return np.exp(logs + tilt.astype(np.float32)), float(stretch)

    def _heard(self, power: Powers) -> Powers:
        """In a room, in noise."""
        rng = self._rng
        if rng.random() < 0.4:
            decay = 10.0 ** (-0.06 / rng.uniform(0.15, 0.8))
            late = lfilter([0.0, 1.0 - decay], [1.0, -decay], power, axis=0)
            power = power + rng.uniform(0.1, 0.8) * late.astype(np.float32)
        whole = power.sum(axis=1)
        level = float(whole[whole > 1e-3 * whole.max()].mean()) if whole.any() else 1e6
        kind, snr_db = rng.random(), rng.uniform(5.0, 28.0)
        if kind < 0.6:
            begin = rng.integers(0, _TRACK - FRAMES)
            noise = self._talk[rng.integers(_TRACKS)][begin : begin + FRAMES]
        else:
            color = np.exp(rng.uniform(-0.15, 0.06) * np.arange(BANDS))
            noise = rng.gamma(_LINES, 1.0 / _LINES, power.shape) * color
            snr_db += 20.0 * (kind > 0.8)
        noise = noise * (level * 10.0 ** (-snr_db / 10.0) / noise.sum(axis=1).mean())
        phases = np.clip(rng.normal(0.0, 0.7, power.shape) / np.sqrt(_LINES), -1.0, 1.0)
        heard = power + noise + 2.0 * phases * np.sqrt(power * noise)
        gain = 10.0 ** rng.uniform(-2.5, -0.3)
        return (gain * np.maximum(heard, 0.0) + FLOOR).astype(np.float32)

    def _group(self) -> Powers:
        """Three to ten people who talk at once."""
        talk = np.zeros((_TRACK, BANDS), np.float32)
        for _ in range(self._rng.integers(3, 11)):
            at, loud = -round(self._rng.uniform(0.0, 200.0)), self._rng.uniform(0.4, 2.0)
            while at < _TRACK:
                said, _ = self._said(self._other())
                part = loud * said / (said.sum(axis=1).mean() + 1e-6)
                both = talk[max(0, at) : max(0, at + len(part))]
                phases = np.clip(
                    self._rng.normal(0.0, 0.7, both.shape) / np.sqrt(_LINES), -1.0, 1.0
                )
                part = part[max(0, -at) : max(0, -at) + len(both)]
                both += part + 2.0 * phases * np.sqrt(part * both)
                np.maximum(both, 0.0, out=both)
                at += len(said)
        return talk


def _add(power: Powers, part: Powers, at: int) -> None:
    """Add a part at a frame, as far as it fits."""
    begin, end = max(0, at), min(len(power), at + len(part))
    if begin < end:
        power[begin:end] += part[begin - at : end - at]
