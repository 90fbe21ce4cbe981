"""From a stream of sound to what was said: cries to stop, sentences, and what is passed over.

What was said is recognised at each pause. A cry to stop counts at once, also while the robot
itself speaks; everything else when it has clearly ended, and only if the robot was silent
meanwhile and has not just said the same itself. Of a robot at work cries are heard before
anybody pauses, too, and those that it halts for ("wait", "careful") besides those to stop.
"""

from __future__ import annotations

import re
from collections import deque
from typing import Literal

import msgspec

from intents.halting import is_halt
from intents.speech.audio import RATE_HZ, Samples
from intents.speech.endpointing import Endpointer, Utterance
from intents.speech.recogniser import SURE, Heard, Recogniser
from intents.speech.spotting import EVERY_S, SPAN_S, Cry, Spotter
from intents.stopping import is_stay, is_stop

ECHO_S = 0.3
"""The room still sounds for so long after the robot has spoken."""
OWN_WORDS_S = 8.0
"""For so long, what the robot said itself is not taken from somebody else."""
CALLED_S = 6.0
"""So long after the wake word alone, a sentence needs none."""

Kind = Literal["stop", "halt", "halted", "sentence", "ignored"]
_NEVER_S = float("-inf")


class Spoken(msgspec.Struct, frozen=True, kw_only=True):
    """Something that was said.

    Attributes:
        kind: a cry to stop, a cry that a robot at work halts for (what was said follows when it
            has ended), the end of one with which nothing that was said agrees (it is asked about,
            and nothing is done for it), a sentence for the robot, or what it passes over.
        text: the words, without the wake word.
        why: why it is passed over.
        begin_s: where it begins in the stream.
        end_s: where its last words end.
        doubt: as in `Heard`.
        doubtful: as in `Heard`.
        took_s: how long recognising it took.
    """

    kind: Kind
    text: str = ""
    why: str = ""
    begin_s: float = 0.0
    end_s: float = 0.0
    doubt: float = 0.0
    doubtful: tuple[str, ...] = ()
    took_s: float = 0.0

    @property
    def sure(self) -> bool:
        """Whether it may be acted on without asking."""
        return self.doubt < SURE


