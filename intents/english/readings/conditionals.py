"""Conditions before what hangs on them: "if the cup is not there, bring the mug"."""

from copy import copy

from msgspec.structs import replace

from intents.english.clauses.compounds import condition
from intents.english.clauses.conditions import IF, as_soon_as, is_complement, mention
from intents.english.clauses.coordination import link_at
from intents.english.clauses.openings import nothing_end, other_case, otherwise_end
from intents.english.clauses.told import told_end
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.times import tells_when
from intents.english.reading import Found, Sentence
from intents.english.sequences import sequence
from intents.english.trouble import NotUnderstood, Partly, ReadingError, Unclear, listing
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.goals import (
    Condition,
    Goal,
    Holding,
    If,
    ObjectQuery,
    Person,
    Present,
    simple_conditions,
)


def conditional(sentence: Sentence, at: int) -> Found | None:
    """If the cup is not there, bring the mug, otherwise wait."""
    text = sentence.text
    start = text.phrase_end(IF, at)
    if start is None and text.word(at) == "should" and text.word(at + 1) != "you":
        start = at + 1
    if text.word(at) == "after" and tells_when(text, at):
        _on_what_is_unseen(sentence, at, at + 1)
    if start is None:
        start = _while(sentence, at)
    if start is None:
        return None
    try:
        holds, end = condition(text, start, sentence.scope)
    except NotUnderstood:
        _on_what_is_unseen(sentence, at, start)
        raise
    _all_was_read(sentence, end)
    soon = as_soon_as(text, at, holds)
    if soon:
        return [*soon], end + (text.word(end) == COMMA)
    unless = text.word(at) == "unless"
    mention(holds, sentence.scope, met=not unless)
    spoken_of = sentence.scope.object
    end += text.word(end) == COMMA
    end += text.word(end) == "then"
    begun = end
    then, end = sequence(sentence.inner(), end)
    _one_is_it(text, (begun, end), holds)
    if not then:
        raise Unclear("What shall I do then?")
    skipped = end
    while text.word(skipped) in (COMMA, FULL_STOP) and skipped < len(text):
        skipped += 1
    skipped = other_case(text, end) or skipped
    otherwise = otherwise_end(text, skipped) or _complement_end(sentence, end, holds)
    other: list[Goal] = []
    if otherwise:
        if sentence.scope.object == spoken_of:
            mention(holds, sentence.scope, met=unless)
        nothing = nothing_end(text, otherwise)
        other, end = ([], nothing) if nothing else sequence(sentence.inner(), otherwise)
    if unless:
        then, other = other, then
    return [If(condition=holds, then=tuple(then), else_=tuple(other))], end


def _complement_end(sentence: Sentence, at: int, holds: Condition) -> int | None:
    """... ; *if it is off, ...*: where the case ends to be told that is left of the one before."""
    text = sentence.text
    start = other_case(text, at)
    if start is None:
        return None
    try:
        case, end = condition(text, start + 1, copy(sentence.scope))
    except ReadingError:
        return None
    return end + (text.word(end) == COMMA) if is_complement(holds, case) else None


def _all_was_read(sentence: Sentence, end: int) -> None:
    """Refuse a condition of which a part was not read: it would be dropped.

    Raises:
        NotUnderstood: That is so.
    """
    text = sentence.text
    said_of_it = told_end(text, end) if text.word(end) not in (COMMA, FULL_STOP, "then") else None
    if said_of_it is not None and said_of_it > end:  # a vase that leaks, a vase we can use
        raise NotUnderstood(f"I cannot check “{text.raw(end, said_of_it)}”")
    link = link_at(text, end)
    if link is None:
        return
    stop = link.start
    while stop < len(text) and text.word(stop) not in (COMMA, FULL_STOP):
        stop += 1
    if link.joint != ",":
        raise NotUnderstood(f"I cannot check “{text.raw(end, stop)}”")
    subject = noun_phrase(text, link.start)
    if subject is not None and text.word(subject.end) in ("is", "are") and stop < len(text):
        raise NotUnderstood(f"I cannot tell what “{text.raw(link.start, stop)}” is there for")


def _one_is_it(text: Text, clause: tuple[int, int], holds: Condition) -> None:
    """If the cup is here and the pen is there, bring *it*: which of them?

    Raises:
        Unclear: "It" may be either, and neither is held.
    """
    simple = list(simple_conditions(holds))
    held = [one for one in simple if isinstance(one, Holding) and not one.negated]
    things = {
        replace(one.object, at=None, relation=None)
        for one in simple
        if isinstance(one, Present | Holding) and one.object not in (None, ObjectQuery())
    }
    if len(things) < 2 or len(held) == 1:
        return
    for at in range(*clause):
        match = text.name_at(at)
        if match and match.of("object"):
            return
        if text.word(at) == "it":
            names = tuple(sorted(_named(one) for one in things))
            raise Unclear(f"What is “it”, {listing(names)}?", choices=names, said="it")


def _named(query: ObjectQuery) -> str:
    words = [query.size, query.color, query.name or query.category or "thing"]
    return " ".join(["the", *(word for word in words if word)])


def _while(sentence: Sentence, at: int) -> int | None:
    """*While Ada is here*, wave: only if she is; the link has been passed over."""
    text = sentence.text
    if text.word(at - 1) != "while" or text.word(at - 2) not in (COMMA, FULL_STOP):
        return None
    try:
        holds, end = condition(text, at, sentence.scope)
    except ReadingError:
        return None
    return at if isinstance(holds, Present) and text.word(end) == COMMA else None


def _on_what_is_unseen(sentence: Sentence, at: int, start: int) -> None:
    """If Ada is thirsty, ...: nothing that can be seen, and what is to be done then is clear.

    Raises:
        Partly: It asks whether to do it.
    """
    text = sentence.text
    end, of_person = start, text.word(start) in ("he", "she")
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        named = text.name_at(end)
        if named and named.of("person"):
            sentence.scope.mention(Person(name=named.of("person")))
            of_person = True
        end += 1
    if not of_person or text.word(end) != COMMA or sentence.depth or sentence.before:
        return
    then, _ = sequence(sentence.inner(), end + 1)
    if then:
        raise Partly(f"I cannot check “{text.raw(at, end)}”", tuple(then))
