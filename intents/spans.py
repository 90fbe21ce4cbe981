"""Spans of time told by themselves: "pick it up, a minute, then put it down".

Where nothing is said to be done meanwhile, no reading has a slot for how long it is to last.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, tokenize
from intents.english.words.measures import Measure, measure
from intents.english.words.verbs import base_form, verbs_at

_LINKS = lexicon.words("and then but or so")
_AROUND = lexicon.words(
    "a an the of for in after within with about around only just another some more good full whole "
    "brief short long 's later afterwards thereafter that this which from now between before first "
    "next wait pause break rest stop delay gap silence time breather interval interlude breath"
)
"""What a span is told with: *after a pause of* ten seconds, a minute *'s wait first*."""
_LEADS = lexicon.words("in after for within")
"""A span behind one of these is told of an order, before it or behind it."""
_SUBJECTS = lexicon.words("i you he she it we they there the my his her our their your that this")
"""What a statement begins with: "in a minute *the* bus leaves"."""
_TAKES_BACK = lexicon.words("no nah nope sorry rather actually oops pardon")
"""*A minute*, no, two minutes."""
_SAME = 1e-3
_MOMENT_S = 1.0
"""A second is as little as nothing: "one sec, ..."."""


class Span(NamedTuple):
    """A span of time as it is said, in seconds, and whether it is told of nothing or of an order.

    It is ``bare`` if its clause says no more, and ``led`` if it says when or how long to do what.
    """

    said: str
    lasts_s: float
    bare: bool
    led: bool


def unkept_span(text: str, carried: Iterable[float]) -> str:
    """The span told in a text that is none of the numbers which its goals carry; empty if none is.

    Beside one that is carried another, told with an order, is the one that is taken back: "squat
    for 9 seconds but stop after 4 seconds".
    """
    numbers = list(carried)
    every = [(span, any(abs(n - span.lasts_s) < _SAME for n in numbers)) for span in spans(text)]
    some = any(kept for _, kept in every)
    lost = (s.said for s, kept in every if not kept and (s.bare or (s.led and not some)))
    return next(lost, "")


def spans(text: str) -> Iterator[Span]:
    """Each span of time in a text, be it but told of; none that is as little as nothing."""
    tokens = tokenize(text)
    words = [token.text for token in tokens]
    at = 0
    while at < len(words):
        found = measure(words, at)
        if found is None or found.kind != "time":
            at += 1
            continue
        if found.value > _MOMENT_S:
            said = " ".join(token.raw for token in tokens[at : found.end] if token.raw)
            bare, led = _is_bare(words, at, found), _is_led(words, at, found)
            yield Span(said, found.value, bare, led)
        at = found.end


def _is_bare(words: list[str], at: int, found: Measure) -> bool:
    """Whether a clause says no more than how long."""
    begin, end = at - 1, found.end
    while begin >= 0 and words[begin] in _AROUND:
        begin -= 1
    while end < len(words) and words[end] in _AROUND:
        end += 1
    taken_back = any(word in _TAKES_BACK for word in words[end : end + 2])
    order = bool(verbs_at(words, begin + 1))  # wait a minute
    return _ends(words, begin) and _ends(words, end) and not (taken_back or order)


def _is_led(words: list[str], at: int, found: Measure) -> bool:
    """*After five minutes* dim it; dim it *for an hour*; but: the bus leaves in an hour.

    Who is to come "here for a minute" is not told to leave after it.
    """
    if at == 0 or words[at - 1] not in _LEADS:
        return False
    if _ends(words, at - 2) and not _ends(words, found.end):
        return words[found.end] not in _SUBJECTS
    begin = at
    while not _ends(words, begin - 1):
        begin -= 1
    orders = verbs_at(words, begin) and base_form(words[begin]) == words[begin]
    return bool(orders) and words[at - 2] != "here" and _ends(words, found.end)


def _ends(words: list[str], at: int) -> bool:
    """Whether a clause ends, or has not begun, at a word."""
    return not 0 <= at < len(words) or words[at] in (COMMA, FULL_STOP) or words[at] in _LINKS
