"""Texts that are nothing but a cry, in any of several languages."""

import re
from collections.abc import Iterable, Mapping

from intents.letters import bare, latin

_LOOKED_AT = 80
"""Characters: whoever cries for longer says it with words of English too."""
_STEM_WITHIN = 14
"""Characters of a text without blanks in which a stem may stand anywhere."""
_CLAUSE = re.compile(r"[.!?,;:\n\r¡¿。！？、，।…]+")
_WORD = re.compile(r"[^\s.,!?;:¡¿。、！？，।…\"“”«»()*~-]+")
"""With the marks of vowels that Indian letters have, which are no letters themselves."""


class WholeCries:
    """Phrases that count where a clause has nothing else in it but what goes with them."""

    def __init__(self, table: Mapping[str, str], *, stems: str, around: str) -> None:
        """Take phrases by language, stems that stand anywhere, and words that may stand around."""
        self._phrases = frozenset(_each(table.values()))
        self._around = frozenset(_each([around]))
        self._stems = tuple(bare(stem) for stem in stems.split())
        self._longest = max(map(len, self._phrases | self._around))

    def cried(self, plain: str) -> bool:
        """Whether a text (as of :func:`intents.letters.bare`) is such a cry from end to end."""
        if len(plain) > _LOOKED_AT:
            return False
        short = plain.strip()
        stems = self._stems if not short.isascii() and len(short) <= _STEM_WITHIN else ()
        if any(stem in short for stem in stems):
            return True
        clauses = [_spaced(clause) for clause in _CLAUSE.split(plain)]
        said = [clause for clause in clauses if clause and not self._is_around(clause)]
        return bool(said) and self._reads(said[0])

    def _is_around(self, clause: tuple[str, ...]) -> bool:
        return clause not in self._phrases and all((word,) in self._around for word in clause)

    def _reads(self, clause: tuple[str, ...]) -> bool:
        """Whether phrases and what goes with them fill a clause, with a phrase among them."""
        at, cries = 0, False
        while at < len(clause):
            ends = range(min(len(clause), at + self._longest), at, -1)
            said = next((end for end in ends if clause[at:end] in self._phrases), None)
            cries = cries or said is not None
            end = said or next((end for end in ends if clause[at:end] in self._around), None)
            if end is None:
                return False
            at = end
        return cries


def _each(lists: Iterable[str]) -> list[tuple[str, ...]]:
    """Every phrase as its words; those with letters that look like Latin ones in both ways."""
    plain = [bare(phrase) for phrases in lists for phrase in phrases.split(",")]
    return [_spaced(one) for phrase in plain for one in {phrase, latin(phrase)}]


def _spaced(phrase: str) -> tuple[str, ...]:
    """The words of a phrase, what is written with a hyphen as two."""
    return tuple(_WORD.findall(phrase))
