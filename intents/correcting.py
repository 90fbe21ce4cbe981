"""What takes the place of what was said before: "no, the blue one", "the lower one instead"."""

from __future__ import annotations

import re

from intents.context import Context
from intents.goals import Goal, Place
from intents.outcomes import Refusal
from intents.parser import hear
from intents.vocabulary import Vocabulary

_CORRECTS = re.compile(
    r"^\W*(?:oh\W+)?(?:no(?!\s+(?:rush|hurry|problem|worr|need|matter|doubt|pressure|one|\w+s\b))|"
    r"nope|not|oops|actually|rather|i mean|i meant|make (?:it|that)|correction|scratch that|"
    r"wait(?=\s*,)|i(?: woul|')d rather|on second thoughts?)\b"
    r"|\b(?:instead|rather)\W*$",
    re.IGNORECASE,
)
_PLACE = (
    r"(?:on to|onto|on|in to|into|in|over to|back to|to|under|by|beside|next to|at) "
    r"(?:the|my|your|a|an|that|this) \w+(?: \w+){0,3}?"
)
_EXCUSED = re.compile(
    rf"^\W*(?:oh\W+)?(?:sorry|pardon(?: me)?|excuse me|whoops|oopsie|my (?:bad|mistake)|better|"
    rf"i (?:should have|wanted to) sa(?:id|y)|correction)\s*[,;:.!–—-]+\s*"
    rf"(?:(?:i mean|i meant|no|actually|rather)\W+)*"
    rf"(?!.*\b(?:is|are|was|were|has|have|needs?|looks?|seems?)\b)"
    rf"(?:{_PLACE}|(?:the|my|a|an) \w+(?: \w+){{0,3}}?)(?:\W+(?:please|instead|rather))*\W*$",
    re.IGNORECASE,
)
"""Sorry, *the table*: nothing but what is meant follows."""
_ELSEWHERE = re.compile(
    r"\W*(?:(?:oh|no|actually|rather|i mean|i meant|make (?:it|that)|better|oops|wait|sorry|pardon"
    r"|whoops|put (?:it|them|that)|on second thoughts?)\W+)*"
    rf"(?P<where>{_PLACE})(?:\W+(?:instead|rather|please|i mean|i meant))*\W*",
    re.IGNORECASE,
)
"""Actually, *on the table*; *to the table* instead."""
_IN_TURN = re.compile(
    r"^\W*(?:(?:and|but|please|with|do|take)\W+)*"
    r"(?P<what>the (?:\w+ ){0,3}?\w+ (?:first|last))\W*$",
    re.IGNORECASE,
)
"""*The red one first*, of several things that were asked for."""
_ADDS = re.compile(r"\b(?:also|too|as well|afterwards|next|after that)\b", re.IGNORECASE)
"""A sentence with one of these comes after the one before it, however it begins."""
_ANOTHER = re.compile(
    r"\W*(?:(?:oh|no|not that one|actually|rather|i mean|i meant|make (?:it|that)|better|oops|wait|"
    r"sorry|pardon|whoops|on second thoughts?)"
    r"\W+)*(?P<what>(?:the|my|a|an) \w+(?: \w+){0,4}?)(?:\W+(?:instead|rather))?\W*",
    re.IGNORECASE,
)
"""Actually *the blue one*; *the blue one* instead."""
_INSTEAD = re.compile(r"\W+(?:instead|rather)\W*$", re.IGNORECASE)


def is_correction(text: str) -> bool:
    """Whether a sentence says that it takes the place of the one before it."""
    found = _CORRECTS.search(text) or _EXCUSED.search(text)
    return bool(found) and not _ADDS.search(text)


def is_turn(text: str, before: Context) -> bool:
    """Whether a sentence only says which of what was asked for comes first, or last."""
    return before.question is None and bool(before.goals and _IN_TURN.match(text))


def in_full(text: str, before: Context, vocabulary: Vocabulary) -> str:
    """A correction as the grammar knows it: "the blue one instead" as "no, the blue one"."""
    if before.question is not None or not before.goals:
        return text
    if turn := _IN_TURN.match(text):
        return f"no, {turn['what']}"
    if not is_correction(text):
        return text
    other = _ANOTHER.fullmatch(text)
    where = _ELSEWHERE.fullmatch(text) if other is None else None
    if where is not None:
        return f"no, {where['where']}"
    if other is None:
        return _INSTEAD.sub("", text)
    place = _place_like(other["what"], before.goals[-1], vocabulary)
    if place:
        return f"no, on the {place}"
    as_said, _ = hear(text, vocabulary, context=before)
    return f"no, {other['what']}" if isinstance(as_said, Refusal) else text


def _place_like(what: str, last: Goal, vocabulary: Vocabulary) -> str:
    """The lower shelf, for "the lower one" after something was put on the upper shelf."""
    place = (last.on or last.in_) if isinstance(last, Place) else ""
    words = what.lower().split()
    if not place or words[-1] != "one" or len(words) != 3:
        return ""
    meant = f"{words[1]} {place.split()[-1]}"
    return meant if any(spot.name == meant for spot in vocabulary.places) else ""
