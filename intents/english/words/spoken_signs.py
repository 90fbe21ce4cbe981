"""Signs that are spoken, as to whoever writes a dictation: "go to the hall full stop".

A program that writes what it hears may write them as words. "Full stop" is a cry to halt as well,
so it counts as a sign only where some words stand before it, and behind no article.
"""

import re

_SIGNS = (
    (r"question mark", "?"),
    (r"exclamation (?:mark|point)", "!"),
    (r"semi ?colon", ";"),
    (r"comma", ","),
    (r"new (?:line|paragraph)", "."),
    (r"(?<!\ba )(?<!the )full stop", "."),
    (r"(?<=[,.] )(?:period|end of(?: message| story)?)(?=\W*$)", "."),
)
_SPOKEN = tuple(
    (re.compile(rf"(?<=\w)[,.]?\s+{said}\b(?:\s*[.,!?;]+)?", re.IGNORECASE), sign)
    for said, sign in _SIGNS
)
_FIRST = re.compile(r"^\W*(?:new (?:line|paragraph)|quote|comma)\b\W*", re.IGNORECASE)
_QUOTED = re.compile(
    r"\b(?:open |begin )?quote\b\s*(?P<said>.+?)\s*\b(?:unquote|(?:close|end) quote)\b",
    re.IGNORECASE,
)
_WORDS = re.compile(r"[\w']+")
_FEWEST = 3
"""So many words stand before a sign in a dictation."""


def with_signs(text: str) -> str:
    """A text with the signs that are spoken in it as signs."""
    if len(_WORDS.findall(text)) < _FEWEST + 1:
        return text
    text = _QUOTED.sub(r'"\g<said>"', _FIRST.sub("", text))
    for spoken, sign in _SPOKEN:
        text = spoken.sub(sign, text)
    return text
