"""Where speech begins and ends in a stream of sound.

The level of each 10 ms is held against that of the background (`intents.speech.background`). Speech
begins when it stands clearly above for a while, and ends when it has been near the background, or
far below the words so far, for longer: talk in the background never pauses, but it is not as loud.
What turns out to have been background, because it kept its level until something far louder came,
is left out. Speech that does not pause is cut where it is faintest.
A pause is told before it is known to be the end, so that a recogniser can begin.
"""

from __future__ import annotations

from collections import deque

import msgspec
import numpy as np

from intents.speech.audio import RATE_HZ, Samples
from intents.speech.background import FRAME, Background, frames, is_steady, mean_db


class Endpoints(msgspec.Struct, frozen=True, kw_only=True):
    """When speech begins and ends.

    Attributes:
        begin_db: above the background, that begins speech; above what may have been background
            only, that begins it anew.
        end_db: above the background, below which it has ended.
        below_db: below the words so far, the same.
        far_db: so far above the background nothing is background.
        faint_db: below this level [dB of full scale] nothing is speech.
        begin_s: for so long, to begin.
        pause_s: for so long, to be told as a pause.
        end_s: for so long, to end.
        before_s: of what came before is kept.
        anew_s: after so long it may begin anew.
        longest_s: then it is cut whatever comes.
        memory_s: the background is the lowest level of so long.
    """

    begin_db: float = 8.0
    end_db: float = 5.0
    below_db: float = 10.0
    far_db: float = 12.0
    faint_db: float = -70.0
    begin_s: float = 0.08
    pause_s: float = 0.2
    end_s: float = 0.6
    before_s: float = 0.3
    anew_s: float = 0.6
    longest_s: float = 15.0
    memory_s: float = 4.0


_LOUDER = 2
"""A frame that is loud again takes so many quiet ones back: a blip in the background is no word."""


class Utterance(msgspec.Struct, frozen=True, kw_only=True):
    """A piece of speech.

    Attributes:
        sound: one channel at 16 kHz.
        begin_s: its place in the stream.
        spoken_s: where its last words end in the stream.
        ended: whether that was all; else it may go on after the pause.
    """

    sound: Samples
    begin_s: float
    spoken_s: float
    ended: bool

    @property
    def end_s(self) -> float:
        """Where it ends in the stream."""
        return self.begin_s + len(self.sound) / RATE_HZ


