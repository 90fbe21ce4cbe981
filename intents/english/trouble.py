"""Why a sentence has no reading. Raised inside the grammar only; the parser makes values of it.

Trouble
├── Misfit         the words do not fit this verb; another reading may
├── NotUnderstood  understood well enough to know that it cannot be done
│   ├── Unread         no reading knows what to make of some words
│   ├── Idle           nothing is asked for in words that a reading knows
│   └── Unasked        nothing is asked of the robot
└── Unclear        could be done if one thing were known
    ├── Partly     some of it is understood and some is not
    │   ├── Unfinished some words of it no reading knows what to make of
    │   ├── Offered    it only tells something that something can be done about
    │   └── Unpromised what is not to be done may come about
    └── Doubtful   a name that is not known is like one that is
"""

from intents.goals import Goal, ObjectQuery


class ReadingError(Exception):
    """A reading failed; ``str()`` says why in a sentence for people.

    Attributes:
        weight: Of several errors the heaviest is told, of equal ones the first.
    """

    weight = 0
    """A misfit says only what the sentence is not."""


class Misfit(ReadingError):
    """The words do not fit the verb."""


class NotUnderstood(ReadingError):
    """A name or a request that means nothing here."""

    weight = 1
    """The words fit, so this is nearer to what was meant than a misfit."""


class Unread(NotUnderstood):
    """No reading makes anything of some words: other words may say it better."""


class Idle(NotUnderstood):
    """Nothing is asked for in words that a reading knows."""


class Unasked(NotUnderstood):
    """Nothing is asked of the robot: it is to leave something be, or somebody else is spoken to."""


class Unclear(ReadingError):
    """One thing is missing; the sentence is the question.

    Attributes:
        choices: What can be answered, if that is known.
        said: The words that a choice stands in place of.
        about: What the answer is about, if it says "it".
    """

    about: ObjectQuery | None = None
    weight = 2
    """A question that can be answered is worth more than a refusal."""

    def __init__(self, question: str, choices: tuple[str, ...] = (), said: str = "") -> None:
        super().__init__(question)
        self.choices = choices
        self.said = said


class Partly(Unclear):
    """Some clauses are understood and one is not.

    Attributes:
        goals: What was understood.
    """

    def __init__(self, reason: str, goals: tuple[Goal, ...]) -> None:
        super().__init__(reason)
        self.goals = goals


class Unfinished(Partly):
    """No reading makes anything of some words: other words may say them better."""


class Offered(Partly):
    """Nothing was asked for, and something could be done about what was told."""


class Unpromised(Partly):
    """What the person said is not to be done is asked for as well, or may come about."""


class Doubtful(Unclear):
    """A name that is not known, but near ones are: the question is which of those is meant."""

    weight = 1
    """A guess: an error of a sense that knows the name is as telling, and comes first."""


def listing(names: list[str] | tuple[str, ...], last: str = "or") -> str:
    """Names as one says them: "a, b or c"."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {last} {names[-1]}"
