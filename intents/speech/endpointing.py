"""Where speech begins and ends in a stream of sound.

The level of each 10 ms between 200 and 3800 Hz, where voices are, is held against the level of the
background, which is the lowest of the last seconds. Speech begins when the level stands clearly
above the background for a while, and ends when it has been near it for longer: two thresholds, so
that it does not flutter.
A pause is told before it is known to be the end, so that a recogniser can begin.
"""

from __future__ import annotations

from collections import deque

import msgspec
import numpy as np

from intents.speech.audio import RATE_HZ, SILENCE_DB, Samples, decibels

FRAME = RATE_HZ // 100
"""Samples of 10 ms."""
_WINDOW = np.hanning(2 * FRAME)
_BAND = slice(200 * 2 * FRAME // RATE_HZ, 3_800 * 2 * FRAME // RATE_HZ)
"""Hum, rumble, a constant offset and hiss say nothing about speech."""
_SCALE = 2.0 / float(np.sum(_WINDOW**2)) / (2 * FRAME)


class Endpoints(msgspec.Struct, frozen=True, kw_only=True):
    """When speech begins and ends.

    Attributes:
        begin_db: above the background, that begins speech.
        end_db: above the background, below which it has ended.
        faint_db: below this level [dB of full scale] nothing is speech.
        begin_s: for so long, to begin.
        pause_s: for so long, to be told as a pause.
        end_s: for so long, to end.
        before_s: of what came before is kept.
        longest_s: then it ends whatever comes.
        memory_s: the background is the lowest level of so long.
    """

    begin_db: float = 8.0
    end_db: float = 5.0
    faint_db: float = -70.0
    begin_s: float = 0.08
    pause_s: float = 0.2
    end_s: float = 0.6
    before_s: float = 0.3
    longest_s: float = 15.0
    memory_s: float = 4.0


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
        self._set = endpoints or Endpoints()
        self._rest = np.zeros(0, np.float32)
        self._last = np.zeros(FRAME, np.float32)
        self._levels: deque[float] = deque(maxlen=_frames(self._set.memory_s))
        self._smooth: deque[float] = deque(maxlen=5)
        self._before: deque[Samples] = deque(maxlen=_frames(self._set.before_s))
        self._speech: list[Samples] = []
        self._loud = self._quiet = self._count = 0

    @property
    def speaking(self) -> bool:
        """Whether somebody speaks now."""
        return bool(self._speech)

    def push(self, sound: Samples) -> list[Utterance]:
        """What has paused or ended with this block."""
        sound = np.concatenate([self._rest, sound])
        whole = len(sound) // FRAME * FRAME
        self._rest = sound[whole:]
        ended = (self._frame(frame) for frame in sound[:whole].reshape(-1, FRAME))
        return [utterance for utterance in ended if utterance is not None]

    def flush(self) -> Utterance | None:
        """What has not ended when the stream does; everything is forgotten."""
        utterance = self._end() if self._speech else None
        self.forget()
        return utterance

    def forget(self) -> None:
        """Drop what is being said; the background stays known."""
        self._speech, self._loud, self._quiet = [], 0, 0
        self._before.clear()

    def _frame(self, frame: Samples) -> Utterance | None:
        self._count += 1
        above_db = self._above(frame)
        if not self._speech:
            self._before.append(frame)
            self._loud = self._loud + 1 if above_db > self._set.begin_db else 0
            if self._loud >= _frames(self._set.begin_s):
                self._speech = list(self._before)
                self._quiet = 0
            return None
        self._speech.append(frame)
        self._quiet = self._quiet + 1 if above_db < self._set.end_db else 0
        too_long = len(self._speech) >= _frames(self._set.longest_s)
        if too_long or self._quiet >= _frames(self._set.end_s):
            return self._end()
        return self._piece(ended=False) if self._quiet == _frames(self._set.pause_s) else None

    def _above(self, frame: Samples) -> float:
        """How far a frame is above the background [dB]."""
        spectrum = np.fft.rfft(_WINDOW * np.concatenate([self._last, frame]))[_BAND]
        self._last = frame
        self._smooth.append(_SCALE * float(np.sum(np.abs(spectrum) ** 2)))
        level_db = decibels(sum(self._smooth) / len(self._smooth))
        self._levels.append(max(level_db, SILENCE_DB))
        background_db = max(min(self._levels), self._set.faint_db - self._set.begin_db)
        return level_db - background_db

    def _end(self) -> Utterance:
        piece = self._piece(ended=True)
        self.forget()
        return piece

    def _piece(self, *, ended: bool) -> Utterance:
        return Utterance(
            sound=np.concatenate(self._speech),
            begin_s=_seconds(self._count - len(self._speech)),
            spoken_s=_seconds(self._count - self._quiet),
            ended=ended,
        )


def _seconds(frames: int) -> float:
    return frames * FRAME / RATE_HZ


def _frames(span_s: float) -> int:
    return max(1, round(span_s * RATE_HZ / FRAME))
