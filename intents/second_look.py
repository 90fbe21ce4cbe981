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
from intents.english.learnt.passing import Remainder, parts, remainders
from intents.english.learnt.rewording import reworded
from intents.english.learnt.roles import SEVERAL
from intents.english.learnt.several import several
from intents.english.learnt.sight import Sight, sight
from intents.english.learnt.trust import SURE, Reading, is_known, trust
from intents.english.trouble import (
    NotUnderstood,
    Offered,
    Partly,
    ReadingError,
    Unasked,
    Unclear,
    Unpromised,
    Unread,
)
from intents.english.words.names import NameIndex
from intents.english.words.taking_back import behind_what_takes_back
from intents.goals import Goal, If, Say, each
from intents.outcomes import YES_OR_NO, Goals, Outcome, Question, Refusal
from intents.sentence_kind import SentenceKind, kind_of
from intents.wording import in_words, sentence_case

DOUBTFUL, RIVAL = 0.05, 0.3
"""What the grammar reads from every word is given up only where it is less likely than the first,
and another reading, which passes no order over, is likelier than the second: words that are only
unheard are no talk."""
_AS_LIKELY = 0.02
"""What differs by less is as likely; the words that are nearer to those that were said count."""
_GUESS = 0.5
"""Below it nothing is asked."""
_SEVERAL = 0.2
"""From here on several orders are looked for."""
_PLAIN_WORDS = 8
"""So many words without a sign between them leave no room for background."""
_FEWEST = 3
"""So few leave none at all."""
_MOST_REWORDED = 2
"""So many remainders without whole clauses are said in plain words: each takes a millisecond."""
LONGEST = 60
"""Longer than that nobody talks beside an order that the grammar reads."""
_OWN_DOING = re.compile(
    r"(?:and |so |then )?(?:i|we) (?:go|walk|come|run|turn|step|open|close|put|bring|take|fetch|"
    r"carry|follow|stand|wait|wave|lift|switch)\b[^,;:.!?—–]*[.!]?",
    re.IGNORECASE,
)
"""I walk to the door: who speaks does that, and no other words make an order of it."""
_BETWEEN = re.compile(r"[,;:—–(]|[.!?…].*\w")


