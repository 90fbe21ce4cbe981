"""A sentence read once more: without its background, in plainer words; and which reading to trust.

What the grammar makes of a sentence as it stands is one reading among others. The likeliest of
them is taken where it is likely enough, else it is asked about.
"""

import re
from collections.abc import Callable
from typing import NamedTuple

from msgspec.structs import replace

from intents.context import Context
from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.passing import remainders
from intents.english.learnt.rewording import reworded
from intents.english.learnt.roles import SEVERAL
from intents.english.learnt.several import several
from intents.english.learnt.sight import Sight, sight
from intents.english.learnt.trust import Reading, trust
from intents.english.trouble import (
    Misfit,
    Offered,
    Partly,
    ReadingError,
    Unasked,
    Unpromised,
    Unread,
)
from intents.english.words.names import NameIndex
from intents.goals import Goal, If
from intents.outcomes import YES_OR_NO, Goals, Outcome, Question, Refusal
from intents.wording import in_words

SURE = 0.75
"""From here on other words than those said are acted on, below it they are asked about."""
DOUBTFUL = 0.4
"""Below it even what the grammar reads as it stands is asked about."""
_GUESS = 0.1
"""Below it nothing is asked."""
_PLAIN_WORDS = 8
"""So many words without a sign between them leave no room for background."""
_LONGEST = 60
"""Longer than that nobody talks beside an order that the grammar reads."""
_BETWEEN = re.compile(r"[,;:—–(]|[.!?…].*\w")


class Attempt(NamedTuple):
    """What the grammar makes of a text, and the error if it makes no sense of it."""

    outcome: Outcome
    after: Context
    error: ReadingError | None = None

    @property
    def goals(self) -> tuple[Goal, ...]:
        """What it asks for, be it also open which thing is meant."""
        if self.error is not None or isinstance(self.outcome, Refusal):
            return ()
        return self.outcome.goals

    @property
    def trouble(self) -> str:
        """The name of the error; empty if there is none."""
        return "" if self.error is None else type(self.error).__name__


class Look(NamedTuple):
    """A sentence read in some words.

    Attributes:
        attempt: What the grammar makes of them.
        reading: How they came about.
        remark: What is told if they are taken.
        doubt: What is told if they are asked about.
        whole: Whether nothing is lost in them that may change what is asked.
    """

    attempt: Attempt
    reading: Reading
    remark: str = ""
    doubt: str = "I am not sure that I got that"
    whole: bool = True


Grammar = Callable[[str], Attempt]


def second_look(
    text: str, index: NameIndex, first: Attempt, read: Grammar, *, fields: Fields = LEARNT
) -> Attempt:
    """The reading of a sentence to act on, or a question or refusal.

    Args:
        text: What was said.
        index: The names of this world.
        first: What the grammar makes of it as it stands.
        read: The grammar.
        fields: What was learnt; by default what comes with the package.
    """
    seen = None if is_settled(text, first) else sight(text, index, fields)
    found = looks_at(text, index, seen, first, read, fields=fields) if seen else []
    if not seen or not found:
        return first
    sure = trust([one.reading for one in found], seen, first.trouble, fields)
    likely, best = max(zip(sure, found, strict=True), key=lambda one: one[0])
    as_said = sure[0] if first.goals else 0.0
    if as_said >= DOUBTFUL or any(one.attempt.goals == first.goals for one in found[1:]):
        return first
    if best.whole and likely >= SURE:
        return best.attempt._replace(outcome=remarked(best.attempt.outcome, best.remark))
    if isinstance(first.outcome, Refusal) and not isinstance(first.error, Unread):
        return first  # it says what is not there
    if isinstance(first.outcome, Question) or (first.error is not None and likely < _GUESS):
        return first
    asked = just_that(text, Partly(best.doubt, best.attempt.goals))
    return best.attempt._replace(outcome=asked)


def is_settled(text: str, first: Attempt) -> bool:
    """Whether there is nothing to be gained by other words than those that were said."""
    if first.error is not None:
        return isinstance(first.error, Unasked | Offered | Unpromised)
    length = len(text.split())
    whole = length > _LONGEST or (length <= _PLAIN_WORDS and not _BETWEEN.search(text))
    depends = any(isinstance(goal, If) for goal in first.goals)
    return not first.goals or whole or depends


def looks_at(
    text: str, index: NameIndex, seen: Sight, first: Attempt, read: Grammar, *, fields: Fields
) -> list[Look]:
    """All that a sentence can be read as."""
    found = [Look(first, Reading("whole", first.goals))]
    rests = remainders(text, seen, index)
    for rest in rests:
        attempt = read(rest.text)
        passed = f"I pass over {rest.passed}"
        reading = Reading("rest", attempt.goals, rest.spans)
        found.append(Look(attempt, reading, passed, passed, rest.plain))
    shorter = [(rest.text, rest.spans) for rest in rests[-1:]]
    unread = [(text, ()), *shorter] if isinstance(first.error, Unread | Misfit) else []
    for words, spans in unread:
        idle = [
            float(likely)
            for word, likely in zip(seen.words, seen.idle, strict=True)
            if not any(start <= word.start < end for start, end in spans)
        ]
        plainly = [reworded(words, index, idle, fields=fields)]
        if seen.acts.get(SEVERAL, 0.0) > _GUESS:
            plainly.append(several(words, index, idle, fields))
        for plain in filter(None, plainly):
            attempt = read(plain.text)
            reading = Reading("plain", attempt.goals, spans, plain.left)
            taken = f"I take that as “{plain.text}”"
            found.append(Look(attempt, reading, taken, "I did not get every word", plain.whole))
    return [one for one in found if one.attempt.goals and (rests or one.attempt is not first)]


def just_that(text: str, partly: Partly) -> Question:
    """Ask whether to do what was understood, or what would help."""
    just = "" if isinstance(partly, Offered) else "just "
    reason = str(partly)
    return Question(
        question=f"{reason[:1].upper()}{reason[1:]}. Shall I {just}{in_words(partly.goals)}?",
        choices=YES_OR_NO,
        goals=partly.goals,
        text=text,
        kind="confirmation",
        puzzled=not isinstance(partly, Offered | Unpromised),
    )


def remarked(outcome: Outcome, *remarks: str) -> Outcome:
    """Say as well what was heard and changes nothing."""
    if not isinstance(outcome, Goals):
        return outcome
    told = [*filter(None, [(outcome.reason or "").removesuffix("."), *remarks])]
    return replace(outcome, reason=". ".join(told) + ".") if told else outcome
