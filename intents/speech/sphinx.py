"""The embedded recogniser: PocketSphinx with a grammar, and beside it with a language model.

The grammar forces whatever it hears onto a command, so its words count only where they fit about as
well as free ones do; else the free words are what was said. Either comes with a doubt. It gets used
to the voice that speaks; to a stranger's it listens twice, used to what it heard the first time.
"""

from __future__ import annotations

import time
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from intents.speech import acoustics
from intents.speech.alignment import States, aligned
from intents.speech.audio import RATE_HZ, Samples
from intents.speech.cepstra import Cepstra, centred, cepstra
from intents.speech.choosing import Found, chosen
from intents.speech.decoder import FOR_AUTOMATA, MODEL, Decoder, power_of
from intents.speech.dictation import Dictation
from intents.speech.frontend import prepared
from intents.speech.grammar import CRY, REPLY, SPOKEN, grammar
from intents.speech.recogniser import Heard
from intents.speech.rejection import Fit
from intents.speech.speaker import MOST_KNOWN, Speaker, whose
from intents.stopping import is_stop
from intents.vocabulary import Vocabulary

USUAL = {
    "the": 15.0, "me": 80.0, "them": 0.3, "stop": 4.0, "halt": 2.0, "freeze": 2.0,
    "emergency": 2.0, "locate": 0.05, "drop": 0.1, "lead": 0.5, "both": 0.5, "everything": 0.5,
}  # fmt: skip
"""How much likelier a word is in a command than another that may stand in its place."""
KNOWN_FRAMES = 1500
"""After so much speech a voice is known: a second look at what it says brings no more."""
SHORT_S = 1.7
"""What is no longer may be a cry to stop, whatever else it is like."""
_SHORT_BYTES = round(2 * RATE_HZ * SHORT_S)


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

    def __init__(
        self, vocabulary: Vocabulary, *, wake_word: str = "", dictation: Dictation | None = None
    ) -> None:
        """Load the model and compile the grammar; takes about two seconds.

        Args:
            vocabulary: the names of the world.
            wake_word: as for `Ear`.
            dictation: hears free words of that world (None: one is made).
        """
        self.speakers: tuple[Speaker, ...] = ()
        self._decoder = Decoder(FOR_AUTOMATA)
        self._dictation = dictation or Dictation(vocabulary, wake_word=wake_word)
        self._acoustics = acoustics.load(MODEL)
        self._vocabulary = vocabulary
        self._wake_word = wake_word
        self._compiled: set[str] = set()
        self._last: tuple[Utterance, list[Fit]] | None = None
        self._compile(SPOKEN)

    def recognise(self, sound: Samples, *, replying: bool = False) -> Heard:
        """The words that fit an utterance best: of a command, if one fits well, else free ones."""
        begun_s = time.perf_counter()
        self._last = None
        data = prepared(sound)
        if not data:
            return Heard(text="")
        values = centred(cepstra(data))
        speaker = whose(values, self.speakers, self._acoustics)
        heard = Utterance(values, power_of(data), speaker)
        root = REPLY if replying else SPOKEN
        short = len(data) < _SHORT_BYTES
        found = self._found(heard, root, speaker, short=short)
        choice = chosen(found, self._vocabulary, replying=replying)
        if choice.fits and speaker.frames < KNOWN_FRAMES and not is_stop(choice.text):
            used = self._used_to(heard, choice.fits)
            found = self._found(heard, root, used, short=short)
            choice = chosen(found, self._vocabulary, replying=replying)
        self._last = (heard, choice.fits)
        return Heard(
            text=choice.text, doubt=choice.doubt, doubtful=choice.doubtful,
            took_s=time.perf_counter() - begun_s,
        )  # fmt: skip

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

    def _found(self, heard: Utterance, root: str, speaker: Speaker, *, short: bool) -> Found:
        """What a speaker may have said: by a rule, in free words, or as a cry if it is short."""
        values = speaker.adapted(heard.values)
        return Found(
            command=self._decoded(root, values, heard.power),
            free=self._dictation.words(values, heard.power),
            cry=self._decoded(CRY, values, heard.power) if short else [],
        )

    def _decoded(self, root: str, values: Cepstra, power: NDArray[np.float64]) -> list[Fit]:
        """The words that fit best of what begins with a rule; none if nothing fits."""
        self._compile(root)
        return self._decoder.decoded(root, values, power)

    def _compile(self, root: str) -> None:
        """Know what begins with a rule."""
        if root not in self._compiled:
            automaton = grammar(self._vocabulary, root, wake_word=self._wake_word)
            self._decoder.add_automaton(root, automaton, USUAL)
            self._compiled.add(root)
