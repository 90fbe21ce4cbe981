"""Boards of a piece of furniture that have a name of their own: "the upper board of the bookcase".

Where the world has an "upper bookcase" and a "lower bookcase", a level of the bookcase is one of
them, said before it or behind it.
"""

from intents.english.phrases.phrase import NounPhrase
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA
from intents.english.words.lexicon import LEVELS
from intents.english.words.text import Text


def board_of(text: Text, phrase: NounPhrase, inner: NounPhrase) -> int | None:
    """The upper board *of the bookcase*, where the world has an "upper bookcase"."""
    level, _, noun = phrase.said.rpartition(" ")
    if noun not in lexicon.BOARDS or not inner.name("place"):
        return None
    if not _is_board(text, phrase, phrase.level or level, inner.said):
        return None
    phrase.places += inner.places
    return inner.end


def board_after(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """The bookcase, *top board*; the bookcase, *on its second shelf*."""
    if not phrase.name("place"):
        return None
    at += text.word(at) == COMMA
    at += text.word(at) in ("on", "at")
    at += text.word(at) in ("the", "its")
    if text.word(at + 1) not in lexicon.BOARDS:
        return None
    return at + 2 if _is_board(text, phrase, text.word(at), phrase.said) else None


def _is_board(text: Text, phrase: NounPhrase, level: str, furniture: str) -> bool:
    """Name the board of a piece of furniture in a phrase; whether the world has such a one."""
    for word in LEVELS.get(level, ()):
        named = text.index.exact(f"{word} {furniture}") or text.index.exact(f"{furniture} {word}")
        if named:
            phrase.noun, phrase.names, phrase.exact = "name", named, True
            phrase.level = phrase.side = ""
            phrase.said = f"{word} {furniture}"
            return True
    return False
