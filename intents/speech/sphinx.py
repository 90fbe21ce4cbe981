# pyright: basic
# PocketSphinx has no types; this is the one file that imports it.
"""The embedded recogniser: PocketSphinx with its bundled English model and a grammar.

Whatever it hears it forces onto the grammar, so every result comes with a doubt. It gets used to
the voice that speaks; to a stranger's it listens twice, used to what it heard the first time.
"""

from __future__ import annotations

import math
import re
import time
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pocketsphinx
from numpy.typing import NDArray

from intents.speech import acoustics
from intents.speech.alignment import States, aligned
from intents.speech.audio import RATE_HZ, Samples
from intents.speech.automaton import Automaton
from intents.speech.cepstra import HOP, Cepstra, centred, cepstra
from intents.speech.frontend import prepared
from intents.speech.grammar import CRY, REPLY, SPOKEN, grammar
from intents.speech.pronunciation import pronounce, variants
from intents.speech.recogniser import Heard
from intents.speech.rejection import Fit, doubt, features, mean_score
from intents.speech.speaker import MOST_KNOWN, Speaker, whose
from intents.stopping import is_stop
from intents.vocabulary import Vocabulary

MODEL = Path(pocketsphinx.get_model_path()) / "en-us" / "en-us"
OPTIONS: dict[str, Any] = {
    "hmm": str(MODEL), "featparams": str(Path(__file__).with_name("features.params")),
    "lm": None, "bestpath": False, "loglevel": "FATAL",
    "compallsen": True, "beam": 1e-80, "pbeam": 1e-80, "wbeam": 1e-60, "wip": 0.05, "lw": 4.0,
}  # fmt: skip
"""Of the decoder: all senones scored, wide beams, few insertions; no lattice, which loses words."""
USUAL = {
    "the": 15.0, "me": 80.0, "them": 0.3, "stop": 4.0, "halt": 2.0, "freeze": 2.0,
    "emergency": 2.0, "locate": 0.05, "drop": 0.1, "lead": 0.5, "both": 0.5, "everything": 0.5,
}  # fmt: skip
"""How much likelier a word is than another that may stand in its place."""
SAY_OF_GRAMMAR = 8.0
"""The weight of the grammar against the sound (`create_fsg` leaves the decoder's own out)."""
_UNSCALED = 1024.0
"""Scores of segments come divided by two to the tenth (SENSCR_SHIFT)."""
KNOWN_FRAMES = 1500
"""After so much speech a voice is known: a second look at what it says brings no more."""
SHORT_S = 1.7
"""What is no longer may be a cry to stop, whatever else it is like."""
FEW_WORDS = 2
FOR_A_CRY, FOR_ONE_WORD, FOR_MANY = 1.2, 3.0, 0.5
"""How much worse than a command a cry may fit a short utterance, to be heeded; a bare one; where
the command has more than a few words [nat/frame]: a cry is misheard as one or two words, hardly as
five that happen to fit."""
WORST_CRY = -8.5
"""How badly the words of a cry may fit [nat/frame]."""
CRY_ALONE = 0.05
"""Share of the power of an utterance that may fall on no word of a cry."""
_SHORT_BYTES = round(2 * RATE_HZ * SHORT_S)
ENDS = 5.0
"""How much likelier a sentence ends than that it goes on with some word."""


class Utterance(NamedTuple):
    """What is listened to: its centred cepstra, the mean square of each frame, and who speaks."""

    values: Cepstra
    power: NDArray[np.float64]
    speaker: Speaker


