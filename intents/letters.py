"""Letters as people see them: what cannot be seen is no part of a word, what looks alike is alike.

What is pasted, spoken or written by a model holds characters that nobody sees (a soft hyphen, a
zero-width space, a mark of direction) and letters that are others than they seem. See Unicode
Technical Standard 39 for how many of either there are.
"""

import re
import unicodedata

_UNSEEN = re.compile(
    "["
    "\x00-\x08\x0e-\x1f\x7f-\x84\x86-\x9f"  # controls that are no blanks
    "\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u202a-\u202e\u2060-\u206f"
    "\u2800\u3164\ufe00-\ufe0f\ufeff\uffa0\ufff0-\ufffb\U0001bca0-\U0001bca3\U0001d173-\U0001d17a"
    "\U000e0000-\U000e0fff"
    "]+"
)
"""Default_Ignorable_Code_Point of Unicode's DerivedCoreProperties, and the empty braille cell."""
_SEQUENCE = re.compile(
    r"(?:\x1b\[|\x9b)[0-?]*[ -/]*[@-~]"  # CSI: colours, keys, the marks around a paste
    r"|(?:\x1b\]|\x9d)[^\x07\x1b\x9c\x9d]*+(?:\x07|\x1b\\|\x9c)"  # OSC: titles, links
    r"|\x1bO.|\x1b"
)
"""A control sequence (ECMA-48), or the escape of one that is none; none holds another."""
_MARKS = re.compile("[\u0300-\u036f\u0483-\u0489\u1ab0-\u1aff\u1dc0-\u1dff\u20d0-\u20ff]+")
"""Marks above, below and around Latin, Greek and Cyrillic letters."""
_LIKE = {
    "a": "аАαΑᴀ", "b": "вВβΒ", "c": "сСϲ", "d": "ԁđ", "e": "еЕεΕᴇ", "f": "ƒ", "h": "һНΗʜ",
    "i": "іІιΙıɪ", "j": "јЈᴊ", "k": "кКκΚᴋ", "l": "ӏłʟ", "m": "мМΜᴍ", "n": "пηɴ", "o": "оОοΟօøᴏ",
    "p": "рРρΡᴘ", "q": "ԛ", "r": "гʀ", "s": "ѕЅƽʂꜱ", "t": "тТτΤŧᴛ", "u": "υսᴜ", "v": "νѵᴠ",
    "w": "ԝᴡ", "x": "хХχΧ", "y": "уУΥүγ", "z": "Ζᴢ",
}  # fmt: skip
"""Letters of other scripts that look like a Latin one in a common typeface."""
_ALIKE = str.maketrans({like: letter for letter, those in _LIKE.items() for like in those})
_LETTERS = {
    first + n: chr(ord("a") + n)
    for first in (0x1F150, 0x1F170, 0x1F1E6)  # in circles, in boxes, of flags
    for n in range(26)
}
_WORD = re.compile(r"[^\W_]+")


def without_sequences(text: str) -> str:
    """A text without what only tells a terminal how to show it."""
    return _SEQUENCE.sub("", text)


def seen(text: str) -> str:
    """A text without what cannot be seen; what is written wide, bold or in circles is plain."""
    plain = _UNSEEN.sub("", unicodedata.normalize("NFKC", without_sequences(text)))
    return _MARKS.sub("", plain)


def bare(text: str) -> str:
    """A text as `seen`, in lower case and without accents."""
    parts = unicodedata.normalize("NFKD", text)
    left = (c for c in _UNSEEN.sub("", parts) if unicodedata.category(c) not in ("Mn", "Me"))
    return unicodedata.normalize("NFC", "".join(left).casefold())


def latin(text: str) -> str:
    """A text with the Latin letters that others look like in their place."""
    return text.translate(_LETTERS).translate(_ALIKE)


def unmixed(text: str) -> str:
    """A text whose words of Latin letters have no others among them that only look like them."""
    if text.isascii():
        return text
    return _WORD.sub(lambda word: _unmixed(word[0]), text)


def _unmixed(word: str) -> str:
    mixed = not word.isascii() and any(c.isascii() and c.isalpha() for c in word)
    plain = latin(word) if mixed else word
    return plain if plain.isascii() else word
