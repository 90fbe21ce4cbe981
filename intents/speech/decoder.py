# pyright: basic
# PocketSphinx has no types; this is the one file that imports it.
"""The decoder: PocketSphinx with its bundled English model, over automata and language models."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pocketsphinx
from numpy.typing import NDArray

from intents.speech.automaton import Automaton
from intents.speech.cepstra import HOP, Cepstra
from intents.speech.pronunciation import pronounce, variants
from intents.speech.rejection import Fit

MODEL = Path(pocketsphinx.get_model_path()) / "en-us" / "en-us"
OPTIONS: dict[str, Any] = {
    "hmm": str(MODEL), "featparams": str(Path(__file__).with_name("features.params")),
    "lm": None, "bestpath": False, "loglevel": "FATAL", "compallsen": True,
}  # fmt: skip
"""All senones scored, for rejection needs the best; no lattice, which loses words."""
FOR_AUTOMATA: dict[str, Any] = {
    "beam": 1e-80,
    "pbeam": 1e-80,
    "wbeam": 1e-60,
    "wip": 0.05,
    "lw": 4.0,
}
"""Wide beams, few insertions."""
FOR_MODELS: dict[str, Any] = {
    "beam": 1e-60, "pbeam": 1e-60, "wbeam": 1e-40, "wip": 0.3, "lw": 6.5, "fwdflat": False
}  # fmt: skip
"""One pass: a second over the words found, wider beams and other weights (4 to 9) gain nothing."""
SAY_OF_GRAMMAR = 8.0
"""The weight of a grammar against the sound (`create_fsg` leaves the decoder's own out)."""
ENDS = 5.0
"""How much likelier a sentence ends than that it goes on with some word."""
_UNSCALED = 1024.0
"""Scores of segments come divided by two to the tenth (SENSCR_SHIFT)."""


class Decoder:
    """Finds the words that fit an utterance best."""

    def __init__(self, options: Mapping[str, Any]) -> None:
        """Load the acoustic model and the dictionary.

        Args:
            options: `FOR_AUTOMATA` or `FOR_MODELS`.
        """
        self._decoder = pocketsphinx.Decoder(**OPTIONS, **options)

    def add_automaton(self, name: str, automaton: Automaton, usual: Mapping[str, float]) -> None:
        """Know what an automaton accepts, by a name.

        Args:
            name: for `decoded`.
            automaton: over words.
            usual: how much likelier a word is than another that may stand in its place.
        """
        self._pronounce(automaton.words)
        self._decoder.add_fsg(name, _fsg(self._decoder, name, automaton, usual))

    def add_model(self, name: str, arpa: str, words: Iterable[str]) -> None:
        """Know a language model in the ARPA form, by a name.

        Args:
            name: for `decoded`.
            arpa: the model.
            words: that occur in it.
        """
        self._pronounce(words)
        with TemporaryDirectory() as folder:
            file = Path(folder, "model.lm")
            file.write_text(arpa, encoding="utf-8")
            model = pocketsphinx.NGramModel(self._decoder.config, self._decoder.logmath, str(file))
        self._decoder.add_lm(name, model)

    def decoded(self, name: str, values: Cepstra, power: NDArray[np.float64]) -> list[Fit]:
        """The words that fit best of what is known by a name; none if nothing fits.

        Args:
            name: of an automaton or a model.
            values: centred cepstra.
            power: the mean square of each frame (`power_of`).
        """
        self._decoder.activate_search(name)
        self._decoder.start_utt()
        self._decoder.process_cep(values.astype("<f4").tobytes(), full_utt=True)
        self._decoder.end_utt()
        return self._fits(power) if self._decoder.hyp() else []

    def _fits(self, power: NDArray[np.float64]) -> list[Fit]:
        """How each word of the sentence found fits the sound; pauses and noises are left out."""
        total = max(float(power.sum()), 1e-12)
        return [
            Fit(
                word=re.sub(r"\(\d+\)$", "", segment.word),
                phones=tuple(self._decoder.lookup_word(segment.word).split()),
                begin=segment.start_frame,
                frames=segment.end_frame - segment.start_frame + 1,
                score=_UNSCALED * math.log(max(segment.ascore, 1e-300)),
                chance=_UNSCALED * math.log(max(segment.lscore, 1e-300)),
                power=float(power[segment.start_frame : segment.end_frame + 1].sum()) / total,
            )
            for segment in self._decoder.seg()
            if segment.word[0] not in "<[(+"
        ]

    def _pronounce(self, words: Iterable[str]) -> None:
        """Let the decoder know how words sound, and how else."""
        lookup = self._decoder.lookup_word
        for word in sorted(words):
            phones = lookup(word)
            if phones is None:
                phones = pronounce(word, lookup)
                self._decoder.add_word(word, phones, False)  # noqa: FBT003
            known = [phones]
            while (other := lookup(f"{word}({len(known) + 1})")) is not None:
                known.append(other)
            for other in variants(phones):
                if other not in known:
                    known.append(other)
                    self._decoder.add_word(f"{word}({len(known)})", other, False)  # noqa: FBT003


def power_of(data: bytes) -> NDArray[np.float64]:
    """The mean square of each frame of 16-bit samples."""
    samples = np.frombuffer(data, "<i2").astype(np.float64)
    return np.mean(samples[: len(samples) // HOP * HOP].reshape(-1, HOP) ** 2, axis=1)


def _fsg(decoder: Any, name: str, automaton: Automaton, usual: Mapping[str, float]) -> Any:
    """An automaton in the decoder's form: one last state, and what follows weighs one in all."""
    last = len(automaton.arcs)
    transitions: list[tuple[Any, ...]] = []
    for state, arcs in enumerate(automaton.arcs):
        weights = {word: usual.get(word, 1.0) for word in arcs}
        ends = ENDS if state in automaton.final else 0.0
        total = sum(weights.values()) + ends
        transitions += [
            (state, to, (weights[word] / total) ** SAY_OF_GRAMMAR, word)
            for word, to in arcs.items()
        ]
        if ends:
            transitions.append((state, last, (ends / total) ** SAY_OF_GRAMMAR))
    return decoder.create_fsg(name, 0, last, transitions)
