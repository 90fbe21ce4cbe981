"""Whether a sentence has the form of a statement through and through: "oh no, the bell came off".

A statement may well hint at something to be done; but nobody asked for it, so what a guess at other
words makes of it ("switch off the bell") is offered at most.
"""

from intents.english.clauses.parentheses import INTERJECTIONS
from intents.english.clauses.told import told_end
from intents.english.clauses.wishes import WISHES
from intents.english.words import lexicon
from intents.english.words.courtesy import ADDRESSES
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.requests import ASKS_IN_STATEMENTS
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at

_OPENINGS = (
    INTERJECTIONS | ADDRESSES | lexicon.words("so well and but no yes okay ok hey right now")
)
_SIGNS = (COMMA, FULL_STOP)
_LINKS = lexicon.words("but so and then anyway anyhow just now , .")


def only_tells(text: Text) -> bool:
    """Whether every clause is a statement, or a cry, and none has a word that asks."""
    if not ASKS_IN_STATEMENTS.isdisjoint(text.words) or any(
        _orders(text, at) for at in range(1, len(text))
    ):
        return False
    at, told = 0, False
    while at < len(text):
        if text.word(at) in _SIGNS or text.word(at) in _OPENINGS:
            at += 1
            continue
        end = None if text.phrase_end(WISHES, at) else told_end(text, at)
        if end is None or end <= at:
            return False
        at, told = end, True
    return told


def _orders(text: Text, at: int) -> bool:
    """I was going to do it myself, but *take it to Ada*: whether an order begins at a word."""
    follows = text.word(at - 1) in _LINKS and base_form(text.word(at)) == text.word(at)
    return follows and bool(verbs_at(text.words, at))
