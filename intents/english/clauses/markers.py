"""What is said before what is meant instead: "no wait", "I mean", "scratch that"."""

from intents.english.clauses.told import told_end
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.lexicon import phrases, words
from intents.english.words.repairs import TAKES_BACK
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_MARKERS = TAKES_BACK | phrases(
    "oh sorry,not that,wait,oh no,no not that,not that one,not this one,no not that one,"
    "no not this one,wrong one,on second thought,on second thoughts,strike that,change that,"
    "not there,scrap that,forget that,cancel that,i wanted to say,i was going to say,"
    "i wanted to ask for,what i meant was,what i mean is,what i meant is,i should have said,"
    "change of plan,change of plans,i tell a lie,hold on,hang on,just kidding,only kidding,jk,"
    "i take that back,that is wrong,my bad,silly me,stupid me,on reflection,come to think of it,"
    "i got that wrong,or no,what am i saying,that i think of it,that i think about it,pardon me,"
    "i beg your pardon,nah,nope,i misspoke,i said that wrong"
)
_LEADING = words("oh ah eh er uh um ach och well lol haha oops actually so ok okay wait sorry and")
"""What may stand between markers, and begins none by itself."""
_NEEDS_A_THING = phrases("make it,make that")
"""These change what is to be had: "make it *a lemonade*", not "make it quick"."""
_PAUSES = phrases("hold on,hang on")
OPENINGS = ("sorry", "oh", "wait", "pardon", "whoops")
"""Markers that open a new sentence as often as they take back the one before."""


def marker_end(text: Text, at: int) -> int | None:
    """Where the marker of a correction ends, if one begins at a word.

    What is only told may stand between two: "no wait, he had his nap, I mean the other room".
    """
    while text.word(at) in _LEADING and _marker(text, at) is None and at < len(text):
        at += 1 + (text.word(at + 1) == COMMA)
    end = _marker(text, at)
    if end is None or (text.word(at) == "wait" and text.word(end) != COMMA and end == at + 1):
        return None
    while True:
        following = end + (text.word(end) == COMMA)
        while text.word(following) in _LEADING and following < len(text):
            following += 1 + (text.word(following + 1) == COMMA)
        further = _marker(text, following)
        apart = following > end or text.word(end) == FULL_STOP
        following += text.word(following) == FULL_STOP
        told = _told_end(text, following) if apart and not further else None
        if told is not None and text.word(told) == COMMA and _marker(text, told + 1):
            further = told + 1
        elif told is not None and text.word(at) == "no" and verbs_at(text.words, told + 1):
            return told + 1  # no hang on, it is Ada who wants it, bring it to Ada
        if further is None:
            break
        end = further
    while text.word(end) in (COMMA, *OPENINGS):
        end += 1
    return end if end < len(text) else None


def _told_end(text: Text, at: int) -> int | None:
    """Where a statement ends, or a question one asks oneself: "what do I need a hammer for"."""
    if text.word(at) in ("what", "why", "how") and "i" in text.words[at + 1 : at + 4]:
        while at < len(text) and text.word(at) not in (COMMA, FULL_STOP):
            at += 1
        return at
    return told_end(text, at)


def _marker(text: Text, at: int) -> int | None:
    """Where one marker ends."""
    end = text.phrase_end(_MARKERS, at)
    if end is not None and tuple(text.words[at:end]) in _NEEDS_A_THING:
        phrase = noun_phrase(text, end)
        known = phrase is not None and phrase.name("object", "category", "place")
        return end if phrase is not None and (known or phrase.noun == "one") else None
    pause = end is not None and tuple(text.words[at:end]) in _PAUSES
    if end is not None and pause and text.word(end) not in (COMMA, FULL_STOP):
        return None  # hold on to the rail
    return end