class Sphinx:
    """A recogniser for the commands of one world.

    Attributes:
        speakers: whose voices it knows, who spoke last first.
    """

    def __init__(self, vocabulary: Vocabulary, *, wake_word: str = "") -> None:
        """Load the model and compile the grammar; takes about a second."""
        self.speakers: tuple[Speaker, ...] = ()
        self._decoder = pocketsphinx.Decoder(**OPTIONS)
        self._acoustics = acoustics.load(MODEL)
        self._vocabulary = vocabulary
        self._wake_word = wake_word
        self._compiled: set[str] = set()
        self._last: tuple[Utterance, list[Fit]] | None = None
        self._search(SPOKEN)

    def recognise(self, sound: Samples, *, replying: bool = False) -> Heard:
        """The sentence of the grammar that fits an utterance best."""
        begun_s = time.perf_counter()
        self._last = None
        data = prepared(sound)
        if not data:
            return Heard(text="")
        values = centred(cepstra(data))
        speaker = whose(values, self.speakers, self._acoustics)
        heard = Utterance(values, _power(data), speaker)
        root = REPLY if replying else SPOKEN
        fits = self._decoded(heard, root, speaker) or self._decoded(heard, root, Speaker())
        short = len(data) < _SHORT_BYTES and not is_stop(_text(fits))
        cry = self._decoded(heard, CRY, speaker) if short else []
        fits = _heeded(cry, fits, replying=replying)
        if fits and speaker.frames < KNOWN_FRAMES and not is_stop(_text(fits)):
            fits = self._decoded(heard, root, self._used_to(heard, fits)) or fits
            cry = self._decoded(heard, CRY, self._used_to(heard, cry)) if cry else []
            fits = _heeded(cry, fits, replying=replying)
        self._last = (heard, fits)
        return Heard(
            text=_text(fits),
            doubt=doubt(fits) if fits else 0.0,
            took_s=time.perf_counter() - begun_s,
        )

    def learn(self) -> None:
        """Get used to the voice of the last utterance, which was a command."""
        if self._last and self._last[1]:
            heard, fits = self._last
            others = (one for one in self.speakers if one is not heard.speaker)
            self.speakers = (self._used_to(heard, fits), *others)[:MOST_KNOWN]
        self._last = None

    def _used_to(self, heard: Utterance, fits: list[Fit]) -> Speaker:
        """The speaker, after words that fit an utterance."""
        spoken = [fit.phones for fit in fits]
        states: States = aligned(heard.speaker.adapted(heard.values), spoken, self._acoustics)
        return heard.speaker.after(heard.values, states, self._acoustics)

    def _decoded(self, heard: Utterance, root: str, speaker: Speaker) -> list[Fit]:
        """The words of a speaker that fit best of what begins with a rule; none if nothing fits."""
        self._search(root)
        self._decoder.start_utt()
        values = speaker.adapted(heard.values).astype("<f4")
        self._decoder.process_cep(values.tobytes(), full_utt=True)
        self._decoder.end_utt()
        return self._fits(heard.power) if self._decoder.hyp() else []

    def _fits(self, power: NDArray[np.float64]) -> list[Fit]:
        """How each word of the sentence found fits the sound; pauses and noises are left out."""
        total = max(float(power.sum()), 1e-12)
        return [
            Fit(
                word=re.sub(r"\(\d+\)$", "", segment.word),
                phones=tuple(self._decoder.lookup_word(segment.word).split()),
                frames=segment.end_frame - segment.start_frame + 1,
                score=_UNSCALED * math.log(max(segment.ascore, 1e-300)),
                chance=_UNSCALED * math.log(max(segment.lscore, 1e-300)),
                power=float(power[segment.start_frame : segment.end_frame + 1].sum()) / total,
            )
            for segment in self._decoder.seg()
            if segment.word[0] not in "<[(+"
        ]

    def _search(self, root: str) -> None:
        """Search for what begins with a rule from now on."""
        if root not in self._compiled:
            automaton = grammar(self._vocabulary, root, wake_word=self._wake_word)
            for word in sorted(automaton.words):
                self._pronounce(word)
            self._decoder.add_fsg(root, _fsg(self._decoder, root, automaton))
            self._compiled.add(root)
        self._decoder.activate_search(root)

    def _pronounce(self, word: str) -> None:
        """Let the decoder know how a word sounds, and how else."""
        lookup = self._decoder.lookup_word
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


def _power(data: bytes) -> NDArray[np.float64]:
    """The mean square of each frame of an utterance for the decoder."""
    samples = np.frombuffer(data, "<i2").astype(np.float64)
    return np.mean(samples[: len(samples) // HOP * HOP].reshape(-1, HOP) ** 2, axis=1)


def _heeded(cry: list[Fit], fits: list[Fit], *, replying: bool) -> list[Fit]:
    """A cry in place of other words that fit, if it may be what was said."""
    other = bool(cry) and not is_stop(_text(fits))
    return cry if other and _is_cry(cry, fits, replying=replying) else fits


def _is_cry(cry: list[Fit], fits: list[Fit], *, replying: bool) -> bool:
    """Whether the words of a cry fit all of the sound, and about as well as a command."""
    seen = features(cry)
    if seen.worst < WORST_CRY or seen.unsaid > CRY_ALONE:
        return False
    if replying or len(fits) > FEW_WORDS:  # a "yes" is short, too
        margin = FOR_MANY
    else:
        margin = FOR_ONE_WORD if len(cry) == 1 else FOR_A_CRY
    return not fits or seen.mean > mean_score(fits) - margin


def _text(fits: list[Fit]) -> str:
    return " ".join(fit.word for fit in fits)


def _fsg(decoder: Any, name: str, automaton: Automaton) -> Any:
    """An automaton in the decoder's form: one last state, and what follows weighs one in all."""
    last = len(automaton.arcs)
    transitions: list[tuple[Any, ...]] = []
    for state, arcs in enumerate(automaton.arcs):
        weights = {word: USUAL.get(word, 1.0) for word in arcs}
        ends = ENDS if state in automaton.final else 0.0
        total = sum(weights.values()) + ends
        transitions += [
            (state, to, (weights[word] / total) ** SAY_OF_GRAMMAR, word)
            for word, to in arcs.items()
        ]
        if ends:
            transitions.append((state, last, (ends / total) ** SAY_OF_GRAMMAR))
    return decoder.create_fsg(name, 0, last, transitions)
