"""What a reading is: it looks at the words from a place on and says what they ask for.

A reading is a function ``reading(sentence, at) -> Found | None``: None where the clause at word
``at`` is nothing of its kind, a :class:`~intents.english.trouble.ReadingError` where it is of its
kind and cannot be done. An afterthought is a function ``afterthought(sentence, at, last)`` that
finds goals in place of the ``last`` ones. Both are handed to the sentence as data, so that a clause
may hold clauses without any reading knowing the others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from intents.english.phrases.complements import Complement, ends_clause
from intents.english.phrases.referents import Scope
from intents.english.trouble import Misfit, NotUnderstood, ReadingError, Unread
from intents.english.words.names import Name
from intents.english.words.text import Text
from intents.goals import Goal

Found = tuple[list[Goal], int]
"""Goals, and where the words that say them end."""
_DEEPEST = 4
"""So many conditions and repetitions may stand in one another. It bounds how long reading takes:
1000 characters of "for each mug" take 44 ms with 4, 101 ms with 12."""


class SaidVerb(NamedTuple):
    """A verb at word ``at``, its complements from word ``first`` on, in its possible senses."""

    at: int
    first: int
    senses: tuple[str, ...]


class Forbidden(NamedTuple):
    """What is not to be done, as it was said, with the names in it.

    ``away`` says that it is a place or a thing to keep away from, ``how`` that it is a way of doing
    what is asked for: with which hand, past whom, by what motion, on which of several boards.
    """

    said: str
    names: tuple[Name, ...]
    away: bool
    how: bool


@dataclass(slots=True)
class Notes:
    """What the clauses of a sentence leave for those that follow.

    Attributes:
        wanted: The last clause was a wish ("I want the cup"), which the next may spell out.
        verb: The last verb, which the next clause may leave out.
        particles: "On", "off" or "out" of that verb.
        one_hand: It is said with which hands a thing is to be handled.
        trace: Each clause as it was said, with what it was read as by itself.
        passed: From where to where words stand that ask for nothing, or were taken back.
        forbidden: What is not to be done.
        homes: Where it was last told that things belong, as what is to be done.
        guessed: Verbs that nobody knows, taken for moving a thing to where it is to be.
    """

    wanted: bool = False
    verb: SaidVerb | None = None
    particles: list[Complement] = field(default_factory=list[Complement])
    one_hand: bool = False
    trace: list[tuple[str, tuple[Goal, ...]]] = field(
        default_factory=list[tuple[str, tuple[Goal, ...]]]
    )
    passed: list[tuple[int, int]] = field(default_factory=list[tuple[int, int]])
    forbidden: list[Forbidden] = field(default_factory=list["Forbidden"])
    homes: tuple[Goal, ...] = ()
    guessed: list[str] = field(default_factory=list[str])


class Rules(NamedTuple):
    """What can be said, in the order in which it is tried (:mod:`intents.english.order`)."""

    readings: tuple[Reading, ...]
    afterthoughts: tuple[Afterthought, ...]


@dataclass(frozen=True, slots=True)
class Sentence:
    """What a reading is given.

    Attributes:
        scope: What pronouns stand for.
        history: The goals of the sentence before, for "do it again".
        before: The goals of the clauses before; a reading may take back or change them.
        depth: In how many conditions and repetitions the clause stands.
    """

    text: Text
    scope: Scope
    rules: Rules
    history: tuple[Goal, ...] = ()
    notes: Notes = field(default_factory=Notes)
    before: list[Goal] = field(default_factory=list[Goal])
    depth: int = 0

    def after(self, before: list[Goal]) -> Sentence:
        """The sentence as it is seen after other goals."""
        return replace(self, before=before)

    def inner(self) -> Sentence:
        """The sentence as it is seen from within a condition or a repetition.

        Raises:
            NotUnderstood: That is too deep.
        """
        if self.depth >= _DEEPEST:
            raise NotUnderstood("There are too many conditions in one another")
        return replace(self, depth=self.depth + 1)


Reading = Callable[[Sentence, int], Found | None]
Afterthought = Callable[[Sentence, int, list[Goal]], Found | None]


def clause(sentence: Sentence, at: int) -> Found:
    """One clause, by the first reading that succeeds.

    Raises:
        ReadingError: None does; the most telling of their errors.
    """
    errors: list[ReadingError] = []
    for reading in sentence.rules.readings:
        try:
            found = reading(sentence, at)
        except ReadingError as error:
            errors.append(error)
            continue
        if found:
            return found
    worst = max(errors, key=lambda e: e.weight, default=None)
    if worst is None or (isinstance(worst, Misfit) and str(worst).endswith("?")):
        raise not_understood(sentence.text, at)
    raise worst


def clause_by_itself(sentence: Sentence, at: int) -> Found:
    """One clause that does not go on from those before."""
    return clause(sentence.after([]), at)


def not_understood(text: Text, at: int) -> Unread:
    """The error that quotes what begins at a word."""
    end = at + 1
    while end < len(text) and not ends_clause(text, end):
        end += 1
    return Unread(f"I do not understand “{text.raw(at, end)}”")
