"""A sentence as the network reads it: its words in pieces, and what it may point at."""

import re
from collections.abc import Sequence
from typing import Literal, NamedTuple

from intents.english.learnt.looks import Said
from intents.english.words import lexicon
from intents.english.words.names import Kind, NameIndex

Sort = Literal["word", "sign", "object", "category", "place", "room", "person", "several"]
SORTS: tuple[Sort, ...] = (
    "word", "sign", "object", "category", "place", "room", "person", "several",
)  # fmt: skip
_WORD = re.compile(r"[A-Za-z]+|[0-9]+(?:\.[0-9]+)?|['’][A-Za-z]+|[^\sA-Za-z0-9]")


class Unit(NamedTuple):
    """What may be pointed at: a name of the world, or a word.

    Attributes:
        start: Its first word.
        end: The word behind it.
        sort: What it is.
        said: It as it stands in the sentence.
        names: The names that it can stand for; empty for a word.
        is_whole: Whether it is a whole name, not a part of one.
    """

    start: int
    end: int
    sort: Sort
    said: str
    names: tuple[str, ...] = ()
    is_whole: bool = True

    @property
    def meant(self) -> str:
        """It in plain words: the name where it can be only one."""
        return self.names[0] if self.is_whole and len(self.names) == 1 else self.said


def words_of(text: str) -> list[Said]:
    """The words and signs of a text; "she's" is two of them."""
    return [Said(m.start(), m.end(), m.group()) for m in _WORD.finditer(text)]


def units(words: Sequence[Said], index: NameIndex) -> list[Unit]:
    """All that a sentence consists of, in order."""
    plain = [word.raw.lower().replace("’", "'") for word in words]
    found: list[Unit] = []
    at = 0
    while at < len(plain):
        unit = _name(plain, at, index)
        if unit is None:
            sort: Sort = "word" if plain[at][0].isalnum() else "sign"
            unit = Unit(at, at + 1, sort, plain[at])
        found.append(unit)
        at = unit.end
    return found


def _name(plain: list[str], at: int, index: NameIndex) -> Unit | None:
    """The name of the world that begins at a word."""
    if not plain[at][0].isalpha():
        return None
    little = plain[at] in lexicon.FUNCTION_WORDS
    match = index.match(plain, at)
    if match and not (match.end == at + 1 and little):
        return _unit(plain, at, match.end, [(n.kind, n.name) for n in match.names], whole=True)
    parts = () if little else index.partial(plain[at])
    if parts:
        return _unit(plain, at, at + 1, [(n.kind, n.name) for n in parts], whole=False)
    return None


def _unit(
    plain: list[str], start: int, end: int, names: list[tuple[Kind, str]], *, whole: bool
) -> Unit:
    kinds = {kind for kind, _ in names}
    sort: Sort = names[0][0] if len(kinds) == 1 else "several"
    said = " ".join(plain[start:end])
    return Unit(start, end, sort, said, tuple(dict.fromkeys(n for _, n in names)), whole)
