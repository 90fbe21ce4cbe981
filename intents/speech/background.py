"""How loud it is in the band of voices, and how loud the background of that is.

The background is the lowest level of the last seconds, or the level at which sound kept for so long
that it can be no single voice. A voice swings by 13 dB and more within one and a half seconds, also
in white noise 15 dB below it, for it has vowels and stops; eight voices at once by 4 to 9 dB
(between the quietest and the loudest tenth, measured on those of `benchmarks.speech`).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from intents.speech.audio import RATE_HZ, SILENCE_DB, Samples, decibels

FRAME = RATE_HZ // 100
"""Samples of 10 ms."""
STEADY_S = 1.5
"""What swings little for so long is background, however loud."""
STEADY_DB = 9.5
"""That much is little, from the quietest to the loudest tenth."""
BELOW_MEAN_DB = 1.5
"""The lowest level of white noise is so far below its mean; so other steady sound is taken."""
_WINDOW = np.hanning(2 * FRAME)
_BAND = slice(200 * 2 * FRAME // RATE_HZ, 3_800 * 2 * FRAME // RATE_HZ)
"""Hum, rumble, a constant offset and hiss say nothing about speech."""
_SCALE = 2.0 / float(np.sum(_WINDOW**2)) / (2 * FRAME)
_SMOOTH, _EVERY = 5, 10


def frames(span_s: float) -> int:
    """How many frames a span takes, at least one."""
    return max(1, round(span_s * RATE_HZ / FRAME))


def is_steady(levels_db: Sequence[float]) -> bool:
    """Whether levels swing too little for a voice."""
    low, high = np.percentile(levels_db, (10, 90))
    return bool(high - low < STEADY_DB)


def mean_db(levels_db: Sequence[float]) -> float:
    """The level of the mean power."""
    return decibels(float(np.mean(10.0 ** (np.array(levels_db) / 10.0))))


class Background:
    """Follows the levels of a stream.

    Attributes:
        level_db: of the last 50 ms [dB of full scale].
        floor_db: of the background.
    """

    def __init__(self, memory_s: float, faint_db: float) -> None:
        """Begin with a background that is as quiet as what comes first.

        Args:
            memory_s: the lowest level of so long is background.
            faint_db: the background is never below this.
        """
        self.level_db = self.floor_db = SILENCE_DB
        self._faint_db = faint_db
        self._steady_db = SILENCE_DB
        self._last = np.zeros(FRAME, np.float32)
        self._powers: deque[float] = deque(maxlen=_SMOOTH)
        self._levels_db: deque[float] = deque(maxlen=frames(memory_s))
        self._recent_db: deque[float] = deque(maxlen=frames(STEADY_S))
        self._count = 0

    def above_db(self, frame: Samples) -> float:
        """How far the next frame is above the background."""
        spectrum = np.fft.rfft(_WINDOW * np.concatenate([self._last, frame]))[_BAND]
        self._last = frame
        self._powers.append(_SCALE * float(np.sum(np.abs(spectrum) ** 2)))
        self.level_db = max(decibels(sum(self._powers) / len(self._powers)), SILENCE_DB)
        self._levels_db.append(self.level_db)
        self._recent_db.append(self.level_db)
        self._count += 1
        full = len(self._recent_db) == self._recent_db.maxlen
        if full and self._count % _EVERY == 0 and is_steady(self._recent_db):
            self.take(float(np.median(self._recent_db)))
        self.floor_db = max(min(self._levels_db), self._steady_db, self._faint_db)
        return self.level_db - self.floor_db

    def take(self, mean_db: float) -> None:
        """Take note that sound of a level is background."""
        self._steady_db = mean_db - BELOW_MEAN_DB
