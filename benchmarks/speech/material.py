"""What is said, by which voices, in which noise."""

from __future__ import annotations

import random
from functools import lru_cache
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.intents import own
from benchmarks.speech.voices import spoken
from executive.meaning.knowledge import Knowledge
from intents.speech.audio import RATE_HZ, Samples
from intents.vocabulary import Vocabulary
from sim.simulation import Simulation

HERE = Path(__file__).resolve().parent
VOICES = ("en-us", "en-gb+f2", "en-us+f4", "en-gb-x-rp+m3")
"""Of espeak-ng: American and British, male and female; all were used for tuning."""
SPEEDS_WPM = (130, 160, 190)
PAUSE_S = 1.0
"""Before and after each utterance."""
_SEED = 5
Noise = Literal["clean", "white", "babble"]


class Line(NamedTuple):
    """A sentence, the world it is of (empty: any), and whether it was used for tuning."""

    text: str
    world: str
    tuning: bool


class Take(NamedTuple):
    """A sentence, said by a voice at a speed [words a minute]."""

    line: Line
    voice: str
    speed_wpm: int

    @property
    def held_out(self) -> bool:
        """Whether the sentence was not used for tuning."""
        return not self.line.tuning


def lines(name: str) -> list[Line]:
    """The sentences of a file; odd ones are for tuning."""
    world, found, count = "", list[Line](), 0
    for line in (HERE / f"{name}.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            world, count = line.strip("[]"), 0
        elif line and not line.startswith("#"):
            count += 1
            found.append(Line(line, world, count % 2 == 1))
    return found


def takes(name: str, voice: str, share: int) -> list[Take]:
    """One in `share` of all sentences of a voice at all speeds, spread evenly, in random order."""
    j = VOICES.index(voice)
    found = [
        Take(line, voice, speed_wpm)
        for i, line in enumerate(lines(name))
        for k, speed_wpm in enumerate(SPEEDS_WPM)
        if (i + j + k) % share == 0
    ]
    random.Random(_SEED).shuffle(found)
    return found


def vocabularies() -> dict[str, Vocabulary]:
    """The worlds that the sentences speak of: two that are shipped, and a made-up home."""
    shipped = {
        name: Knowledge(Simulation().world(name).map).vocabulary() for name in ("kitchen", "bench")
    }
    return {**shipped, "home": own.vocabulary()}


def stream(take: Take, noise: Noise, snr_db: float, seed: int) -> Samples:
    """An utterance between two pauses, in noise.

    The signal to noise ratio is that of the mean square of the speech, without its pauses, to
    that of the noise, over the whole band of 8 kHz.
    """
    said = 0.6 * spoken(take.line.text, take.voice, take.speed_wpm)
    return in_noise(np.pad(said, round(PAUSE_S * RATE_HZ)), said, noise, snr_db, seed)


def in_noise(sound: Samples, said: Samples, noise: Noise, snr_db: float, seed: int) -> Samples:
    """Sound in noise so far below what is said in it."""
    mixed = sound.astype(np.float64)
    if noise != "clean":
        frames = said[: len(said) // 320 * 320].reshape(-1, 320)
        power = np.mean(frames.astype(np.float64) ** 2, axis=1)
        level = power[power > 1e-3 * power.max()].mean() * 10 ** (-snr_db / 10.0)
        rng = np.random.default_rng(seed)
        heard = rng.normal(size=len(mixed)) if noise == "white" else _babble(len(mixed), rng)
        mixed += heard * np.sqrt(level / np.mean(heard**2))
    return np.clip(mixed, -1.0, 1.0).astype(np.float32)


def _babble(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    talk = _talk()
    begin = int(rng.integers(0, len(talk) - count))
    return talk[begin : begin + count]


@lru_cache
def _talk() -> NDArray[np.float64]:
    """Eight people who talk at once, for a minute, each as loud as the others."""
    texts = [line.text for line in lines("others") if line.tuning]
    people = [
        f"{voice}{variant}" for voice in ("en-us", "en-gb") for variant in ("", "+m5", "+f1", "+f5")
    ]
    talk = np.zeros(60 * RATE_HZ)
    for number, voice in enumerate(people):
        said = np.concatenate([spoken(text, voice, 170) for text in texts[number::2][:30]])
        talk += np.resize(said / said.std(), len(talk))
    return talk