class Ear:
    """Listens to one stream.

    Attributes:
        replying: set while a question is open: "yes" or "the blue one" may come.
        at_work: whether there is something to halt.
    """

    def __init__(
        self,
        recogniser: Recogniser,
        *,
        endpointer: Endpointer | None = None,
        spotter: Spotter | None = None,
        wake_word: str = "",
    ) -> None:
        """Listen.

        Args:
            recogniser: turns utterances into words.
            endpointer: cuts the stream into utterances.
            spotter: spots cries before anybody pauses (None: nothing does).
            wake_word: a sentence has to begin with it; empty if none is needed.
        """
        self.replying = False
        self.at_work = True
        self._spotter = spotter
        self._spotted_s = _NEVER_S
        self._halted: Cry | None = None
        self._recogniser = recogniser
        self._endpointer = endpointer or Endpointer()
        self._wake = _plain(wake_word)
        self._now_s = 0.0
        self._called_s = self._deaf_until_s = self._stopped_s = _NEVER_S
        self._early: tuple[float, Heard] | None = None
        self._own: deque[tuple[float, str]] = deque(maxlen=20)

    def push(self, sound: Samples, *, speaking: bool = False, heeded: bool = True) -> list[Spoken]:
        """What was said up to this block.

        Args:
            sound: the next block of the stream.
            speaking: whether the robot spoke while it was recorded.
            heeded: whether sentences count; cries to stop always do.
        """
        self._now_s += len(sound) / RATE_HZ
        if speaking:
            self._deaf_until_s = self._now_s + ECHO_S
        elif not heeded:
            self._deaf_until_s = self._now_s
        found: list[Spoken | None] = []
        step = round(EVERY_S * RATE_HZ)
        for at in range(0, len(sound), step):
            pieces = self._endpointer.push(sound[at : at + step])
            paused = any(not one.ended for one in pieces)
            found.append(self._cried(sound[at : at + step], speaking=speaking, paused=paused))
            found += [self._understood(one) for one in pieces]
        return [one for one in found if one is not None]

    def finish(self) -> list[Spoken]:
        """What is left when the stream, or the pressing of a key, ends."""
        last = self._endpointer.flush()
        one = self._understood(last) if last is not None else None
        return [one] if one is not None else []

    def said(self, text: str) -> None:
        """Take note of what the robot says."""
        self._own.append((self._now_s, _plain(text)))

    def _cried(self, sound: Samples, *, speaking: bool, paused: bool) -> Spoken | None:
        """A cry in what is being said; None if there is none, or it has been heeded already."""
        if self._spotter is None:
            return None
        sure = self._spotter.push(sound)
        last = self._endpointer.last(SPAN_S)
        begin_s = self._endpointer.begin_s
        if not (self.at_work or speaking) or begin_s <= self._stopped_s:
            return None
        cry = sure
        if cry is None and last is not None:
            cry = self._written(last, paused=paused)
        if cry is None:
            return None
        if cry.stops:
            self._stopped_s = self._endpointer.now_s
        elif last is not None and self._may_halt(begin_s, speaking=speaking):
            self._halted = cry
        else:
            return None
        kind = "stop" if cry.stops else "halt"
        return Spoken(kind=kind, text=cry.text, begin_s=begin_s, end_s=cry.end_s)

    def _may_halt(self, begin_s: float, *, speaking: bool) -> bool:
        """Whether a cry to halt counts; "no" may answer a question, and one halt is enough."""
        deaf = speaking or begin_s < self._deaf_until_s
        return not (deaf or self.replying or self._halted)

    def _written(self, last: Utterance, *, paused: bool) -> Cry | None:
        """A cry that the decoder finds in the last seconds of what is being said."""
        if self._spotter is None or (last.end_s - self._spotted_s < EVERY_S and not paused):
            return None
        self._spotted_s = last.end_s
        whole = last.begin_s == self._endpointer.begin_s
        return self._spotter.spotted(last.sound, last.begin_s, whole=whole, paused=paused)

    def _understood(self, utterance: Utterance) -> Spoken | None:
        """What an utterance is; None if it may go on, or has been heeded already."""
        if utterance.begin_s <= self._stopped_s:
            self._halted = None
            return None
        if self._early is None or self._early[0] != utterance.spoken_s:
            heard = self._recogniser.recognise(utterance.sound, replying=self.replying)
            self._early = (utterance.spoken_s, heard)
        heard = self._early[1]
        stops = is_stop(heard.text)
        if stops:
            self._stopped_s = self._now_s
        elif not utterance.ended:
            return self._halting(heard, utterance)
        self._early = None
        halted, self._halted = self._halted, None
        kind, text, why = self._judged(heard, utterance)
        if halted is not None and (kind == "ignored" or not (is_halt(text) or is_stay(text))):
            heard = Heard(text=halted.text, took_s=heard.took_s)
            kind, text, why = "halted", halted.text, ""
        elif kind == "sentence":
            self._recogniser.learn()
        return Spoken(
            kind=kind, text=text, why=why, begin_s=utterance.begin_s, end_s=utterance.spoken_s,
            doubt=heard.doubt, doubtful=heard.doubtful, took_s=heard.took_s,
        )  # fmt: skip

    def _halting(self, heard: Heard, utterance: Utterance) -> Spoken | None:
        """A cry to halt that is heeded at the first pause; what it means is told at the end."""
        if self._halted is not None or not self.at_work or self.replying:
            return None
        kind, text, _ = self._judged(heard, utterance)
        if kind != "sentence" or not (is_halt(text) or is_stay(text)):
            return None
        self._halted = Cry(text, stops=False, end_s=utterance.spoken_s)
        return Spoken(
            kind="halt", text=text, begin_s=utterance.begin_s, end_s=utterance.spoken_s,
            doubt=heard.doubt, took_s=heard.took_s,
        )  # fmt: skip

    def _judged(self, heard: Heard, utterance: Utterance) -> tuple[Kind, str, str]:
        text = heard.text.strip()
        if is_stop(text):
            return "stop", text, ""
        if utterance.begin_s < self._deaf_until_s:
            return "ignored", text, "the robot did not listen then"
        if not heard.believed:
            return "ignored", text, "it does not sound like a command" if text else "no words"
        if self._is_own(text):
            return "ignored", text, "the robot said that itself"
        called, text = self._called(text, utterance)
        if not called:
            return "ignored", text, f"it does not begin with “{self._wake}”"
        return ("sentence", text, "") if text else ("ignored", self._wake, "it waits for more")

    def _called(self, text: str, utterance: Utterance) -> tuple[bool, str]:
        """Whether the robot is meant, and the words without the wake word."""
        if not self._wake:
            return True, text
        words = _plain(text)
        if words.startswith(self._wake):
            rest = words[len(self._wake) :].strip()
            self._called_s = utterance.spoken_s if not rest else _NEVER_S
            return True, rest
        recently = utterance.begin_s - self._called_s < CALLED_S
        return recently or self.replying, text

    def _is_own(self, text: str) -> bool:
        plain = _plain(text)
        lately = (own for at_s, own in self._own if self._now_s - at_s < OWN_WORDS_S)
        return len(plain.split()) > 1 and any(plain in own for own in lately)


def _plain(text: str) -> str:
    return " ".join(re.findall(r"[\w']+", text.lower()))