class Attempt(NamedTuple):
    """What the grammar makes of a text.

    Attributes:
        outcome: What is said or done.
        after: The context after it.
        error: Why it makes no sense; None if it does.
        tells: Whether it has the form of a statement through and through.
    """

    outcome: Outcome
    after: Context
    error: ReadingError | None = None
    tells: bool = False

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
        least: How likely they have to be what was meant to be acted on [0..1]; above 1 if never.
    """

    attempt: Attempt
    reading: Reading
    remark: str = ""
    doubt: str = ""
    least: float = SURE


Grammar = Callable[[str], Attempt]


class _Heard(NamedTuple):
    """A sentence, how the fields see it, and by what it is read."""

    text: str
    names: NameIndex
    seen: Sight
    read: Grammar
    fields: Fields


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
    most = max(sure)
    likely, best = next(
        (p, one) for p, one in zip(sure, found, strict=True) if p > most - _AS_LIKELY
    )
    if first.goals:
        alike = any(one.attempt.goals == first.goals for one in found[1:])
        hardly = sure[0] < DOUBTFUL and likely > RIVAL
        says = any(isinstance(goal, Say) for goal in each(first.goals))  # word for word
        hardly = hardly and not says and not _passes_orders(text, best, read)
        hardly = hardly and behind_what_takes_back(text) is None  # that the fields know seldom
        sound = alike or not hardly or not is_known(first.goals, fields)
        return first if sound else _instead(text, best, likely, first)
    kind = kind_of(text, best.attempt.goals, tells=first.tells)
    told = kind in (SentenceKind.TOLD, SentenceKind.QUESTION)
    if likely >= best.least and not told:
        return best.attempt._replace(outcome=remarked(best.attempt.outcome, best.remark))
    if isinstance(first.outcome, Refusal) and not isinstance(first.error, Unread):
        return first  # it says what is not there
    if isinstance(first.outcome, Question) or likely < _GUESS:
        return first
    asked = just_that(text, Partly(best.doubt, best.attempt.goals))
    return best.attempt._replace(outcome=asked, tells=first.tells)


def _passes_orders(text: str, look: Look, read: Grammar) -> bool:
    """Whether what a reading passes over as talk is an order by itself."""
    return any(read(text[start:end]).goals for start, end in look.reading.spans)


def _instead(text: str, best: Look, likely: float, first: Attempt) -> Attempt:
    """What to do where a reading of every word is not to be trusted.

    What asks for something of its own kind is never taken for talk.
    """
    if isinstance(first.outcome, Question):
        return first
    kept = {type(goal) for goal in first.goals} <= {type(goal) for goal in best.attempt.goals}
    if likely >= best.least and kept:
        return best.attempt._replace(outcome=remarked(best.attempt.outcome, best.remark))
    asked = just_that(text, Partly("I am not sure that I got that", first.goals))
    return first._replace(outcome=asked)


def is_settled(text: str, first: Attempt) -> bool:
    """Whether there is nothing to be gained by other words than those that were said."""
    if not first.goals and _OWN_DOING.fullmatch(text.strip()):
        return True
    if first.error is not None:
        return isinstance(first.error, Unasked | Offered | Unpromised)
    whole = len(text.split()) > LONGEST or is_plain(text)
    depends = any(isinstance(goal, If) for goal in first.goals)
    return not first.goals or whole or depends


def is_plain(text: str) -> bool:
    """Whether a sentence is too short to hold anything beside an order."""
    length = len(text.split())
    return length <= _FEWEST or (length <= _PLAIN_WORDS and not _BETWEEN.search(text))


def looks_at(
    text: str, index: NameIndex, seen: Sight, first: Attempt, read: Grammar, *, fields: Fields
) -> list[Look]:
    """All that a sentence can be read as."""
    found = [Look(first, Reading("whole", first.goals))]
    rests = remainders(text, seen, index)
    for rest in rests:
        attempt = read(rest.text)
        passed = f"I pass over {rest.passed}"
        reading = Reading("rest", attempt.goals, rest.spans, harms=rest.harms)
        found.append(Look(attempt, reading, passed, passed, rest.least))
    heard = _Heard(text, index, seen, read, fields)
    whole = Remainder(text, (), "", SURE)
    sayable = first.error is not None and type(first.error) not in (Unclear, NotUnderstood)
    for rest in (whole, *rests[-1:]) if sayable else ():
        found += _plainly(rest, heard)
    if first.error is not None and type(first.error) is not Partly:  # that says what is not kept
        found += _without_clauses(heard, {rest.text for rest in rests})
    return [one for one in found if one.attempt.goals and (rests or one.attempt is not first)]


def _plainly(rest: Remainder, heard: _Heard) -> list[Look]:
    """What is left of a sentence, in plain words."""
    seen, index, fields = heard.seen, heard.names, heard.fields
    idle = [
        float(likely)
        for word, likely in zip(seen.words, seen.idle, strict=True)
        if not any(start <= word.start < end for start, end in rest.spans)
    ]
    told = [reworded(rest.text, index, idle, fields=fields)]
    if seen.acts.get(SEVERAL, 0.0) > _SEVERAL:
        told.append(several(rest.text, index, idle, fields))
    found: list[Look] = []
    for plain in filter(None, told):
        attempt = heard.read(plain.text)
        harms = rest.harms | plain.harms
        reading = Reading("plain", attempt.goals, rest.spans, plain.left, harms)
        taken = f"I take that as “{plain.text}”"
        least = max(rest.least, plain.least)
        found.append(Look(attempt, reading, taken, "I did not get every word", least))
    return found


def _without_clauses(heard: _Heard, tried: set[str]) -> list[Look]:
    """What a sentence can be read as without whole clauses.

    Args:
        heard: The sentence.
        tried: What of it was read already.
    """
    found: list[Look] = []
    said_again = 0
    for rest in parts(heard.text, heard.seen, heard.names):
        if rest.text in tried:
            continue
        attempt = heard.read(rest.text)
        passed = f"I pass over {rest.passed}"
        reading = Reading("part", attempt.goals, rest.spans, harms=rest.harms)
        found.append(Look(attempt, reading, passed, passed, rest.least))
        if attempt.goals or said_again >= _MOST_REWORDED:
            continue
        said_again += 1
        found += _plainly(rest, heard)
    return found


def just_that(text: str, partly: Partly) -> Question:
    """Ask whether to do what was understood, or what would help."""
    just = "" if isinstance(partly, Offered) else "just "
    reason = str(partly)
    return Question(
        question=f"{sentence_case(reason)}. Shall I {just}{in_words(partly.goals)}?",
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
