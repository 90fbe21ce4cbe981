"""What people are told: lines on the screen, answers aloud as well, and what is refused."""

from __future__ import annotations

from collections.abc import Callable

from executive.frontends.speaking import Speech

Out = Callable[[str], None]
MOST_TOLD = 200
"""Letters of a line that comes to nothing: people know what they typed."""


class Answering:
    """Says things to people.

    Attributes:
        out: says a line to people; another one while pages show them too.
        speech: says aloud what is answered.
        refused: how many lines led to nothing, because they could not be meant.
        asked_back: how many were asked back about, be it with the words of the question before.
    """

    def __init__(self, out: Out, speech: Speech | None = None) -> None:
        """Nothing was said yet."""
        self.out = out
        self.speech = speech or Speech()
        self.refused = self.asked_back = 0

    def answer(self, text: str) -> None:
        """Say a line to people, and aloud."""
        self.out(text)
        self.speech.say(text)

    def ask_back(self, question: str) -> None:
        """Ask what a line means, or ask again."""
        self.asked_back += 1
        self.answer(question)

    def refuse(self, why: str, cure: str = "") -> None:
        """Say why a line leads to nothing, and what would."""
        self.refused += 1
        self.answer(why)
        if cure:
            self.out(f"  {cure}")

    def refuse_stopped(self, text: str) -> None:
        """Say that a line comes to nothing because there was a stop after it."""
        told = text if len(text) <= MOST_TOLD else f"{text[:MOST_TOLD]} ..."
        self.refuse(f"Not done: “{told}” was there when you said stop")
