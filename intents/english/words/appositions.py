"""Who somebody is, said beside the name: "our guest, Mr Okafor", "both Ada and Leo".

Someone with a title is not called in the midst of an order, so what stands before is who that is.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_BEFORE = lexicon.words("to for greet ask tell guide follow with meet find from give bring help")
_WHOSE = lexicon.words("the our my your his her their that this")
_TITLES = lexicon.words("mr mrs ms miss dr doctor prof professor sister captain sir madam nurse")
_MOST_WORDS = 2


def without_appositions(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with the names alone of those who are told by what they are as well."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 2, -1, -1):
        end = _apposition_end(words, at, index)
        if words[at] == "both" and _is_pair(words, at + 1, index):
            end = at + 1
        if end is not None:
            tokens = [*tokens[:at], *tokens[end:]]
            words = [token.text for token in tokens]
    return tokens


def _apposition_end(words: list[str], at: int, index: NameIndex) -> int | None:
    """Where the name begins behind what is said of who bears it: our guest, *Mr Okafor*."""
    before = words[at - 1] if at else FULL_STOP
    if words[at] not in _WHOSE or before not in _BEFORE:
        return None
    sign = next((n for n in range(at + 2, at + 2 + _MOST_WORDS) if words[n : n + 1] == [COMMA]), 0)
    said = words[at + 1 : sign]
    known = any(index.match(words, n) is not None for n in range(at + 1, sign))
    match = index.match(words, sign + 1) if sign and sign + 1 < len(words) else None
    titled = words[sign + 1 : sign + 2] != [] and words[sign + 1] in _TITLES
    plain = all(word.isalpha() and word not in FIRST_WORDS for word in said)
    is_person = match is not None and bool(match.of("person"))
    return sign + 1 if sign and is_person and titled and plain and not known else None


def _is_pair(words: list[str], at: int, index: NameIndex) -> bool:
    """Whether two people are named at a word: both *Ada and Leo*."""
    first = index.match(words, at) if at < len(words) else None
    if first is None or not first.of("person") or words[first.end : first.end + 1] != ["and"]:
        return False
    second = index.match(words, first.end + 1) if first.end + 1 < len(words) else None
    return second is not None and bool(second.of("person"))
