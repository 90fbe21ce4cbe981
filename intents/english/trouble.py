"""Why a sentence has no reading. Raised inside the grammar only; the parser makes values of it.

Trouble
├── Misfit         the words do not fit this verb; another reading may
├── NotUnderstood  understood well enough to know that it cannot be done
└── Unclear        could be done if one thing were known
"""


class ReadingError(Exception):
    """A reading failed; ``str()`` says why in a sentence for people."""

    weight = 0


class Misfit(ReadingError):
    """The words do not fit the verb."""


class NotUnderstood(ReadingError):
    """A name or a request that means nothing here."""

    weight = 1


class Unclear(ReadingError):
    """One thing is missing; the sentence is the question.

    Attributes:
        choices: What can be answered, if that is known.
        said: The words that a choice stands in place of.
    """

    weight = 2

    def __init__(self, question: str, choices: tuple[str, ...] = (), said: str = "") -> None:
        super().__init__(question)
        self.choices = choices
        self.said = said


def listing(names: list[str] | tuple[str, ...], last: str = "or") -> str:
    """Names as one says them: "a, b or c"."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {last} {names[-1]}"
