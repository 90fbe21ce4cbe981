"""Text to goals, a question or a refusal: the order in which it is tried.

First the word "stop", before anything else; then the answer to an open question; then the
grammar. What the grammar understands is checked against what is known to be there.
"""

import re
import time

from msgspec.structs import replace

from intents.dialogue import Context, answered
from intents.english.referents import Scope
from intents.english.text import Text
from intents.english.trouble import ReadingError, Unclear
from intents.goals import Cancel, Goal, Stop
from intents.grammar import Grammar
from intents.grounding import Ambiguous, Unknown, ground, narrowed, queries
from intents.outcomes import Choice, Goals, Outcome, Question, Refusal
from intents.vocabulary import Vocabulary

MAX_CHARACTERS = 1000
"""Longer texts are refused: nobody says a thousand characters to a robot at once."""

_WORD = re.compile(r"[a-z]+")
_STOPS = {"stop", "halt", "freeze", "emergency", "estop", "stopp"}
_BEFORE_STOP = {"please", "robot", "hey", "no", "now", "just", "okay", "oh", "wait", "e", "you",
                "must", "should", "can", "everything", "immediately", "abort"}  # fmt: skip


def is_stop(text: str) -> bool:
    """Whether a text is a cry to stop; looks at the first words only, and errs towards yes."""
    for word in _WORD.findall(text[:80].lower())[:6]:
        if word in _STOPS:
            return True
        if word not in _BEFORE_STOP:
            return False
    return False


def parse(text: str, vocabulary: Vocabulary, *, context: Context | None = None) -> Outcome:
    """What a sentence asks for.

    Args:
        text: What was said or typed; every string is accepted.
        vocabulary: The names of this world.
        context: What was said before and what is there.

    Returns:
        Goals, a question whose answer is missing, or a refusal with its reason.
    """
    return hear(text, vocabulary, context=context)[0]


def hear(
    text: str, vocabulary: Vocabulary, *, context: Context | None = None
) -> tuple[Outcome, Context]:
    """Like :func:`parse`, with the context for the next sentence."""
    started = time.perf_counter()
    before = context or Context()
    outcome, after = _hear(text, vocabulary, before)
    ms = round((time.perf_counter() - started) * 1e3, 3)
    timed = replace(outcome, ms=ms)
    question = timed if isinstance(timed, Question) else None
    return timed, replace(after, question=question)


def _hear(text: str, vocabulary: Vocabulary, context: Context) -> tuple[Outcome, Context]:
    if is_stop(text):
        return Goals(goals=(Stop(),), parser="stop"), context
    if len(text) > MAX_CHARACTERS:
        return Refusal(reason="That is too long; say one thing after the other."), context
    if context.question is not None:
        goals = answered(text, context.question)
        if goals is not None:
            return _checked(text, goals, context), context
    words = Text(text, vocabulary)
    if not any(w[0].isalnum() for w in words.words):
        return Refusal(reason="I heard nothing; say for example “bring me the cup”."), context
    scope = Scope(words.index, context.object, context.person, context.place)
    try:
        goals = tuple(Grammar(words, scope, context.goals).read())
    except Unclear as unclear:
        choices = tuple(Choice(label=c) for c in unclear.choices)
        return Question(question=str(unclear), choices=choices, text=text), context
    except ReadingError as error:
        return Refusal(reason=f"{_sentence(str(error))}."), context
    if not goals:
        return Refusal(reason="I see nothing to do in that."), context
    after = Context(object=scope.object, person=scope.person, place=scope.place,
                    goals=goals, entities=context.entities)  # fmt: skip
    return _checked(text, goals, context), after


def _checked(text: str, goals: tuple[Goal, ...], context: Context) -> Outcome:
    """Ask which is meant, or refuse what is not there, where it is known what is there."""
    if not context.entities or any(isinstance(g, Cancel) for g in goals):
        return Goals(goals=goals)
    by_id = {e.id: e for e in context.entities}
    for query in queries(goals):
        found = ground(query, context.entities)
        if isinstance(found, Unknown):
            return Refusal(reason=f"{_sentence(found.reason)}.")
        if isinstance(found, Ambiguous):
            choices = tuple(
                Choice(label=label, query=narrowed(query, by_id[i]))
                for label, i in zip(found.labels, found.candidates, strict=True)
            )
            return Question(
                question=found.question, choices=choices, goals=goals, about=query, text=text
            )
    return Goals(goals=goals)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]
