# pyright: basic
# PocketSphinx has no types; this is the one file that knows it.
"""The embedded recogniser: PocketSphinx with its bundled English model and a grammar.

Whatever it hears it forces onto the grammar, so every result comes with a doubt.
"""

from __future__ import annotations

import math
import re
import time
import warnings
from typing import Any

import pocketsphinx

from intents.speech.audio import Samples
from intents.speech.automaton import Automaton
from intents.speech.frontend import prepared
from intents.speech.grammar import REPLY, SPOKEN, grammar
from intents.speech.pronunciation import pronounce
from intents.speech.recogniser import Heard
from intents.speech.rejection import Fit, doubt
from intents.vocabulary import Vocabulary

OPTIONS: dict[str, Any] = {
    "lm": None, "bestpath": False, "loglevel": "FATAL",
    "compallsen": True, "beam": 1e-60, "pbeam": 1e-60, "wbeam": 1e-40, "wip": 0.05, "lw": 4.0,
}  # fmt: skip
"""Of the decoder: all senones scored, wide beams, few insertions; no lattice, which loses words."""
USUAL = {
    "the": 15.0, "me": 3.0, "them": 0.3, "stop": 300.0, "halt": 30.0, "freeze": 30.0,
    "emergency": 30.0,
}  # fmt: skip
"""How much likelier a word is than another that may stand in its place."""
_UNSCALED = 1024.0
"""Scores of segments come divided by two to the tenth (SENSCR_SHIFT)."""
ENDS = 5.0
"""How much likelier a sentence ends than that it goes on with some word."""


class Sphinx:
    """A recogniser for the commands of one world."""

    def __init__(self, vocabulary: Vocabulary, *, wake_word: str = "") -> None:
        """Load the model and compile the grammar; takes about a second."""
        self._decoder = pocketsphinx.Decoder(**OPTIONS)
        self._vocabulary = vocabulary
        self._wake_word = wake_word
        self._compiled: set[str] = set()
        self._search(SPOKEN)

    def recognise(self, sound: Samples, *, replying: bool = False) -> Heard:
        """The sentence of the grammar that fits an utterance best."""
        begun_s = time.perf_counter()
        data = prepared(sound)
        if not data:
            return Heard(text="")
        decoder = self._decoder
        self._search(REPLY if replying else SPOKEN)
        with warnings.catch_warnings():  # it is said to be unnecessary, and is not
            warnings.simplefilter("ignore", DeprecationWarning)
            decoder.start_stream()  # forgets the background of the utterance before
        decoder.start_utt()
        decoder.process_raw(data, full_utt=True)
        decoder.end_utt()
        fits = self._fits() if decoder.hyp() else []
        return Heard(
            text=" ".join(fit.word for fit in fits),
            doubt=doubt(fits) if fits else 0.0,
            took_s=time.perf_counter() - begun_s,
        )

    def _fits(self) -> list[Fit]:
        """How each word of the sentence found fits the sound; pauses and noises are left out."""
        return [
            Fit(
                word=re.sub(r"\(\d+\)$", "", segment.word),
                frames=segment.end_frame - segment.start_frame + 1,
                score=_UNSCALED * math.log(max(segment.ascore, 1e-300)),
                chance=_UNSCALED * math.log(max(segment.lscore, 1e-300)),
            )
            for segment in self._decoder.seg()
            if segment.word[0] not in "<[(+"
        ]

    def _search(self, root: str) -> None:
        """Search for what begins with a rule from now on."""
        if root not in self._compiled:
            automaton = grammar(self._vocabulary, root, wake_word=self._wake_word)
            for word in sorted(automaton.words):
                if self._decoder.lookup_word(word) is None:
                    phones = pronounce(word, self._decoder.lookup_word)
                    self._decoder.add_word(word, phones, False)  # noqa: FBT003
            self._decoder.add_fsg(root, _fsg(self._decoder, root, automaton))
            self._compiled.add(root)
        self._decoder.activate_search(root)


def _fsg(decoder: Any, name: str, automaton: Automaton) -> Any:
    """An automaton in the decoder's form: one last state, and what follows weighs one in all."""
    last = len(automaton.arcs)
    transitions: list[tuple[Any, ...]] = []
    for state, arcs in enumerate(automaton.arcs):
        weights = {word: USUAL.get(word, 1.0) for word in arcs}
        ends = ENDS if state in automaton.final else 0.0
        total = sum(weights.values()) + ends
        transitions += [(state, to, weights[word] / total, word) for word, to in arcs.items()]
        if ends:
            transitions.append((state, last, ends / total))
    return decoder.create_fsg(name, 0, last, transitions)
