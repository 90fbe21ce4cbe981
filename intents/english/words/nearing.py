"""A place told from afar: "in the pantry, on the freezer" is on the freezer in the pantry."""

from intents.english.words.lexer import COMMA, Token
from intents.english.words.lexicon import DETERMINERS, words
from intents.english.words.names import Kind, NameIndex

_INTO = words("in into inside")
_ON = words("on onto in into under")
_PUTS = words("put place set leave lay stand drop stick pop park store stow")


def nearest_first(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with the place of a thing before the room that it is in."""
    said = [token.text for token in tokens]
    if _PUTS.isdisjoint(said) or COMMA not in said:
        return tokens
    for at in range(len(said)):
        comma = _end(said, at, _INTO, index, "room")
        end = (
            _end(said, comma + 1, _ON, index, "place") if said[comma : comma + 1] == [COMMA] else 0
        )
        if comma and end and not _PUTS.isdisjoint(said[:at]):
            room = [Token("in", tokens[at].raw), *tokens[at + 1 : comma]]
            return [*tokens[:at], *tokens[comma + 1 : end], *room, *tokens[end:]]
    return tokens


def _end(said: list[str], at: int, where: frozenset[str], index: NameIndex, kind: Kind) -> int:
    """Where "in the pantry" ends, if it begins at a word and what is named is of a kind."""
    if said[at : at + 1] == [] or said[at] not in where:
        return 0
    begin = at + 1 + (said[at + 1 : at + 2] != [] and said[at + 1] in DETERMINERS)
    match = index.match(said, begin)
    return match.end if match is not None and match.of(kind) else 0
