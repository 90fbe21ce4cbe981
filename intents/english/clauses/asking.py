"""Asking somebody something for whoever speaks: "ask Ines if the results are there"."""

from msgspec.structs import replace

from intents.english.clauses.openings import skip_openings
from intents.english.phrases.complements import connector_end, ends_clause
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import ME, Scope, is_person, to_person
from intents.english.reading import Found
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Ask, Person

_INDIRECT = lexicon.WH | lexicon.words("if whether")
"""How what is to be asked begins."""
_ANSWERED = lexicon.phrases(
    "what she says,what he says,what they say,what she said,what he said,what they said,"
    "what she answers,what he answers,what they answer,what she answered,what he answered,"
    "what they answered,what she replies,what he replies,what she replied,what he replied,"
    "what she thinks,what he thinks,what they think,what the answer is,what the answer was,"
    "what her answer is,what his answer is,what their answer is,"
    "the answer,her answer,his answer,their answer,her reply,his reply,their reply,the reply"
)
"""What somebody said who was asked."""


def asking(text: Text, at: int, scope: Scope) -> Found | None:
    """Ask *Ines if the lab results have arrived*; None if it is not that."""
    phrase = noun_phrase(text, at)
    if phrase is None or not is_person(phrase, scope):
        return None
    start = phrase.end + (text.word(phrase.end) == COMMA)
    person = to_person(phrase, scope)
    if person == ME or text.word(start) not in _INDIRECT:
        return None
    end = _question_end(text, start)
    if end < start + 2:  # ask Ines why: nothing that she could know
        return None
    return [Ask(person=person, what=text.raw(start, end))], end


def _question_end(text: Text, at: int) -> int:
    """Where the question ends: at a full stop, or where something else is to be done."""
    end = at + 1
    while end < len(text) and text.word(end) != FULL_STOP:
        after = end + 1 if text.word(end) == COMMA else connector_end(text, end)
        if after is not None and text.word(end) == COMMA:
            after = connector_end(text, after) or after
        if after and verbs_at(text.words, skip_openings(text, after)):
            break
        end += 1
    return end


def answer_told(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """... *and tell Dr Haas what she says*: who was asked before, now with who is told of it."""
    end = text.phrase_end(_ANSWERED, at)
    if end is None or not ends_clause(text, end) or not isinstance(scope.last, Ask):
        return None
    return [replace(scope.last, to=to or ME)], end
