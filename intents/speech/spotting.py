"""Cries in the midst of speech, whoever talks, and before anybody pauses.

A small network follows the stream (`intents.speech.keywords`): a cry that it is sure of counts at
once; where it thinks of none, there is none. In between the decoder is asked: the last seconds of
what is being said are written down again and again, as if cries were likely; a cry counts that fits
nearly as well as what is written down without that. It has to be found twice in the same place, for
words at the edge of what is heard may be halves of others, but where somebody pauses. What counts
as a cry is told by what people type: "stop", "no stop", "wait", but not "don't stop", "the bus
stop", "wait ten seconds".
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from intents.english.words.lexicon import words
from intents.halting import is_halt
from intents.speech.audio import Samples
from intents.speech.keywords import Keyword, Keywords
from intents.stopping import is_stay, is_stop

EVERY_S = 0.4
"""So often one listens again."""
SPAN_S = 1.8
"""To so much."""
EDGE_S = 0.1
"""What begins or ends closer to the edge of that may be cut."""
TOGETHER_S = 0.25
"""What ends so close to what was found before is the same word."""
CRYING = words(
    "stop freeze halt emergency wait don't careful hold enough watch hang no stay whoa easy look"
)
"""Words that begin cries; others are heard at the end of what is said."""
_NO_CRY_AFTER = words(
    "i we you they he she it to can't cannot and then will i'll we'll you'll they'll would could "
    "didn't don't a the not or if that's had have bus all good more very quite but of with for"
)
"""After these the same words tell something: "I don't know", "we wait", "good enough"."""
_AFTER, _MOST = 3, 5
"""So many words after a word say whether it is cried; so many in all whether it says stop."""
_BEFORE = (2, 3)
"""With so many before it."""
WORST, WORSE = -8.0, 1.6
"""How badly the first words of a cry may fit; how much worse than other words [nat/frame]."""
INSIDE = 0.6
"""The last, for a cry that ends nothing and has other words before it: there most are misheard."""
SURE, POSSIBLE = 0.99, 0.5
"""So likely for the network is a cry that counts; one that the decoder is asked about."""
ONCE_S = 1.0
"""For so long the network tells one cry once."""
_FIRST = 2
_BARE = words("wait careful enough freeze stop halt")
"""Inside a sentence one of these is cried by itself; the others with what belongs to them."""
_BELONGS = words(
    "do move touch go drop on it out up there here still back put take that stop wait not don't no "
    "step walk turn hit break fall"
)


class Written(NamedTuple):
    """A word that was heard.

    Attributes:
        word: the word.
        begin_s: since the sound began.
        end_s: the same.
        score: how well it fits [nat/frame].
        gap: how much better another word fits there [nat/frame].
    """

    word: str
    begin_s: float
    end_s: float
    score: float
    gap: float


class Writer(Protocol):
    """Writes down what was said (`intents.speech.dictation`)."""

    def cried(self, sound: Samples) -> list[Written]:
        """The words of some seconds of sound, with their places, as if cries were likely."""
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

    def __init__(self, writer: Writer, keywords: Keywords | None = None) -> None:
        """Begin.

        Args:
            writer: writes down what is said.
            keywords: the network (None: the decoder alone is heard).
        """
        self._writer = writer
        self._keywords = keywords
        self._told: Keyword | None = None
        self._before: list[Cry] = []

    def push(self, sound: Samples) -> Cry | None:
        """The cry that the network is sure of in the next block of the stream."""
        found = self._keywords.push(sound) if self._keywords is not None else []
        sure = [one for one in found if one.sure > SURE and not self._was_told(one)]
        if not sure:
            return None
        self._told = sure[0]
        return Cry(sure[0].text, sure[0].stops, sure[0].at_s)

    def _was_told(self, one: Keyword) -> bool:
        told = self._told
        return told is not None and one.at_s - told.at_s < ONCE_S and one.stops <= told.stops

    def spotted(self, sound: Samples, begin_s: float, *, whole: bool, paused: bool) -> Cry | None:
        """The first cry in the last seconds that was found the last time, too, or before a pause.

        Args:
            sound: the last seconds.
            begin_s: their place in the stream.
            whole: whether nothing was said before.
            paused: whether nothing is said after, so far.
        """
        if self._keywords is not None and self._keywords.likeliest() < POSSIBLE:
            self._before = []
            return None
        found = cries(self._writer.cried(sound), whole=whole)
        now = [cry._replace(end_s=begin_s + cry.end_s) for cry in found]
        again = [cry for cry in now if paused or self._was_found(cry)]
        self._before = now
        return again[0] if again else None

    def _was_found(self, cry: Cry) -> bool:
        return any(
            abs(cry.end_s - one.end_s) < TOGETHER_S and cry.stops == one.stops
            for one in self._before
        )


def cries(written: Sequence[Written], *, whole: bool) -> list[Cry]:
    """The cries among words, each with its place.

    Args:
        written: the words.
        whole: whether the first is the first that was said.
    """
    said, found = [one.word for one in written], list[Cry]()
    for number, one in enumerate(written):
        first = whole and number == 0
        if one.word not in CRYING or (one.begin_s < EDGE_S and not first):
            continue
        after = " ".join(said[number : number + 1 + _AFTER])
        told = number > 0 and said[number - 1] in _NO_CRY_AFTER
        stops = is_stop(after) and any(
            is_stop(" ".join(said[max(0, number - before) : number + _MOST - before]))
            for before in _BEFORE
        )
        halts = not told and (is_halt(after) or is_stay(after)) and (first or _is_whole(after))
        worse = WORSE if stops or first else INSIDE
        if (stops or halts) and _fits(written[number : number + _FIRST], worse):
            found.append(Cry(after, stops, one.end_s))
    return found


def _is_whole(cry: str) -> bool:
    """Whether a cry is one in the midst of other words, too: "don't move", not "don't women"."""
    word, _, rest = cry.partition(" ")
    return word in _BARE or rest.partition(" ")[0] in _BELONGS


def _fits(words: Sequence[Written], worse: float) -> bool:
    """Whether the first words of a cry are what was said there."""
    span_s = sum(one.end_s - one.begin_s for one in words)
    score = sum(one.score * (one.end_s - one.begin_s) for one in words) / span_s
    gap = sum(one.gap * (one.end_s - one.begin_s) for one in words) / span_s
    return score > WORST and gap < worse
