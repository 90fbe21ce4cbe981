"""A command of the prompt, as a row of the table."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from robot.files.misfits import nearest, shown


def nothing() -> Iterable[str]:
    """No choices."""
    return ()


def alone(rest: str) -> bool:
    """Whether nothing follows the command's name: "step back" is a sentence, "step" is not."""
    return not rest


def anything(_rest: str) -> bool:
    """Whatever follows belongs to the command."""
    return True


def nowhere(_rest: str) -> bool:
    """Nothing that follows names a file."""
    return False


def one_of(*words: str) -> Callable[[str], bool]:
    """Whether what follows is one of the words."""
    return lambda rest: rest in words


def begins(*words: str, bare: bool = True) -> Callable[[str], bool]:
    """Whether what follows begins with one of the words (or, if `bare`, is nothing)."""
    return lambda rest: rest.split(" ")[0] in words if rest else bare


@dataclass(frozen=True, kw_only=True)
class Command:
    """One command.

    Attributes:
        name: the first word of the line.
        usage: the whole line, for people.
        summary: what it does, in one sentence without a full stop.
        run: does it, with what follows the name.
        accepts: whether what follows makes this a command; else the line is a sentence.
        choices: what may follow, for completion.
        takes_sentence: what follows is a sentence.
        files: whether what follows names a file: nobody far away reads or writes those.
        kind: what the choices are, for a message about one that is none.
    """

    name: str
    usage: str
    summary: str
    run: Callable[[str], None]
    accepts: Callable[[str], bool] = alone
    choices: Callable[[], Iterable[str]] = nothing
    takes_sentence: bool = False
    files: Callable[[str], bool] = nowhere
    kind: str = ""

    @property
    def loose(self) -> bool:
        """Whether almost anything may follow, so that a slip in its name cannot be told."""
        return self.takes_sentence or self.accepts in (alone, anything, bool)

    def misfit(self, rest: str) -> str:
        """Why what follows the name makes no command of it, and what would."""
        choices = sorted(self.choices())
        cure = f" ({nearest(rest.casefold(), choices)})" if choices else ""
        if self.kind:
            return f"there is no {self.kind} {shown(rest)}{cure}"
        return f"`{self.name}` takes no {shown(rest)}{cure}"
