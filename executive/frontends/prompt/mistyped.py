"""Lines that are nearly a command: what was meant is asked, rather than a robot set going.

`move 3 1` is what follows `goals`, and would be a walk to (3, 1); `cancle 2` would be read as a
wish to end whatever is under way.
"""

from __future__ import annotations

from collections.abc import Mapping

from rapidfuzz.distance import OSA

from executive.frontends.prompt.command import Command

_WORDS = frozenset({"quiet", "three", "free"})
"""A letter away from a command, and said by themselves."""
_COURTESY = frozenset({"please", "now", "robot", "thanks", "then", "again"})


def meant(text: str, commands: Mapping[str, Command]) -> str:
    """The command that a line was probably meant to be; empty if it is none of them by a slip."""
    first, _, rest = text.casefold().partition(" ")
    rest = " ".join(rest.split())
    for command in commands.values():
        if not rest and first not in _WORDS and _slipped(first, command) and command.accepts(""):
            return command.name
        if command.loose or first == command.name:
            continue
        if first in command.choices() and _is_argument(rest) and command.accepts(text.casefold()):
            return f"{command.name} {first} {rest}".strip()
        if rest and _slipped(first, command) and command.accepts(rest):
            return f"{command.name} {rest}"
    return ""


def polite(rest: str) -> bool:
    """Whether what follows a command's name only is politeness: "exit please" is no walk."""
    words = rest.casefold().strip(" .!").replace(",", " ").split()
    return all(word in _COURTESY for word in words)


def _slipped(first: str, command: Command) -> bool:
    return OSA.distance(first, command.name) == 1


def _is_argument(rest: str) -> bool:
    """Whether it is numbers, or nothing: "drop the cup" is a sentence."""
    return all(word.isdecimal() for word in rest.split())
