"""Words that follow no grammar: whatever people say, likeliest what they say of a world.

The language model is counted in sentences that `wordings.jsgf` and `commands.jsgf` make up with the
names of a vocabulary; any other common word of English may stand between them, so that other
speech is heard as other words.
"""

from __future__ import annotations

import importlib.resources
import random

import numpy as np
from numpy.typing import NDArray

from intents.speech.audio import RATE_HZ, Samples
from intents.speech.cepstra import HOP, Cepstra, centred, cepstra
from intents.speech.decoder import FOR_MODELS, Decoder, power_of
from intents.speech.frontend import prepared_from
from intents.speech.grammar import rules
from intents.speech.ngrams import arpa, sentence
from intents.speech.rejection import Fit
from intents.speech.spotting import CRYING, Written
from intents.vocabulary import Vocabulary

SENTENCES = 12_000
"""So many are made up; twice as many bring no more."""
OTHER_WORDS = 0.15
"""How likely a word is none of those that the sentences would have there."""
CRIES = 4_000
"""So many are made up for the other model, in which cries are likelier than anything else."""
_NAME, _CRIED = "wording", "cried"
_SEED = 1


class Dictation:
    """Writes down what is said in one world."""

    def __init__(self, vocabulary: Vocabulary, *, wake_word: str = "") -> None:
        """Make the language model; takes about a second."""
        made = rules(vocabulary, "wordings.jsgf", wake_word=wake_word)
        self._decoder = Decoder(FOR_MODELS)
        others = common_words()
        for name, count in ((_NAME, SENTENCES), (_CRIED, CRIES)):
            rng = random.Random(_SEED)
            sentences = [sentence(made, name, rng) for _ in range(count)]
            words = {word for one in sentences for word in one}.union(others)
            self._decoder.add_model(name, arpa(sentences, others, OTHER_WORDS), words)

    def words(self, values: Cepstra, power: NDArray[np.float64]) -> list[Fit]:
        """The words of an utterance: its centred cepstra, and the mean square of each frame."""
        return self._decoder.decoded(_NAME, values, power)

    def cried(self, sound: Samples) -> list[Written]:
        """The words of some seconds of sound, by whomever, with cries wherever they may be."""
        data, begin_s = prepared_from(sound)
        if not data:
            return []
        values, power = centred(cepstra(data)), power_of(data)
        found = self._decoder.decoded(_CRIED, values, power)
        if not any(fit.word in CRYING for fit in found):
            return []
        free = self.words(values, power)
        return [
            Written(
                fit.word,
                begin_s + fit.begin * HOP / RATE_HZ,
                begin_s + (fit.begin + fit.frames) * HOP / RATE_HZ,
                fit.score / fit.frames,
                _score_there(free, fit) - fit.score / fit.frames,
            )
            for fit in found
        ]


def _score_there(fits: list[Fit], there: Fit) -> float:
    """How well words fit where another one was found [nat/frame]; nothing fits if there is none."""
    end, total, count = there.begin + there.frames, 0.0, 0
    for fit in fits:
        both = min(end, fit.begin + fit.frames) - max(there.begin, fit.begin)
        if both > 0:
            total, count = total + both * fit.score / fit.frames, count + both
    return total / count if count else 0.0


def common_words() -> dict[str, float]:
    """Common words of English, and how often each is said: after Zipf, by their order."""
    source = importlib.resources.files("intents.speech").joinpath("common_words.txt")
    text = source.read_text(encoding="utf-8")
    found = [word for line in text.splitlines() if line[0] != "#" for word in line.split()]
    return {word: 1.0 / (rank + 3.0) for rank, word in enumerate(found)}
