"""How things are to be done for which no goal has a slot: at the same time, without an end, later.

Such words stand anywhere in a clause and fit no complement of any verb, so they are taken out
before it is read, and looked at again when its goals are known (:mod:`intents.english.aspects`).
What is to be said keeps them.
"""

from collections.abc import Sequence
from typing import Literal, NamedTuple

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import phrases, words
from intents.english.words.occasions import is_of_order

Kind = Literal["together", "endless", "later"]
_PHRASES: dict[Kind, frozenset[tuple[str, ...]]] = {
    "together": phrases(
        "at the same time,at the very same time,simultaneously,in parallel,concurrently,"
        "both at once,all at once,both at the same time,all at the same time,all the while,"
        "the whole time,all the time,throughout"
    ),
    "endless": phrases(
        "forever,for ever,forever and ever,for good,endlessly,continuously,continually,constantly,"
        "perpetually,incessantly,nonstop,over and over,over and over again,again and again,"
        "time and again,repeatedly,indefinitely,without end,without a break,without pause,"
        "without pausing,without interruption,until further notice,on and on,all day,"
        "all day long,all night,the whole day,many times,several times,countless times,"
        "a lot of times,lots of times,umpteen times,a million times,a zillion times,ad infinitum"
    ),
    "later": phrases(
        "tomorrow,tomorrow morning,tomorrow evening,first thing tomorrow,the day after tomorrow,"
        "next week,next month,tonight,this evening,this afternoon,tomorrow afternoon,"
        "at noon,at midnight,at dawn,at dusk,at lunchtime,at bedtime,at teatime,"
        "every minute,every hour,every day,every morning,every evening,every night,every week,"
        "every now and then,every so often,from time to time,now and then,now and again,hourly,"
        "daily"
    ),
}
_LONGEST = max(len(phrase) for table in _PHRASES.values() for phrase in table)
_SPEAKS = words("say tell announce shout whisper ask answer repeat recite sing inform remind wish")
_CLOCK = words("am pm o'clock oclock hours sharp")
_UNITS = words("second seconds minute minutes hour hours")


class Manner(NamedTuple):
    """Words that say how something is to be done, as they were said."""

    kind: Kind
    said: str


def manners(tokens: Sequence[Token]) -> tuple[list[Token], list[Manner]]:
    """The tokens without the words that say how, and these."""
    texts = [token.text for token in tokens]
    kept: list[Token] = []
    found: list[Manner] = []
    at = 0
    while at < len(tokens):
        kind, end = _manner_at(texts, at)
        owns = texts[end : end + 1] == ["'s"]  # tomorrow's meeting
        if kind is None or owns or _SPEAKS.intersection(texts[:at]):
            kept.append(tokens[at])
            at += 1
            continue
        if kind == "later" and not _is_of_order(texts, at, end):
            at = end
            continue
        found.append(Manner(kind, " ".join(token.raw for token in tokens[at:end] if token.raw)))
        if end < len(texts) and texts[end] == COMMA and (not kept or kept[-1].text == COMMA):
            end += 1
        at = end
    while kept and found and kept[-1].text in (COMMA, FULL_STOP):
        kept.pop()
    return (kept, found) if kept else (list(tokens), [])


def _is_of_order(texts: list[str], at: int, end: int) -> bool:
    """Whether what is said of when stands in an order: not in "he comes *tomorrow*"."""
    signs = (COMMA, FULL_STOP, "so", "because", "but")
    begin = next((n + 1 for n in range(at - 1, -1, -1) if texts[n] in signs), 0)
    stop = next((n for n in range(end, len(texts)) if texts[n] in signs), len(texts))
    before = " ".join(texts[begin:at])
    occasion = " ".join(texts[at:end])
    clause = " ".join(filter(None, (before, occasion, *texts[end:stop])))
    start = len(before) + bool(before)
    return is_of_order(clause, (start, start + len(occasion)))


def _manner_at(texts: list[str], at: int) -> tuple[Kind | None, int]:
    """What is said of how at a word, and where that ends."""
    for end in range(min(len(texts), at + _LONGEST), at, -1):
        phrase = tuple(texts[at:end])
        for kind, table in _PHRASES.items():
            if phrase in table:
                return kind, end
    word, figure, unit = (*texts[at : at + 3], "", "")[:3]
    by_clock = word == "at" and figure[:1].isdecimal() and unit in _CLOCK
    at_intervals = word == "every" and unit in _UNITS
    if by_clock or at_intervals:
        return "later", at + 3
    return None, at
