"""Text to goals, a question or a refusal: the order in which it is tried.

First the word "stop", before anything else; then the answer to an open question; then the
grammar. What the grammar understands is checked against what is known to be there.
"""

import re
import time
from collections.abc import Callable

from msgspec.structs import replace

from intents.bounds import loosened, tells, unkept
from intents.caution import cautious
from intents.context import Context, answered, completed
from intents.english.clauses.telling import only_tells
from intents.english.phrases.referents import Scope
from intents.english.substitution import substitute
from intents.english.trouble import (
    Idle,
    Partly,
    ReadingError,
    Unasked,
    Unclear,
    Unpromised,
    Unread,
)
from intents.english.words import lexicon
from intents.english.words.names import index_of
from intents.english.words.spoken_signs import with_signs
from intents.english.words.text import Text
from intents.goals import LookAt, Stop, Wait
from intents.grammar import read
from intents.grounding import (
    Grounded,
    ground,
    narrowed,
)
from intents.halting import is_insistent
from intents.languages import language_of, only_english
from intents.last_look import last_look
from intents.outcomes import Choice, Goals, Outcome, Question, Refusal
from intents.prohibitions import broken
from intents.second_look import Attempt, just_that, remarked, second_look
from intents.stopping import is_stop
from intents.third_look import third_look
from intents.vocabulary import Vocabulary
from intents.what_is_there import of_what_is_there
from intents.witness import Hears, checked
from intents.wording import sentence_case

Fallback = Callable[[str, Vocabulary, Context], Outcome | None]
"""Asked for what the grammar does not understand; None if it has nothing to say either."""
__all__ = ["MAX_CHARACTERS", "Fallback", "asks_to_stop", "hear", "is_stop", "parse"]

_ASKING = lexicon.words(
    "what which who whose whom where when why how is are am was were do does did can have has"
)
ANSWERED = (
    "I can say where things are, what I hold, see and do, how long it takes, and why I stopped."
)
"""What is told to who asks what cannot be read."""
_ERRAND = re.compile(r"\bstop(?:ping)? (?:by|in|off|over|at|near|for|with|on)\b", re.IGNORECASE)
"""Stop *by* the shop, which may be unknown."""
_FORBIDS = re.compile(r"\b(?:do not|don'?t|dinn?ae?|never|must not|mustn'?t)\b", re.IGNORECASE)
"""What forbids something: no cry to stop, to a robot that does nothing."""
MAX_CHARACTERS = 1000
"""Longer texts are refused: nobody says a thousand characters to a robot at once."""


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


def asks_to_stop(text: str, vocabulary: Vocabulary) -> bool:
    """Whether all that the grammar makes of a text is to stop, in words that are no cry.

    "Desist from going there" is read, and not spotted: it takes some milliseconds, which whoever
    reads lines has, where waiting for the line before takes seconds. Nothing is reworded.
    """
    text = with_signs(_whole(text))
    if len(text) > MAX_CHARACTERS or _ERRAND.search(text):
        return False
    outcome = first_look(text, vocabulary, Context()).outcome
    goals = outcome.goals if isinstance(outcome, Goals) else ()
    return bool(goals) and all(isinstance(goal, Stop) for goal in goals)


def hear(
    text: str,
    vocabulary: Vocabulary,
    *,
    context: Context | None = None,
    fallback: Fallback | None = None,
) -> tuple[Outcome, Context]:
    """Like :func:`parse`, with the context for the next sentence.

    A ``fallback`` is asked where there are words that the grammar cannot read, and what it asked
    itself is answered; what it says is checked against what is there like anything else. What asks
    for nothing, what is not to be done and what is beyond all limits is the grammar's to answer.
    """
    started = time.perf_counter()
    text = with_signs(_whole(text))
    before = context or Context()
    outcome, after = _hear(text, vocabulary, before)
    if fallback is not None and _is_for_another(outcome, before) and len(text) <= MAX_CHARACTERS:
        outcome, after = _second_opinion(text, vocabulary, before, fallback, outcome) or (
            outcome, after,
        )  # fmt: skip
    ms = round((time.perf_counter() - started) * 1e3, 3)
    timed = replace(outcome, ms=ms)
    question = timed if isinstance(timed, Question) else None
    return timed, replace(after, question=question)


