"""Cries in the midst of speech, whoever talks, and before anybody pauses.

The last seconds of what is being said are written down again and again; a cry counts when it was
found twice in the same place, for words at the edge of what is heard may be halves of others. What
counts as a cry is told by what people type: "stop", "no stop", "wait", "don't do that", but not
"don't stop", "the bus stop", "wait ten seconds".
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from intents.english.words.lexicon import words
from intents.halting import is_halt
from intents.speech.audio import Samples
from intents.stopping import is_stay, is_stop

EVERY_S = 0.4
"""So often one listens again."""
SPAN_S = 1.8
"""To so much."""
EDGE_S = 0.1
"""What begins or ends closer to the edge of that may be cut."""
TOGETHER_S = 0.25
"""What ends so close to what was found before is the same word."""
_CRIES = words(
    "stop freeze halt emergency wait don't careful hold enough watch hang no stay whoa easy look"
)
"""Words that begin cries; others are heard at the end of what is said."""
_NO_CRY_AFTER = words(
    "i we you they he she it to can't cannot and then will i'll we'll you'll they'll would could "
    "didn't don't a the not or if that's had have bus all good more very quite but of with for"
)
"""After these the same words tell something: "I don't know", "we wait", "good enough"."""
_BEFORE, _AFTER = 2, 3
"""Words on either side that say whether a word is cried."""


class Written(NamedTuple):
    """A word that was heard.

    Attributes:
        word: the word.
        begin_s: since the sound began.
        end_s: the same.
        score: how well it fits [nat/frame].
    """

    word: str
    begin_s: float
    end_s: float
    score: float


class Writer(Protocol):
    """Writes down what was said (`intents.speech.dictation`)."""

    def written(self, sound: Samples) -> list[Written]:
        """The words of some seconds of sound, with their places."""
        ...


class Cry(NamedTuple):
    """A cry.

    Attributes:
        text: its words.
        stops: whether it ends what is under way; else it halts it.
        end_s: where its first word ends in the stream.
    """

    text: str
    stops: bool
    end_s: float


class Spotter:
    """Spots cries in one stream."""

    def __init__(self, writer: Writer) -> None:
        """Begin; `writer` writes down what is said."""
        self._writer = writer
        self._before: list[Cry] = []

    def spotted(self, sound: Samples, begin_s: float, *, whole: bool) -> Cry | None:
        """The first cry in the last seconds that was found the last time, too.

        Args:
            sound: the last seconds.
            begin_s: their place in the stream.
            whole: whether nothing was said before.
        """
        found = cries(self._writer.written(sound), whole=whole)
        now = [cry._replace(end_s=begin_s + cry.end_s) for cry in found]
        again = [
            cry
            for cry in now
            if any(
                abs(cry.end_s - one.end_s) < TOGETHER_S and cry.stops == one.stops
                for one in self._before
            )
        ]
        self._before = now
        return again[0] if again else None


def cries(written: Sequence[Written], *, whole: bool) -> list[Cry]:
    """The cries among words, each with its place.

    Args:
        written: the words.
        whole: whether the first is the first that was said.
    """
    said, found = [one.word for one in written], list[Cry]()
    for number, one in enumerate(written):
        first = whole and number == 0
        if one.word not in _CRIES or (one.begin_s < EDGE_S and not first):
            continue
        after = " ".join(said[number : number + 1 + _AFTER])
        around = " ".join(said[max(0, number - _BEFORE) : number + 1 + _AFTER])
        told = number > 0 and said[number - 1] in _NO_CRY_AFTER
        stops = is_stop(around) and is_stop(after)
        if stops or (not told and (is_halt(after) or is_stay(after))):
            found.append(Cry(after, stops, one.end_s))
    return found
