"""Which names of a sentence were taken back: those that another of their kind took the place of."""

import re
from collections.abc import Sequence

from intents.english.learnt.choice import Name
from intents.english.words.taking_back import behind_what_takes_back

_DENIED = re.compile(r"\bnot (?:(?:on|in|into|to|at|from|for) )?(?:(?:the|a|an|my|your|that) )?$")
"""Not (the) ... is what was said before, and not meant."""
_EVERY = re.compile(r"\b(?:all|every|everything|each|any|anything)\b")
"""Of all but one, that one is an exception, and not taken back."""
_REGRET = re.compile(r"^[^.!?]*\b(?:sorry|i mean|i meant|forgive me|my mistake|my bad)\W*$")
"""Behind what is meant."""


def takes_back(text: str) -> bool:
    """Whether some word of a text takes back what was said before it."""
    return behind_what_takes_back(text) is not None


def are_taken_back(text: str, names: Sequence[Name], gone: Sequence[Name]) -> bool:
    """Whether each lost name has one of its kind behind it, and words that take it back.

    "The master key, no, the *room key*", "not the master key, the *room key*", "in the bin. In the
    *sink*, sorry": the one that is kept has to come back in the goals, and to be said last.
    """
    text = text.lower()
    kept = [name for name in names if name not in gone]
    return all(
        any(
            one.sort == other.sort and text.find(one.said) < (last := text.rfind(other.said))
            and _is_between(text, text.rfind(one.said, 0, last), len(one.said), last)
            for other in kept
        )
        for one in gone
    )  # fmt: skip


def _is_between(text: str, begin: int, length: int, end: int) -> bool:
    """Whether what is named first is taken back: it is denied, or words for that follow it."""
    if begin < 0:
        return False
    if _DENIED.search(text[:begin]) and not _EVERY.search(text[:begin]):
        return True
    return takes_back(f"{text[begin + length : end]} .") or bool(_REGRET.search(text[end:]))


def what_is_meant(text: str, gone: Sequence[Name]) -> str:
    """What of a text stands behind all that was taken back."""
    behind = behind_what_takes_back(text)
    if behind is not None:
        return behind
    return text[max(text.lower().rfind(one.said) + len(one.said) for one in gone) :]
