"""What becomes of a sentence: goals, a question, or a refusal."""

from typing import Literal

import msgspec

from intents.goals import Goal, ObjectQuery, to_builtins

ParserName = Literal["grammar", "model", "stop"]
QuestionKind = Literal["choice", "missing", "confirmation"]


class Goals(msgspec.Struct, frozen=True, kw_only=True):
    """It can be done.

    Attributes:
        parser: Which parser understood it.
        reason: How it was understood, where there is something to remark.
        clauses: What was said, clause by clause, and what each was read as by itself.
        instead: Whether they take the place of what was asked last ("no, the blue one").
        elliptic: Whether what was said means nothing without what was said before it.
        ms: How long that took [ms].
    """

    goals: tuple[Goal, ...]
    parser: ParserName = "grammar"
    reason: str | None = None
    clauses: tuple[tuple[str, tuple[Goal, ...]], ...] = ()
    instead: bool = False
    elliptic: bool = False
    ms: float = 0.0


class Choice(msgspec.Struct, frozen=True, kw_only=True):
    """One possible answer to a question: what is said of it, and the query it stands for."""

    label: str
    query: ObjectQuery | None = None


YES_OR_NO = (Choice(label="yes"), Choice(label="no"))
"""The choices of a confirmation."""


class Question(msgspec.Struct, frozen=True, kw_only=True):
    """It could be carried out if one thing were known.

    Attributes:
        question: The question, for people.
        choices: What can be answered, if the choice is limited.
        goals: What would be done; ``about`` in it is what the question is about.
        about: The description that fits several objects.
        text: What was said.
        said: The words in it that a choice stands in place of.
        kind: Which of several, what is missing, or whether to do it at all ("yes" or "no").
        puzzled: There are words in it that the grammar cannot read, and somebody else may.
    """

    question: str
    choices: tuple[Choice, ...] = ()
    goals: tuple[Goal, ...] = ()
    about: ObjectQuery | None = None
    text: str = ""
    said: str = ""
    kind: QuestionKind = "missing"
    puzzled: bool = False
    parser: ParserName = "grammar"
    ms: float = 0.0


class Refusal(msgspec.Struct, frozen=True, kw_only=True):
    """It was not understood, or no robot can do it here; ``reason`` says which part and why.

    Attributes:
        puzzled: There are words in it that the grammar cannot read, and somebody else may.
    """

    reason: str
    puzzled: bool = False
    parser: ParserName = "grammar"
    ms: float = 0.0


class Reply(msgspec.Struct, frozen=True, kw_only=True):
    """Nothing is to be done: ``text`` is the answer."""

    text: str
    ms: float = 0.0


Outcome = Goals | Question | Refusal
"""What a sentence leads to by itself."""
Turn = Outcome | Reply
"""What it leads to in a conversation."""
_KINDS = {Goals: "goals", Question: "question", Refusal: "refusal"}


def to_record(text: str, outcome: Outcome) -> dict[str, object]:
    """The outcome as one record of ``humanoid parse --json``."""
    return {
        "text": text,
        "outcome": _KINDS[type(outcome)],
        "goals": to_builtins(outcome.goals) if isinstance(outcome, Goals) else [],
        "question": outcome.question if isinstance(outcome, Question) else None,
        "reason": None if isinstance(outcome, Question) else outcome.reason,
        "parser": outcome.parser,
        "ms": outcome.ms,
    }
