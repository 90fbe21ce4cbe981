"""How words sound that the dictionary does not have: names of people, places, products.

In this order: two known words in one ("side-board"), a known word with an ending, and the usual
sounds of letters. The phones are those of the CMU dictionary.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from intents.english.words.lexicon import words

Lookup = Callable[[str], str | None]
"""The phones of a word of the dictionary ("K AH1 P" or "K AH P"), None if it has none."""
_PART = 3
"""A shorter word is no part of another."""
_VOICELESS = words("P T K F TH")
_HISSING = words("S Z SH ZH CH JH")
_DIGITS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")

_ALSO = (("AO L T", "AA L T"), ("OW L", "AH UH L"))
"""Sounds that others make otherwise, where the model takes it for another word: "halt" of those who
say "cot" and "caught" alike, "bowl" of the British."""

_SOUNDS: tuple[tuple[str, str], ...] = (
    ("tion", "SH AH N"), ("sion", "ZH AH N"), ("ough", "AO"), ("augh", "AO"), ("eigh", "EY"),
    ("tch", "CH"), ("sch", "SH"), ("dge", "JH"), ("igh", "AY"), ("eau", "OW"), ("oor", "AO R"),
    ("our", "AO R"), ("air", "EH R"), ("ear", "IH R"), ("eer", "IH R"), ("ier", "IH R"),
    ("qu", "K W"), ("ch", "CH"), ("sh", "SH"), ("th", "TH"), ("ph", "F"), ("gh", "G"),
    ("wh", "W"), ("ck", "K"), ("ng", "NG"), ("kn", "N"), ("wr", "R"), ("dg", "JH"), ("sz", "S"),
    ("cz", "CH"), ("zh", "ZH"), ("kh", "K"), ("ae", "EY"), ("ai", "EY"), ("ay", "EY"),
    ("au", "AO"), ("aw", "AO"), ("ea", "IY"), ("ee", "IY"), ("ei", "AY"), ("ey", "IY"),
    ("eu", "Y UW"), ("ew", "UW"), ("ie", "IY"), ("iy", "IY"), ("oa", "OW"), ("oe", "OW"),
    ("oi", "OY"), ("oo", "UW"), ("ou", "AW"), ("ow", "OW"), ("oy", "OY"), ("ue", "UW"),
    ("ui", "UW"),
    ("ar", "AA R"), ("er", "ER"), ("ir", "ER"), ("or", "AO R"), ("ur", "ER"),
    ("bb", "B"), ("cc", "K"), ("dd", "D"), ("ff", "F"), ("gg", "G"), ("kk", "K"), ("ll", "L"),
    ("mm", "M"), ("nn", "N"), ("pp", "P"), ("rr", "R"), ("ss", "S"), ("tt", "T"), ("zz", "Z"),
    ("b", "B"), ("d", "D"), ("f", "F"), ("g", "G"), ("h", "HH"), ("j", "JH"), ("k", "K"),
    ("l", "L"), ("m", "M"), ("n", "N"), ("p", "P"), ("q", "K"), ("r", "R"), ("s", "S"),
    ("t", "T"), ("v", "V"), ("w", "W"), ("x", "K S"), ("z", "Z"),
)  # fmt: skip
"""Letters to phones; the first that fits is taken."""
_SHORT = {"a": "AE", "e": "EH", "i": "IH", "o": "AA", "u": "AH", "y": "IH"}
_LONG = {"a": "EY", "e": "IY", "i": "AY", "o": "OW", "u": "UW", "y": "AY"}
_LAST = {"a": "AH", "e": "IY", "i": "IY", "o": "OW", "u": "UW", "y": "IY"}
_SPLIT_E = re.compile(r"[bcdfgklmnprstvz]es?$")
"""A consonant and a silent e: the vowel before it is long."""


def pronounce(word: str, lookup: Lookup) -> str:
    """The phones of a word, with spaces between; never empty for a word with a letter or digit.

    Args:
        word: lower case; signs in it are passed over.
        lookup: the dictionary.
    """
    known = lookup(word)
    if known:
        return known
    parts = re.findall(r"[a-z]+|\d", word)
    if len(parts) > 1 or (parts and parts[0] != word):
        spoken = [_DIGITS[int(part)] if part.isdigit() else part for part in parts]
        return " ".join(pronounce(part, lookup) for part in spoken)
    return _compound(word, lookup) or _ended(word, lookup) or by_letters(word)


def variants(phones: str) -> list[str]:
    """How else a word may sound.

    >>> variants("B OW L"), variants("K AH P")
    (['B AH UH L'], [])
    """
    made = (re.sub(rf"\b{usual}\b", other, phones) for usual, other in _ALSO)
    return [one for one in made if one != phones]


def _compound(word: str, lookup: Lookup) -> str:
    """Two known words in one; the longer the first the better."""
    for split in range(len(word) - _PART, _PART - 1, -1):
        first, second = lookup(word[:split]), lookup(word[split:])
        if first and second:
            return f"{first} {second}"
    return ""


def _ended(word: str, lookup: Lookup) -> str:
    """A known word in the plural."""
    for ending in ("es", "s"):
        stem = lookup(word.removesuffix(ending)) if word.endswith(ending) else None
        if stem:
            last = stem.split()[-1].rstrip("012")
            if last in _HISSING:
                return f"{stem} IH Z"
            return f"{stem} {'S' if last in _VOICELESS else 'Z'}"
    return ""


def by_letters(word: str) -> str:
    """The usual sounds of the letters of a word."""
    phones: list[str] = []
    at = 0
    while at < len(word):
        spelled, sound = _sound(word, at)
        phones += sound.split()
        at += spelled
    return " ".join(phones) or "AH"


def _sound(word: str, at: int) -> tuple[int, str]:
    """How many letters make the next sound, and which."""
    letter, rest = word[at], word[at:]
    if letter == "c":
        if rest.startswith(("ch", "ck", "cc", "cz")):
            return next((len(s), p) for s, p in _SOUNDS if rest.startswith(s))
        return 1, "S" if rest[1:2] in ("e", "i", "y") and rest[1:2] else "K"
    if letter == "y" and at == 0 and len(word) > 1:
        return 1, "Y"
    for spelled, sound in _SOUNDS:
        if rest.startswith(spelled):
            return len(spelled), sound
    return _vowel(word, at)


def _vowel(word: str, at: int) -> tuple[int, str]:
    letter, rest = word[at], word[at + 1 :]
    if letter not in _SHORT:
        return 1, ""
    if not rest:
        spoken_before = any(c in _SHORT for c in word[:at])
        return 1, "" if letter == "e" and spoken_before else _LAST[letter]
    if _SPLIT_E.fullmatch(rest):
        return 1, _LONG[letter]
    if letter == "i" and rest[0] in "ao":
        return 1, "IY"
    return 1, _SHORT[letter]
