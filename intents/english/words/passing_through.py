"""A way is two walks: "go *through the lobby to the entrance*" is to one, then the other.

Only of who goes; what is carried "through the hall to the kitchen" is put down once. Only through
rooms and spots of the floor: nobody walks through furniture, and who is asked to is told so.
"""

from __future__ import annotations

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import DETERMINERS, phrases, words
from intents.english.words.names import NameIndex

_GOING = words(
    "go going walk walking head heading pass passing move moving proceed continue come travel "
    "stroll wander cross back straight on over right along"
)
_NOT_ITS_OWN = words(
    "with carrying take bring carry fetch deliver put place "
    "tell ask say inform remind shout announce"
)
"""What is carried ends at one place only, and the words of a message stay as they are."""
_LINKS = words("and then next afterwards after that finally first") | {COMMA, FULL_STOP}
_ONWARD = phrases(
    "to,into,on to,onto,on into,over to,and to,and into,and on to,and then to,then to"
)
_LONGEST = 3
_LISTED = (COMMA, "and", "then", "through")


def by_way_of(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with every way through one room to another as two walks, in their order."""
    for at in range(len(tokens) - 2, 0, -1):
        if tokens[at].text == "through":
            tokens = _to_and_on(tokens, at, index) or _behind(tokens, at, index) or tokens
    return tokens


def _to_and_on(tokens: list[Token], at: int, index: NameIndex) -> list[Token] | None:
    """Go *through the hall and the yard to the bar*: to the hall, to the yard, then to the bar."""
    said = [token.text for token in tokens]
    rooms = _rooms(said, at + 1, index)
    if not rooms or not _goes(said, at):
        return None
    passed = rooms[-1][1]
    on = next(
        (n for n in range(passed + _LONGEST, passed, -1) if tuple(said[passed:n]) in _ONWARD), 0
    )
    end = _floor_end(said, on, index) if on else 0
    if not end:
        return None
    walks = [Token("to", tokens[at].raw), *tokens[rooms[0][0] : rooms[0][1]]]
    for begin, over in [*rooms[1:], (on, end)]:
        walks += [Token(COMMA, ""), Token("then", ""), Token("go", "")]
        walks += [Token("to", tokens[begin - 1].raw), *tokens[begin:over]]
    return [*tokens[:at], *walks, *tokens[end:]]


def _rooms(said: list[str], at: int, index: NameIndex) -> list[tuple[int, int]]:
    """Where each of the rooms listed from here on begins and ends: the hall and the yard."""
    found: list[tuple[int, int]] = []
    while end := _floor_end(said, at, index):
        found.append((at, end))
        at = end
        while at < len(said) and said[at] in _LISTED:
            at += 1
        if at == end:
            break
    return found


def _behind(tokens: list[Token], at: int, index: NameIndex) -> list[Token] | None:
    """Go *to the bar through the hall*: to the hall, then to the bar."""
    said = [token.text for token in tokens]
    middle = _floor_end(said, at + 1, index)
    to = next((n for n in range(at - 1, 0, -1) if said[n] in ("to", "into")), 0)
    if not middle or not to or _floor_end(said, to + 1, index) != at or not _goes(said, to):
        return None
    if middle < len(said) and said[middle] not in _LINKS:
        return None
    last = [Token(COMMA, ""), Token("then", ""), Token("go", ""), *tokens[to:at]]
    return [*tokens[:to], Token("to", ""), *tokens[at + 1 : middle], *last, *tokens[middle:]]


def _goes(said: list[str], at: int) -> bool:
    """Whether what stands before a word is to go somewhere, or goes on from there."""
    begun = max((n + 1 for n in range(at) if said[n] in (COMMA, FULL_STOP)), default=0)
    clause = [word for word in said[begun:at] if word not in _LINKS]
    if not clause:  # ..., then through the hall to the bar
        clause = [word for word in said[:begun] if word not in _LINKS]
        return bool(clause) and not _NOT_ITS_OWN.intersection(clause) and clause[0] in _GOING
    return clause[-1] in _GOING and not _NOT_ITS_OWN.intersection(clause[:-1])


def _floor_end(said: list[str], at: int, index: NameIndex) -> int:
    """Where the name of a room, or of a spot of the floor, ends; 0 if none begins here."""
    at += at < len(said) and said[at] in DETERMINERS
    match = index.match(said, at) if at < len(said) else None
    if match is None:
        return 0
    name = match.of("room", "place")
    return match.end if name is not None and name not in index.furniture else 0
