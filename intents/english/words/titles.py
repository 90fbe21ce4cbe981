"""Titles before a name that the world has without one: "find Mr Weber", "a Doctor Lund"."""

from intents.english.words import lexicon
from intents.english.words.lexer import FULL_STOP, Token
from intents.english.words.names import NameIndex

_TITLES = lexicon.words(
    "mr mrs ms miss mister missus dr doctor prof professor sir madam nurse uncle auntie aunt "
    "cousin señor señora herr frau monsieur madame"
)


_HONOURS = lexicon.words("sir madam ma'am maam ji bhai sahib saab didi")
"""What some say behind the name of somebody: "tell Ada madam that ..."."""


def without_titles(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens without titles that belong to no name of the world."""
    words = [token.text for token in tokens]
    if _TITLES.isdisjoint(words) and _HONOURS.isdisjoint(words):
        return tokens
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        after = at + 1 + (words[at + 1 : at + 2] == [FULL_STOP])
        titled = words[at] in _TITLES and after < len(words)
        if titled and not _is_person(words, at, index) and _is_person(words, after, index):
            if kept and kept[-1].text in ("a", "an", "the"):
                kept.pop()  # a Mr Weber
            at = after
            continue
        behind = words[at] in _HONOURS and at > 0 and _is_person(words, at - 1, index)
        if not behind or _is_person(words, at, index):
            kept.append(tokens[at])
        at += 1
    return kept


def _is_person(words: list[str], at: int, index: NameIndex) -> bool:
    match = index.match(words, at)
    return match is not None and match.of("person") is not None
