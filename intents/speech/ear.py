"""From a stream of sound to what was said: cries to stop, sentences, and what is passed over.

What was said is recognised at each pause. A cry to stop counts at once, also while the robot
itself speaks; everything else when it has clearly ended, and only if the robot was silent
meanwhile and has not just said the same itself.
"""

from __future__ import annotations

import re
from collections import deque
from typing import Literal

import msgspec

from intents.speech.audio import RATE_HZ, Samples
from intents.speech.endpointing import Endpointer, Utterance
from intents.speech.recogniser import Heard, Recogniser
from intents.stopping import is_stop

ECHO_S = 0.3
"""The room still sounds for so long after the robot has spoken."""
OWN_WORDS_S = 8.0
"""For so long, what the robot said itself is not taken from somebody else."""
CALLED_S = 6.0
"""So long after the wake word alone, a sentence needs none."""

Kind = Literal["stop", "sentence", "ignored"]
_NEVER_S = float("-inf")


class Spoken(msgspec.Struct, frozen=True, kw_only=True):
    """Something that was said.

    Attributes:
        kind: a cry to stop, a sentence for the robot, or something that it passes over.
        text: the words, without the wake word.
        why: why it is passed over.
        begin_s: where it begins in the stream.
        end_s: where its last words end.
        doubt: as in `Heard`.
        took_s: how long recognising it took.
    """

    kind: Kind
    text: str = ""
    why: str = ""
    begin_s: float = 0.0
    end_s: float = 0.0
    doubt: float = 0.0
    took_s: float = 0.0


class Ear:
    """Listens to one stream.

    Attributes:
        replying: set while a question is open: "yes" or "the blue one" may come.
    """

    def __init__(
        self,
        recogniser: Recogniser,
        *,
        endpointer: Endpointer | None = None,
        wake_word: str = "",
    ) -> None:
        """Listen.

        Args:
            recogniser: turns utterances into words.
            endpointer: cuts the stream into utterances.
            wake_word: a sentence has to begin with it; empty if none is needed.
        """
        self.replying = False
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
        found = (self._understood(one) for one in self._endpointer.push(sound))
        return [one for one in found if one is not None]

    def finish(self) -> list[Spoken]:
        """What is left when the stream, or the pressing of a key, ends."""
        last = self._endpointer.flush()
        one = self._understood(last) if last is not None else None
        return [one] if one is not None else []

    def said(self, text: str) -> None:
        """Take note of what the robot says."""
        self._own.append((self._now_s, _plain(text)))

    def _understood(self, utterance: Utterance) -> Spoken | None:
        """What an utterance is; None if it may go on, or has been heeded already."""
        if utterance.begin_s <= self._stopped_s:
            return None
        if self._early is None or self._early[0] != utterance.spoken_s:
            heard = self._recogniser.recognise(utterance.sound, replying=self.replying)
            self._early = (utterance.spoken_s, heard)
        heard = self._early[1]
        if is_stop(heard.text):
            self._stopped_s = self._now_s
        elif not utterance.ended:
            return None
        self._early = None
        kind, text, why = self._judged(heard, utterance)
        if kind == "sentence":
            self._recogniser.learn()
        return Spoken(
            kind=kind, text=text, why=why, begin_s=utterance.begin_s, end_s=utterance.spoken_s,
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
