"""Conditions before what hangs on them: "if the cup is not there, bring the mug"."""

from intents.english.clauses.conditions import IF, as_soon_as, condition, mention
from intents.english.clauses.openings import otherwise_end
from intents.english.reading import Found, Sentence
from intents.english.sequences import sequence
from intents.english.trouble import Unclear
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.goals import Goal, If


def conditional(sentence: Sentence, at: int) -> Found | None:
    """If the cup is not there, bring the mug, otherwise wait."""
    text = sentence.text
    start = text.phrase_end(IF, at)
    if start is None and text.word(at) == "should" and text.word(at + 1) != "you":
        start = at + 1
    if start is None:
        return None
    holds, end = condition(text, start, sentence.scope)
    soon = as_soon_as(text, at, holds)
    if soon:
        return [soon], end + (text.word(end) == COMMA)
    unless = text.word(at) == "unless"
    mention(holds, sentence.scope, met=not unless)
    spoken_of = sentence.scope.object
    end += text.word(end) == COMMA
    end += text.word(end) == "then"
    then, end = sequence(sentence.inner(), end)
    if not then:
        raise Unclear("What shall I do then?")
    skipped = end
    while text.word(skipped) in (COMMA, FULL_STOP) and skipped < len(text):
        skipped += 1
    otherwise = otherwise_end(text, skipped)
    other: list[Goal] = []
    if otherwise:
        if sentence.scope.object == spoken_of:
            mention(holds, sentence.scope, met=unless)
        other, end = sequence(sentence.inner(), otherwise)
    if unless:
        then, other = other, then
    return [If(condition=holds, then=tuple(then), else_=tuple(other))], end
