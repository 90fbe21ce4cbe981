"""What several people get: "bring Ada and Leo a mug each" is to bring a mug to Ada and Leo."""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import words
from intents.english.words.measures import number
from intents.english.words.names import NameIndex

_HANDS = words("bring fetch get give hand pass take carry serve")
_BEGINS = words("and then please now you to just robot") | {COMMA, FULL_STOP}
_ONE = words("a an one some another")
_RECEIVERS = words("to for")
_WIDEST = 3
"""So many words stand before a thing's name: "two *of the clean* mugs"."""


def handed_round(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with those who get something behind it; "each" says nothing then."""
    said = [token.text for token in tokens]
    if _HANDS.isdisjoint(said):
        return tokens
    for at in range(len(said) - 1, -1, -1):
        if said[at] in _HANDS and (not at or said[at - 1] in _BEGINS):
            tokens = _behind(tokens, at, index) or _without_each(tokens, at, index)
    return tokens


def _behind(tokens: list[Token], at: int, index: NameIndex) -> list[Token] | None:
    """Bring *Ada and Leo (each)* a mug (each); None where it is something else."""
    said = [token.text for token in tokens]
    people, count = _people_end(said, at + 1, index)
    begin = people + (said[people : people + 1] == ["each"])
    counted = number(said, begin) is not None or said[begin : begin + 1] in ([w] for w in _ONE)
    end = _thing_end(said, begin, index) if count > 1 and counted else 0
    if not end:
        return None
    stop = end + (said[end : end + 1] == ["each"])
    if stop < len(said) and said[stop] not in _BEGINS | {"from"}:
        return None
    who = [Token("to", ""), *tokens[at + 1 : people]]
    return [*tokens[: at + 1], *tokens[begin:end], *who, *tokens[stop:]]


def _without_each(tokens: list[Token], at: int, index: NameIndex) -> list[Token]:
    """Bring a mug *each* to Ada and Leo: it goes without saying."""
    said = [token.text for token in tokens]
    end = _thing_end(said, at + 1, index)
    if (
        not end
        or said[end : end + 1] != ["each"]
        or said[end + 1 : end + 2] not in (["to"], ["for"])
    ):
        return tokens
    people, count = _people_end(said, end + 2, index)
    return [*tokens[:end], *tokens[end + 1 :]] if people and count > 1 else tokens


def _people_end(said: list[str], at: int, index: NameIndex) -> tuple[int, int]:
    """Where a list of people ends that begins at a word, and how many they are."""
    end, count = at, 0
    while True:
        match = index.match(said, at) if at < len(said) else None
        if match is None or not match.of("person"):
            return end, count
        end, count = match.end, count + 1
        at = end
        while at < len(said) and said[at] in (COMMA, "and"):
            at += 1
        if at == end:
            return end, count


def _thing_end(said: list[str], at: int, index: NameIndex) -> int:
    """Where the name of a thing ends, some words behind a word; 0 where there is none."""
    for begin in range(at + 1, min(at + 1 + _WIDEST, len(said))):
        match = index.match(said, begin)
        if match is not None and match.of("object", "category"):
            return match.end
        if match is not None or said[begin] in _BEGINS:
            return 0
    return 0
