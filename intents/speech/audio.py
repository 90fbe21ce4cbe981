"""Sound as the recognisers take it: one channel of float32 in [-1, 1] at 16 kHz.

`Resampler` brings any rate to that, block by block: a polyphase filter with a Kaiser window
(`scipy.signal.resample_poly`), whose blocks overlap so that their joints are not heard.
"""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Samples: TypeAlias = NDArray[np.float32]
"""Amplitudes in [-1, 1], shape (n,)."""
RATE_HZ = 16_000
MIN_RATE_HZ, MAX_RATE_HZ = 4_000, 768_000
SILENCE_DB = -120.0


class AudioError(Exception):
    """Sound that cannot be had: what is wrong, and what to do about it.

    Attributes:
        cure: what a person can do.
    """

    def __init__(self, cause: str, cure: str) -> None:
        """Say both."""
        super().__init__(cause)
        self.cure = cure


def decibels(power: float) -> float:
    """A mean square amplitude as a level [dB of full scale]."""
    return 10.0 * math.log10(power) if power > 10.0 ** (SILENCE_DB / 10.0) else SILENCE_DB


def mono(frames: NDArray[Any]) -> Samples:
    """The mean of the channels, shape (n, channels) to (n,); what is no number is silence."""
    mixed = frames.mean(axis=1, dtype=np.float64)
    sound = np.clip(np.nan_to_num(mixed, nan=0.0, posinf=1.0, neginf=-1.0), -1.0, 1.0)
    return sound.astype(np.float32)


class Resampler:
    """Brings sound of one rate to `RATE_HZ`, as it comes."""

    def __init__(self, rate_hz: int) -> None:
        """Begin; `rate_hz` is that of the sound that comes.

        Raises:
            AudioError: the rate is absurd.
        """
        if not MIN_RATE_HZ <= rate_hz <= MAX_RATE_HZ:
            raise AudioError(
                f"a rate of {rate_hz} Hz is not between {MIN_RATE_HZ} and {MAX_RATE_HZ}",
                "record it again, best with 16000 Hz and one channel",
            )
        common = math.gcd(rate_hz, RATE_HZ)
        self._up, self._down = RATE_HZ // common, rate_hz // common
        self._margin = self._down * math.ceil(20 * max(1.0, self._up / self._down))
        self._kept = np.zeros(self._margin, np.float32)

    def push(self, sound: Samples) -> Samples:
        """What can be said of the sound so far; a little is kept back."""
        if self._up == self._down:
            return sound
        self._kept = np.concatenate([self._kept, sound])
        whole = (len(self._kept) - 2 * self._margin) // self._down * self._down
        return self._resampled(whole) if whole > 0 else np.zeros(0, np.float32)

    def flush(self) -> Samples:
        """The rest."""
        if self._up == self._down:
            return np.zeros(0, np.float32)
        rest = len(self._kept) - self._margin
        padded = math.ceil(rest / self._down) * self._down
        silence = np.zeros(padded - rest + self._margin, np.float32)
        self._kept = np.concatenate([self._kept, silence])
        made = self._resampled(padded)
        self._kept = np.zeros(self._margin, np.float32)
        return made[: math.ceil(rest * self._up / self._down)]

    def _resampled(self, count: int) -> Samples:
        """Take `count` samples, with a margin on either side that is filtered but not given out."""
        from scipy import signal  # pyright: ignore[reportMissingTypeStubs]

        taken = self._kept[: count + 2 * self._margin]
        self._kept = self._kept[count:]
        made: NDArray[np.float32] = signal.resample_poly(  # pyright: ignore[reportUnknownMemberType]
            taken, self._up, self._down
        )
        before = self._margin * self._up // self._down
        return made[before : before + count * self._up // self._down].astype(np.float32)
