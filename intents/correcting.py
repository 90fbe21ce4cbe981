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
_ADDS = re.compile(r"\b(?:also|too|as well|afterwards|next|after that)\b", re.IGNORECASE)
"""A sentence with one of these comes after the one before it, however it begins."""
_ANOTHER = re.compile(
    r"\W*(?:(?:oh|no|not that one|actually|rather|i mean|i meant|make (?:it|that)|better|oops|wait)"
    r"\W+)*(?P<what>(?:the|my|a|an) \w+(?: \w+){0,4}?)(?:\W+(?:instead|rather))?\W*",
    re.IGNORECASE,
)
"""Actually *the blue one*; *the blue one* instead."""
_INSTEAD = re.compile(r"\W+(?:instead|rather)\W*$", re.IGNORECASE)


def is_correction(text: str) -> bool:
    """Whether a sentence says that it takes the place of the one before it."""
    return bool(_CORRECTS.search(text)) and not _ADDS.search(text)


def in_full(text: str, before: Context, vocabulary: Vocabulary) -> str:
    """A correction as the grammar knows it: "the blue one instead" as "no, the blue one"."""
    if before.question is not None or not before.goals or not is_correction(text):
        return text
    other = _ANOTHER.fullmatch(text)
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
