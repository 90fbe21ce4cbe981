"""Which one it is, told behind it: "bring the leash, *it's the one hanging left of the lamp*".

What singles a thing out is a part of its description wherever it is said, so it is put where a
description stands: "bring the leash hanging left of the lamp". Where it is not clear of which of
several things it is said, it is left where it is, and the law of faithfulness asks about it.
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import COLORS, DETERMINERS, LOCATIVES, ONES, SIZES, words
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_SIGNS = (COMMA, FULL_STOP)
_IT_IS = (["it", "is"], ["that", "is"], ["they", "are"], ["those", "are"], ["this", "is"],
          ["i", "mean"], ["that", "would", "be"], ["it", "will", "be"])  # fmt: skip
_LIES = words(
    "hanging lying standing sitting leaning resting hidden sits lies stands hangs stood sat "
    "propped parked perched tucked"
)
"""How it is said of a thing that it is somewhere."""
_RELATIVE = words("that which who")
_HOW = frozenset(phrase[0] for phrase in LOCATIVES)
_MARKS = frozenset(COLORS) | frozenset(SIZES)
_LINKS = words("and then so or but please")
_DENIES = words("not no except but nor without")
_LONGEST = 14


def singled_out(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with what says which one is meant behind the thing that it is said of."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 3, 0, -1):
        first = _telling(said, at)
        if first is None or _DENIES.intersection(said[_begin(said, at) : at]):
            continue
        end = next((n for n in range(first, len(said)) if said[n] in _SIGNS), len(said))
        names = _things(said, _begin(said, at), at, index)
        marked = said[first] in _MARKS
        orders = any(_orders(said, n) for n in range(first + 1, end))
        if end - first > _LONGEST or len(names) != 1 or orders:
            continue
        start, close = names[0]
        moved = tokens[first : first + 1] if marked else tokens[first:end]
        where = start if marked else close
        tokens = [*tokens[:where], *moved, *tokens[where:at], *tokens[end:]]
        said = [token.text for token in tokens]
    return tokens


def _orders(said: list[str], at: int) -> bool:
    """Whether an order is linked on at a word: "the one on the bar *and take* it away"."""
    return said[at] in FIRST_WORDS and said[at - 1] in _LINKS


def _telling(said: list[str], at: int) -> int | None:
    """Where in a clause that begins behind a sign it begins to be said which one is meant."""
    if said[at] not in _SIGNS:
        return None
    n = at + 1
    n += next((len(it) for it in _IT_IS if said[n : n + len(it)] == it), 0)
    stated = n > at + 1
    if said[n : n + 1] != ["the"] or n + 2 >= len(said):
        return None
    if said[n + 1] in _MARKS and said[n + 2] in ONES and stated:
        closes = n + 3 == len(said) or said[n + 3] in _SIGNS
        return n + 1 if closes else None
    if said[n + 1] not in ONES or not (stated or said[n + 2] in _LIES | _RELATIVE):
        return None
    n += 2
    if said[n] in _RELATIVE and said[n + 1 : n + 2] in (["is"], ["are"], ["'s"]):
        n += 2
    elif said[n] in _RELATIVE:
        n += 1
    lies = said[n : n + 1] != [] and said[n] in _LIES
    where = n + lies < len(said) and said[n + lies] in _HOW
    return n if where else None


def _begin(said: list[str], at: int) -> int:
    """Where the clause before a sign begins."""
    return max((n + 1 for n in range(at) if said[n] in _SIGNS), default=0)


def _things(said: list[str], begin: int, end: int, index: NameIndex) -> list[tuple[int, int]]:
    """From where to where the things stand that are named between two words."""
    found: list[tuple[int, int]] = []
    at = begin
    while at < end:
        match = index.match(said, at) if said[at] not in DETERMINERS else None
        if match is not None and match.end <= end:
            if match.of("object", "category"):
                found.append((at, match.end))
            at = match.end
        else:
            at += 1
    return found