def _whole(text: str) -> str:
    """A text without halves of letters (lone surrogates), which nothing can write down."""
    return text if text.isascii() else text.encode("utf-8", "ignore").decode("utf-8")


def _is_for_another(outcome: Outcome, before: Context) -> bool:
    """Whether somebody else may read what the grammar cannot."""
    if isinstance(outcome, Goals):
        return False
    asked = before.question is not None and before.question.parser == "model"
    return outcome.puzzled or (asked and isinstance(outcome, Refusal))


def _hear(text: str, vocabulary: Vocabulary, context: Context) -> tuple[Outcome, Context]:
    if is_stop(text, at_rest=True):
        return Goals(goals=(Stop(),), parser="stop"), context
    if len(text) > MAX_CHARACTERS:
        return Refusal(reason="That is too long; say one thing after the other."), context
    if context.question is not None:
        goals = answered(text, context.question)
        if goals is not None:
            scope = Scope(index_of(vocabulary), context.object, context.person, context.place)
            for goal in goals:
                scope.mention_goal(goal)
            return _settled(
                _as_asked(of_what_is_there(text, goals, context), context), context, scope
            )
    foreign = language_of(text)
    if foreign:
        return Refusal(reason=only_english(foreign), puzzled=True), context
    question = context.question
    if question is not None and question.kind == "choice":
        chosen = _completed(text, vocabulary, context, question)
        if chosen:
            return chosen
    return _read(text, vocabulary, context)


def _read(text: str, vocabulary: Vocabulary, context: Context) -> tuple[Outcome, Context]:
    """What a text asks for that is no cry and no plain answer to an open question."""
    question = context.question
    heard: dict[str, Attempt] = {}
    found = _looked(text, vocabulary, context, heard)
    outcome, after = _within_bounds(text, vocabulary, context, found)
    if question is not None:
        pointed = None if isinstance(outcome, Goals) else _pointed_out(text, vocabulary, context)
        if pointed is None and isinstance(outcome, Refusal):
            pointed = _completed(text, vocabulary, context, question)
        if pointed:
            return pointed
    index = index_of(vocabulary)
    follows = bool(context.object or context.person or context.place or context.goals)
    read = _reader(vocabulary, context, heard)
    hear = Hears()
    last = third_look(text, index, found, read, follows=follows, hear=hear)
    if last is found:
        last = checked(text, index, found, read, follows=follows, hear=hear)
    if last is not found and broken(last.goals, [text], vocabulary):
        last = found  # what is not to be done is not even offered
    if last is not found:
        outcome, after = _within_bounds(text, vocabulary, context, last)
    careful = _as_cried(text, last, outcome)
    careful = cautious(text, _said(text, outcome, heard), careful, vocabulary)
    careful = last_look(text, careful, index)
    return (careful, context if isinstance(careful, Refusal) else after)


def _as_cried(text: str, attempt: Attempt, outcome: Outcome) -> Outcome:
    """A stop for a cry of which nothing else is made: "easy, easy, that's far enough!"."""
    if isinstance(outcome, Goals):
        waits = [goal for goal in outcome.goals if isinstance(goal, Wait) and not goal.duration_s]
        idle = len(waits) == len(outcome.goals) > 1
    else:
        forbids = _FORBIDS.search(text)
        forbids = forbids and (
            isinstance(attempt.error, Unasked) or forbids.group().lower() == "never"
        )
        idle = isinstance(outcome, Refusal) and not forbids
    cried = idle and is_insistent(text)
    return Goals(goals=(Stop(),), parser="stop") if cried else outcome


def _said(text: str, outcome: Outcome, heard: dict[str, Attempt]) -> str:
    """In which words a text was read: its own, if those mean the same."""
    goals = () if isinstance(outcome, Refusal) else outcome.goals
    read = [said for said, attempt in heard.items() if attempt.goals == goals]
    return text if text in read or not read else read[-1]


