"""On what occasion something is to be done, or how often: "every evening", "daily at six", "later".

Goals are done once, at once. An occasion in the clause of an order, or in one of its own, that no
goal waits for is asked about, whatever reading passed it over. What is only told of ("we dine at
six", "he comes tomorrow") is none of an order.
"""

import re
from collections.abc import Iterable

from intents.english.words.names import NameIndex
from intents.english.words.occasions import occasions
from intents.goals import (
    Answer,
    Ask,
    Cancel,
    Count,
    Find,
    Goal,
    If,
    LookAt,
    Pause,
    Report,
    Resume,
    Say,
    Stop,
    Tell,
    each,
)

_DONE_NOW = (
    Answer, Ask, Cancel, Count, Find, LookAt, Pause, Report, Resume, Say, Stop, Tell,
)  # fmt: skip


def missed(text: str, goals: Iterable[Goal], index: NameIndex) -> str:
    """The occasion that is told in a text for an order, where goals are done at once; else empty.

    Args:
        text: What was said.
        goals: What it was read as; what only looks, tells or waits may be done at once.
        index: The names of this world, in which a word like "Sunday" may stand.
    """
    every = list(each(tuple(goals)))
    if any(isinstance(goal, If | Say | Ask | Answer) for goal in every):
        return ""
    if all(isinstance(goal, _DONE_NOW) for goal in every):
        return ""
    lower = text.lower()
    if next(occasions(lower), None) is None:
        return ""  # what is found in a name counts for nothing, and is looked for only then
    plain = _nameless(" ".join(lower.replace("’", "'").split()), index)
    return next(occasions(plain), "")


def _nameless(plain: str, index: NameIndex) -> str:
    """A text with a blank for each name of the world: the *Sunday paper*, the *evening dress*."""
    words = list(re.finditer(r"[a-z0-9']+", plain))
    said, cut = [word.group() for word in words], [*plain]
    for at, word in enumerate(words):
        match = index.match(said, at)
        if match is not None and match.end - at > 1:
            last = words[match.end - 1]
            cut[word.start() : last.end()] = "x" * (last.end() - word.start())
    return "".join(cut)
