"""Lines about the emergency stop, however they are written: one reading for every front end.

Who decides whether a line may undo an emergency stop has to read it as whoever does it: an accent,
wide letters or a control sequence in it would else open what was closed.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

from intents.letters import bare, without_sequences

Wish = Literal["estop", "release", "reset"]
AT_THE_ROBOT = "An emergency stop is undone by somebody who stands at the robot."
AT_THE_MACHINE = "That names a file: it is for somebody at the robot's own machine."
_WORD = "estop"


class Emergency(NamedTuple):
    """A line about the emergency stop: to press it (`estop`), or to undo it in two steps.

    Attributes:
        rest: what else was said, of a line that presses it.
    """

    wish: Wish
    rest: str

    @property
    def undoes(self) -> bool:
        """Whether it is a step towards letting the robot move again."""
        return self.wish != "estop"


def plain(text: str) -> str:
    """A line in plain small letters, without what cannot be seen."""
    return bare(without_sequences(text)).strip()


def emergency(text: str) -> Emergency | None:
    """What a line says about the emergency stop; None if it says nothing about it."""
    said = plain(text)
    if not said.startswith(_WORD):
        return None
    match said.removeprefix(_WORD).strip():
        case "release" | "reset" as wish:
            return Emergency(wish, "")
        case rest:
            return Emergency("estop", rest)


def undoes(text: str) -> bool:
    """Whether a line is a step towards letting the robot move again."""
    said = emergency(text)
    return said is not None and said.undoes
