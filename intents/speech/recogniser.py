"""What a recogniser is: an utterance in, words out, and whether they are to be believed."""

from __future__ import annotations

from typing import Protocol

import msgspec

from intents.speech.audio import Samples

SURE = 0.4
"""What is less doubtful may be acted on without asking."""


class Heard(msgspec.Struct, frozen=True, kw_only=True):
    """What was heard.

    Attributes:
        text: the words; empty if there were none.
        doubt: how badly they fit the sound, 1 and more is not to be believed.
        doubtful: words among them that may have been others.
        took_s: how long the recogniser took.
    """

    text: str
    doubt: float = 0.0
    doubtful: tuple[str, ...] = ()
    took_s: float = 0.0

    @property
    def believed(self) -> bool:
        """Whether this was a command, as far as the sound tells."""
        return bool(self.text) and self.doubt < 1.0


class Recogniser(Protocol):
    """Turns utterances into words."""

    def recognise(self, sound: Samples, *, replying: bool = False) -> Heard:
        """The words of an utterance.

        Args:
            sound: one channel at 16 kHz, about one sentence.
            replying: whether a question is open, so that "yes" or "the blue one" may come.
        """
        ...

    def learn(self) -> None:
        """Get used to the voice of the last utterance, which was a command."""
        ...
