"""Lines about the emergency stop, however they are written: one reading for every front end.

Who decides whether a line may undo an emergency stop has to read it as whoever does it: an accent,
wide letters or a control sequence in it would else open what was closed.
"""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

from intents.english.words.lexicon import words
from intents.letters import bare, without_sequences

Wish = Literal["estop", "release", "reset"]
AT_THE_ROBOT = "An emergency stop is undone by somebody who stands at the robot."
AT_THE_MACHINE = "That names a file: it is for somebody at the robot's own machine."
_WORD = "estop"
_NAMES = (("estop",), ("e", "stop"), ("emergency", "stop"), ("emergencystop",))
_AROUND = words(
    "please robot now quick quickly hey hit press push pull use do make trigger engage activate "
    "the an a that this red button right at once immediately stop halt everybody everything"
)
"""What may stand around its name in a line that wants it pressed, and nothing else."""
_MOST_WORDS = 12
_SPOKEN = re.compile(r"[^\W_]+")


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
        return Emergency("estop", "") if _is_named(said) else None
    match said.removeprefix(_WORD).strip():
        case "release" | "reset" as wish:
            return Emergency(wish, "")
        case rest:
            return Emergency("estop", rest)


def _is_named(said: str) -> bool:
    """Whether a line names it, as the button of the page is called, and says nothing else.

    One that is a plain stop to all others would let the robot go on with the next wish, where
    somebody wants that nothing moves any more.
    """
    said_words = _SPOKEN.findall(said[:200])
    if len(said) > 200 or len(said_words) > _MOST_WORDS or "?" in said:
        return False
    named = False
    while said_words:
        name = next((one for one in _NAMES if tuple(said_words[: len(one)]) == one), None)
        if name is None and said_words[0] not in _AROUND:
            return False
        named = named or name is not None
        del said_words[: len(name) if name is not None else 1]
    return named


def undoes(text: str) -> bool:
    """Whether a line is a step towards letting the robot move again."""
    said = emergency(text)
    return said is not None and said.undoes
