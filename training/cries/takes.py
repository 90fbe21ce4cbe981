"""What is said, spoken by many synthesised voices, with the place of the word that cries."""

from __future__ import annotations

import random
import re
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.speech.voices import spoken
from intents.speech.audio import RATE_HZ
from intents.speech.keywords import KEYWORDS
from training.cries.sentences import Said

LANGUAGES = ("en-us", "en-us", "en-us", "en-gb", "en-gb", "en-gb-x-rp", "en-gb-scotland",
             "en-us-nyc", "en-gb-x-gbclan", "en-gb-x-gbcwmd")  # fmt: skip
VARIANTS = (
    "", "", "+m1", "+m2", "+m4", "+m5", "+m6", "+m7", "+m8", "+f2", "+f2", "+f3", "+f3", "+f5",
    "+f5", "+Alex", "+Alicia", "+Andrea", "+Andy", "+Annie", "+Denis", "+Gene", "+Jacky", "+Lee",
    "+Marco", "+Mario", "+Michael", "+Mike", "+Storm", "+adam", "+anika", "+antonio", "+aunty",
    "+belinda", "+benjamin", "+boris", "+caleb", "+david", "+ed", "+edward", "+grandma", "+grandpa",
    "+gustave", "+iven", "+iven3", "+john", "+linda", "+max", "+michel", "+miguel", "+norbert",
    "+pablo", "+paul", "+pedro", "+quincy", "+rob", "+robert", "+sandro", "+shelby", "+steph",
    "+steph3", "+travis", "+victor", "+zac", "+klatt2", "+klatt4", "+robosoft5",
)  # fmt: skip
"""Of espeak-ng, none of those held out for measuring (f1, f4, m3, en-029)."""
OTHERS = ("flite:rms", "flite:rms", "flite:kal16", "flite:kal")
OTHERS_SHARE = 0.4
_PAIRS = (("hold", "hang", "look", "watch"), 1)
"""Words that cry with the next one: look out, hang on."""
LOUDEST = 20_000
"""The loudest sample of each take."""
_LOUD = 0.02
_AT_ONCE = 4


class Spoken(NamedTuple):
    """A take.

    Attributes:
        sound: 16-bit samples at 16 kHz, from the first word to the last.
        keyword: its number in `KEYWORDS`; -1 if nothing is cried.
        begin_s: where the first keyword of any kind may begin in it.
        end_s: about where the word that cries ends in it.
    """

    sound: NDArray[np.int16]
    keyword: int = -1
    begin_s: float = 0.0
    end_s: float = 0.0


def takes(said: Iterable[Said], rng: random.Random) -> Iterator[Spoken]:
    """Each text by some voice."""
    asked = [(one, _voice(rng), rng.randint(120, 230), rng.randint(15, 90)) for one in said]
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        yield from (one for one in pool.map(lambda each: _take(*each), asked) if one is not None)


def _voice(rng: random.Random) -> str:
    if rng.random() < OTHERS_SHARE:
        return rng.choice(OTHERS)
    return rng.choice(LANGUAGES) + rng.choice(VARIANTS)


def _take(said: Said, voice: str, speed_wpm: int, pitch: int) -> Spoken | None:
    sound = spoken(said.text, voice, speed_wpm, pitch=pitch)
    loud = np.flatnonzero(np.abs(sound) > _LOUD * np.abs(sound).max(initial=1e-9))
    if len(loud) < RATE_HZ // 20:
        return None
    sound = sound[loud[0] : loud[-1] + 1]
    whole = (sound * (LOUDEST / np.abs(sound).max())).astype(np.int16)
    if said.cries_at is None:
        return Spoken(whole)
    words = said.text.split()
    word = words[said.cries_at]
    first = next(n for n, one in enumerate(words) if one in KEYWORDS)
    last = said.cries_at + (word in _PAIRS[0] and said.cries_at + 1 < len(words))
    lengths = np.cumsum([0.0, *(_length(one) for one in words)])
    places = lengths / lengths[-1] * len(sound) / RATE_HZ
    return Spoken(whole, KEYWORDS.index(word), float(places[first]), float(places[last + 1]))


def _length(word: str) -> float:
    """About how long it takes to say: vowels are twice as long as other sounds."""
    vowels = len(re.findall(r"[aeiouy]+", word))
    return 2.0 * vowels + len(re.findall(r"[^aeiouy']+", word)) + 0.5
