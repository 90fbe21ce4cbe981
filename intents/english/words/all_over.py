"""The home as a whole: "in the house", "anywhere in the whole flat" is wherever there is anything.

No vocabulary has a place of that name, and nothing is said by it that the order without it does not
say; a count is then of all there are ("how many cups are there *in the house*?").
"""

from __future__ import annotations

from collections.abc import Callable

from intents.english.words import lexicon
from intents.english.words.lexer import Token
from intents.english.words.names import NameIndex

_HOMES = lexicon.words("house flat apartment home building premises")
_WHOLE = lexicon.words("whole entire complete")
_LOOSELY = lexicon.words("somewhere anywhere everywhere someplace wherever all")
_INSIDE = lexicon.words("in inside within throughout over across")
_OWNED = lexicon.words("the this our my your")
_ALONE = lexicon.phrases("everywhere,anywhere,altogether,all in all,all together,in total,in all")
_SEEKS = lexicon.words("look search looking searching hunt")
_THINGS = ("object", "category")
_LONGEST = 3


def all_over(
    tokens: list[Token], index: NameIndex, in_message: Callable[[list[str]], bool]
) -> tuple[list[Token], bool]:
    """The tokens without what names the home as a whole, and whether there was any.

    Args:
        tokens: The sentence.
        index: Names of the vocabulary; where one of them is called so, it is meant.
        in_message: Whether what comes behind some words is part of what is to be told.
    """
    words = [token.text for token in tokens]
    for at in range(1, len(words)):
        end = _end(words, at, index)
        if end is None or in_message(words[:at]):
            continue
        sought = words[at - 1] in _SEEKS and words[end : end + 1] == ["for"]
        found = (index.match(words, n) for n in range(at))
        if sought or any(match is not None and match.of(*_THINGS) for match in found):
            return [*tokens[:at], *tokens[end:]], True
    return tokens, False


def _end(words: list[str], at: int, index: NameIndex) -> int | None:
    """Where words for the whole home end that begin here."""
    start = at + (words[at] in _LOOSELY)
    if words[start : start + 1] and words[start] in _INSIDE:
        noun = start + 1 + (words[start + 1 : start + 2] != [] and words[start + 1] in _OWNED)
        whole = noun < len(words) and words[noun] in _WHOLE
        noun += whole
        known = any(index.match(words, n) is not None for n in range(start + 1, noun + 1))
        if noun < len(words) and (whole or words[noun] in _HOMES) and not known:
            return noun + 1
    for end in range(min(len(words), at + _LONGEST), at, -1):
        if tuple(words[at:end]) in _ALONE and "or" not in words[:at]:
            return end
    return None
