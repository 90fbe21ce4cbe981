"""What is told where it is first, told in the usual order: "on the left of the rack is a cap".

A noun knows what to make of all that is said behind it, on which side something is and under what;
so "under the bench there is a box" is read as "there is a box under the bench". What somebody left
is there: "if somebody left a cap in the hall".
"""

from collections.abc import Sequence

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import LOCATIVES, SUPERLATIVES, words
from intents.english.words.verbs import verbs_at

_SIGNS = (COMMA, FULL_STOP)
_OPENS = words("and so but if okay well look") | {*_SIGNS}
_ENDS = words("that which who whose with")
"""What says more of a thing, behind where it is."""
_IS = words("is are")
_SOME = words("a an some one two three four five six several another")
_WHETHER, _SOMEBODY = words("if whether"), words("somebody someone anybody anyone")
_HAS, _LEFT = words("has"), words("left forgot forgotten")
_ANY = words("a an any some")
_SIDES = ("leftmost", "rightmost", "highest", "lowest")
_LONGEST_START, _LONGEST_PLACE = 6, 10


def uninverted(tokens: list[Token]) -> list[Token]:
    """The tokens with what there is before where it is."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 2, 0, -1):
        there = said[at] == "there" and said[at + 1] in _IS
        bare = said[at] in _IS and said[at + 1] in _SOME
        if not (there or bare):
            continue
        stop = at - (said[at - 1] == COMMA and there)
        begin = max((n + 1 for n in range(stop) if said[n] in _OPENS), default=0)
        first = at + 1 + there
        end = _noun_end(said, first)
        if not _says_where(said, begin, stop) or end == first or (bare and not _closes(said, end)):
            continue
        is_there = tokens[at:first] if there else [Token("there", ""), tokens[at]]
        front, thing = tokens[begin:stop], tokens[first:end]
        tokens = [*tokens[:begin], *is_there, *thing, *front, *tokens[end:]]
        said = [token.text for token in tokens]
    return tokens


def left_behind(tokens: list[Token]) -> list[Token]:
    """The tokens with "if there is a mug" for *if somebody left a mug*."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 4, -1, -1):
        has = said[at + 2] in _HAS
        left, some = at + 2 + has, at + 3 + has
        somebody = said[at] in _WHETHER and said[at + 1] in _SOMEBODY
        if somebody and said[left] in _LEFT and some < len(said) and said[some] in _ANY:
            tokens = [*tokens[: at + 1], Token("there", ""), Token("is", ""), *tokens[some:]]
            said = [token.text for token in tokens]
    return tokens


def _closes(said: Sequence[str], at: int) -> bool:
    return at >= len(said) or said[at] in _SIGNS


def _says_where(said: list[str], begin: int, stop: int) -> bool:
    """Whether the words from one to another say where, and nothing else."""
    if not 1 < stop - begin <= _LONGEST_PLACE:
        return False
    starts = range(min(stop, begin + _LONGEST_START), begin, -1)
    phrases = [tuple(said[begin:end]) for end in starts]
    where = any(phrase in LOCATIVES for phrase in phrases)
    return where or any(SUPERLATIVES.get(phrase) in _SIDES for phrase in phrases)


def _noun_end(said: list[str], at: int) -> int:
    """Where what there is ends, before what says more of it."""
    end = at
    while end < len(said) and said[end] not in _ENDS and not _closes(said, end):
        goes_on = said[end] in ("and", "so", "but") and bool(verbs_at(said, end + 1))
        if goes_on or (said[end] in ("and", "so") and said[end + 1 : end + 2] == ["i"]):
            break
        end += 1
    return end