def _pointed_out(
    text: str, vocabulary: Vocabulary, context: Context
) -> tuple[Outcome, Context] | None:
    """What an answer like "the left one" or "the one on the shelf" settles, as things stand."""
    question = context.question
    about = question.about if question is not None else None
    if question is None or about is None:
        return None
    asked = replace(context, object=about, question=None)
    seen = _looked(f"look at {text}", vocabulary, asked).outcome
    goal = seen.goals[0] if isinstance(seen, Goals) and len(seen.goals) == 1 else None
    query = goal.object if isinstance(goal, LookAt) else None
    found = ground(query, context.entities, view=context.view) if query else None
    ids = found.ids if isinstance(found, Grounded) else ()
    meant = [narrowed(about, e) for e in context.entities if e.id in ids]
    if len(meant) != 1 or meant[0] not in [choice.query for choice in question.choices]:
        return None
    one = replace(meant[0], count=about.count)
    goals = tuple(substitute(goal, about, one) for goal in question.goals)
    scope = Scope(index_of(vocabulary), context.object, context.person, context.place)
    for goal in goals:
        scope.mention_goal(goal)
    return _settled(_as_asked(of_what_is_there(text, goals, context), context), context, scope)


def _as_asked(outcome: Outcome, context: Context) -> Outcome:
    """What answers a question is still of whoever made what was asked about."""
    question = context.question
    return replace(outcome, parser=question.parser) if question is not None else outcome


def _completed(
    text: str, vocabulary: Vocabulary, context: Context, question: Question
) -> tuple[Outcome, Context] | None:
    """What the sentence before means with an answer put in."""
    asked: tuple[Outcome, Context] | None = None
    for whole in completed(text, question):
        found = _looked(whole, vocabulary, context)
        outcome, after = _within_bounds(whole, vocabulary, context, found)
        if isinstance(outcome, Goals):
            return outcome, after
        if isinstance(outcome, Question) and outcome.choices and not _alike(outcome, question):
            asked = asked or (outcome, after)  # one thing is known now, another is open
    return asked


def _alike(one: Question, other: Question) -> bool:
    """Whether two questions ask for the same."""
    return one.question == other.question.removeprefix("I did not get that. ")


def _second_opinion(
    text: str, vocabulary: Vocabulary, context: Context, fallback: Fallback, own: Outcome
) -> tuple[Outcome, Context] | None:
    """What somebody else makes of a text; None if that is no better than the grammar's own."""
    other = fallback(text, vocabulary, context)
    asks = isinstance(own, Question)
    if other is None or (asks and isinstance(other, Refusal)):
        return None
    if not isinstance(other, Goals):
        return other, context
    if isinstance(own, Question) and own.goals == other.goals:
        return None  # it says as well what is left out of it
    scope = Scope(index_of(vocabulary), context.object, context.person, context.place)
    for goal in other.goals:
        scope.mention_goal(goal)
    checked = of_what_is_there(text, other.goals, context)
    if isinstance(checked, Goals):
        checked = other
    if unkept(text, other.goals):
        return _settled(_bounded(text, checked), context, scope)
    return _settled(replace(checked, parser=other.parser), context, scope)


def _looked(
    text: str, vocabulary: Vocabulary, context: Context, heard: dict[str, Attempt] | None = None
) -> Attempt:
    """What a text asks for: read as it stands, without background, in plainer words.

    All words in which it was read are kept in ``heard``, with what came of them.
    """
    read = _reader(vocabulary, context, {} if heard is None else heard)
    return second_look(text, index_of(vocabulary), read(text), read)


def _reader(
    vocabulary: Vocabulary, context: Context, heard: dict[str, Attempt]
) -> Callable[[str], Attempt]:
    """The grammar; what it read is kept."""

    def read(said: str) -> Attempt:
        heard[said] = first_look(said, vocabulary, context)
        return heard[said]

    return read