class Endpointer:
    """Cuts a stream into utterances, as it comes."""

    def __init__(self, endpoints: Endpoints | None = None) -> None:
        """Begin with a background that is as quiet as what comes first."""
        self._set = one = endpoints or Endpoints()
        self._rest = np.zeros(0, np.float32)
        self._background = Background(one.memory_s, one.faint_db - one.begin_db)
        self._before: deque[tuple[Samples, float]] = deque(maxlen=frames(one.before_s))
        self._speech: list[tuple[Samples, float]] = []
        self._spoken_from = 0
        self._power = 0.0
        self._loud = self._quiet = self._count = 0

    @property
    def speaking(self) -> bool:
        """Whether somebody speaks now."""
        return bool(self._speech)

    @property
    def begin_s(self) -> float:
        """Where what is being said begins in the stream."""
        return _seconds(self._count - len(self._speech))

    @property
    def now_s(self) -> float:
        """Where the stream is."""
        return _seconds(self._count)

    def push(self, sound: Samples) -> list[Utterance]:
        """What has paused or ended with this block."""
        sound = np.concatenate([self._rest, sound])
        whole = len(sound) // FRAME * FRAME
        self._rest = sound[whole:]
        ended = [self._frame(frame) for frame in sound[:whole].reshape(-1, FRAME)]
        return [utterance for utterance in ended if utterance is not None]

    def last(self, span_s: float) -> Utterance | None:
        """The last seconds of what is being said; None if nobody speaks."""
        speech = self._speech[-frames(span_s) :]
        if not speech or self._is_background(len(speech)):
            return None
        return self._piece(speech, quiet=self._quiet, ended=False)

    def flush(self) -> Utterance | None:
        """What has not ended when the stream does; everything is forgotten."""
        voiced = self._speech and not self._is_background(len(self._speech))
        utterance = self._end() if voiced else None
        self.forget()
        return utterance

    def forget(self) -> None:
        """Drop what is being said; the background stays known."""
        self._speech, self._loud, self._quiet = [], 0, 0
        self._before.clear()

    def _frame(self, frame: Samples) -> Utterance | None:
        self._count += 1
        above_db = self._background.above_db(frame)
        heard = (frame, self._background.level_db)
        if not self._speech:
            self._before.append(heard)
            self._loud = self._loud + 1 if above_db > self._set.begin_db else 0
            if self._loud >= frames(self._set.begin_s):
                self._begin(list(self._before))
            return None
        words_db = self._words_db
        below = above_db < self._set.end_db or heard[1] < words_db - self._set.below_db
        self._quiet = self._quiet + 1 if below else max(0, self._quiet - _LOUDER)
        self._speech.append(heard)
        self._power += 10.0 ** (heard[1] / 10.0)
        self._begin_anew(words_db)
        ends = self._quiet >= frames(self._set.end_s)
        paused = below and self._quiet == frames(self._set.pause_s)
        too_long = len(self._speech) >= frames(self._set.longest_s)
        if (ends or paused or too_long) and self._is_background(len(self._speech)):
            self._background.take(self._words_db)
            self.forget()
        elif ends:
            return self._end()
        elif too_long:
            return self._cut()
        elif paused:
            return self._piece(self._speech, quiet=self._quiet, ended=False)
        return None

    def _is_background(self, count: int) -> bool:
        """Whether the last frames, but for a pause after them, swing too little for a voice.

        What is far louder than the background is none: a cry may be one long vowel.
        """
        begin = max(self._spoken_from, len(self._speech) - count)
        levels_db = [level_db for _, level_db in self._speech[begin : -self._quiet or None]]
        near = self._words_db < self._background.floor_db + self._set.far_db
        return near and len(levels_db) >= frames(self._set.anew_s) and is_steady(levels_db)

    @property
    def _words_db(self) -> float:
        """The level of the words so far."""
        return float(10.0 * np.log10(self._power / (len(self._speech) - self._spoken_from)))

    def _begin(self, speech: list[tuple[Samples, float]]) -> None:
        """Take what was heard last for the beginning of speech."""
        self._speech, self._quiet = speech, 0
        self._spoken_from = max(0, len(speech) - frames(self._set.begin_s))
        self._power = sum(10.0 ** (level_db / 10.0) for _, level_db in speech[self._spoken_from :])

    def _begin_anew(self, words_db: float) -> None:
        """Leave out what was no speech, if this is so much louder."""
        loud = frames(self._set.begin_s)
        if len(self._speech) - self._spoken_from < frames(self._set.anew_s):
            return
        if min(level_db for _, level_db in self._speech[-loud:]) <= words_db + self._set.begin_db:
            return
        before_db = [level_db for _, level_db in self._speech[self._spoken_from : -loud]]
        if is_steady(before_db):
            self._background.take(mean_db(before_db))
            self._begin(self._speech[-frames(self._set.before_s) - loud :])

    def _cut(self) -> Utterance:
        """End where it was faintest in the last half; the rest is the beginning of what follows."""
        half = len(self._speech) // 2
        at = half + int(np.argmin([level_db for _, level_db in self._speech[half:]])) + 1
        rest = self._speech[at:]
        self._speech, count = self._speech[:at], self._count
        self._count, self._quiet = count - len(rest), 0
        piece = self._end()
        self._count = count
        if rest:
            self._begin(rest)
        return piece

    def _end(self) -> Utterance:
        piece = self._piece(self._speech, quiet=self._quiet, ended=True)
        self.forget()
        return piece

    def _piece(self, speech: list[tuple[Samples, float]], *, quiet: int, ended: bool) -> Utterance:
        return Utterance(
            sound=np.concatenate([frame for frame, _ in speech]),
            begin_s=_seconds(self._count - len(speech)),
            spoken_s=_seconds(self._count - quiet),
            ended=ended,
        )


def _seconds(count: int) -> float:
    return count * FRAME / RATE_HZ