def _within_bounds(
    text: str, vocabulary: Vocabulary, context: Context, found: Attempt
) -> tuple[Outcome, Context]:
    """What was made of a text, or what is asked or said of a bound in it that no goal carries."""
    if not isinstance(found.outcome, Refusal) and found.outcome.goals:
        return _bounded(text, found.outcome), found.after
    return _loosened(text, vocabulary, context, found.outcome) or (found.outcome, found.after)


def _loosened(
    text: str, vocabulary: Vocabulary, context: Context, own: Outcome
) -> tuple[Outcome, Context] | None:
    """What is said of a text that cannot be read with its bound; None for any other."""
    plain, said = loosened(text)
    cannot = f"I cannot promise “{said}”"
    again = first_look(plain, vocabulary, context) if plain else None
    if again and isinstance(again.outcome, Goals) and not tells(again.outcome.goals):
        return just_that(text, Unpromised(cannot, again.outcome.goals)), again.after
    misread = isinstance(own, Refusal) and any(f"“{word}" in own.reason for word in said.split())
    return (Refusal(reason=f"{cannot}.", puzzled=True), context) if misread else None


def _bounded(text: str, outcome: Outcome) -> Outcome:
    """An outcome, as a question where it would act without a bound that was said."""
    if not isinstance(outcome, Goals):
        return outcome
    said = unkept(text, outcome.goals)
    if not said:
        return outcome
    return just_that(text, Unpromised(f"I cannot promise “{said}”", outcome.goals))


def first_look(text: str, vocabulary: Vocabulary, context: Context) -> Attempt:
    """What the grammar makes of every word of a text."""
    words = Text(text, vocabulary)
    if not any(w[0].isalnum() for w in words.words):
        nothing = "I heard nothing; say for example “bring me the cup”."
        return Attempt(Refusal(reason=nothing), context)
    scope = Scope(words.index, context.object, context.person, context.place)
    try:
        understood = read(words, scope, context.goals)
    except Partly as partly:
        return Attempt(
            *_settled(just_that(text, partly), context, scope), partly, only_tells(words)
        )
    except Unclear as unclear:
        choices = tuple(Choice(label=c) for c in unclear.choices)
        kind = "choice" if choices else "missing"
        question = Question(
            question=str(unclear), choices=choices, text=text, said=unclear.said, kind=kind,
            about=unclear.about,
        )  # fmt: skip
        after = context if unclear.about is None else replace(context, object=unclear.about)
        return Attempt(question, after, unclear, only_tells(words))
    except ReadingError as error:
        puzzled = not isinstance(error, Unasked)
        asks = isinstance(error, Unread) and words.word(0) in _ASKING and words.word(1) != "not"
        hint = f" {ANSWERED}" if asks else ""
        refusal = Refusal(reason=f"{sentence_case(str(error))}.{hint}", puzzled=puzzled)
        return Attempt(refusal, context, error, only_tells(words))
    if not understood.goals:
        nothing = "I see nothing to do in that."
        return Attempt(Refusal(reason=nothing), context, Idle(nothing), only_tells(words))
    checked = of_what_is_there(text, understood.goals, context)
    if isinstance(checked, Goals):
        checked = replace(checked, clauses=understood.clauses)
        checked = remarked(checked, *_corrected(words), *understood.remarks)
    return Attempt(*_settled(checked, context, scope))


def _settled(outcome: Outcome, context: Context, scope: Scope) -> tuple[Outcome, Context]:
    """The outcome with the context after it, which only goals change."""
    if isinstance(outcome, Refusal) or (
        isinstance(outcome, Question) and outcome.kind != "confirmation"
    ):
        return outcome, context
    after = replace(
        context,
        object=scope.object,
        person=scope.person,
        place=scope.place,
        goals=outcome.goals,
    )
    return outcome, after


def _corrected(words: Text) -> tuple[str, ...]:
    """Which words were corrected."""
    taken = ", ".join(f"“{said}” for “{meant}”" for said, meant in words.corrections)
    return (f"I took {taken}",) if taken else ()
