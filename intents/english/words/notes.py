"""Notes, with an order or a question as it is put down: "Torch: location?", "Need: a cap".

A heading with a colon is the verb of what follows it, or the thing that is asked after; how many
are wanted may stand behind the thing ("pens x 4").
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import DETERMINERS, unlisted
from intents.english.words.names import NameIndex

_NEED = unlisted("need needed required wanted want requirement request requesting")
_WHERE = unlisted("location whereabouts position where place")
_ASKED_PLACE = ("surface", "place", "shelf", "table", "furniture")
_BEFORE_THINGS = _NEED | unlisted("fetch bring get deliver me us") | {COMMA, FULL_STOP}
_WAYS = ("to", "on", "onto", "in", "into", "for")
_WHITHER = {"on": "onto", "in": "into"}
_TIMES = ("x", "times")
_MARKS = ("small", "large", "big", "little", "red", "green", "blue", "black", "white", "yellow")


def in_sentences(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with notes as the sentences they stand for."""
    tokens = _counted_behind(_this_way(_contrasted(tokens), index), index)
    said = [token.text for token in tokens]
    asked = _asked_after(tokens, said, index) or _asked_where(tokens, said)
    if asked is not None:
        return asked
    noted = len(said) > 2 and said[1] == COMMA and tokens[1].raw == ":"
    if noted and said[0] in _NEED:
        return [Token("i", ""), Token("need", tokens[0].raw), *_without_comma(tokens[2:])]
    return tokens


def _without_comma(tokens: list[Token]) -> list[Token]:
    """Two caps, from the bar: two caps from the bar."""
    said = [token.text for token in tokens]
    at = next((n for n in range(len(said) - 1) if said[n] == COMMA), None)
    joins = at is not None and said[at + 1] in ("from", "for", "to")
    return [*tokens[:at], *tokens[at + 1 :]] if joins and at is not None else tokens


def _asked_after(tokens: list[Token], said: list[str], index: NameIndex) -> list[Token] | None:
    """*Torch: location?* Where is the torch?"""
    first = int(said[:1] != [] and said[0] in DETERMINERS)
    match = index.match(said, first) if first < len(said) else None
    if match is None or said[match.end : match.end + 1] != [COMMA]:
        return None
    rest = [word for word in said[match.end + 1 :] if word != FULL_STOP]
    if len(rest) != 1 or rest[0] not in _WHERE:
        return None
    return [Token("where", tokens[match.end + 1].raw), Token("is", ""), *tokens[: match.end]]


def _asked_where(tokens: list[Token], said: list[str]) -> list[Token] | None:
    """*Upon which surface* is the box *to be found*? Where is the box?"""
    asks = said[:2] in (["on", "which"], ["upon", "which"], ["on", "what"], ["upon", "what"])
    if (
        not asks
        or said[2:3] == []
        or said[2] not in _ASKED_PLACE
        or said[3:4] not in (["is"], ["are"])
    ):
        return None
    end = len(tokens) - 1 if said[-1] == FULL_STOP else len(tokens)
    found = said[end - 3 : end] in (["to", "be", "found"], ["to", "be", "seen"])
    where = Token("where", " ".join(token.raw for token in tokens[:3]))
    return [where, *tokens[3 : end - 3 * found]]


def _counted_behind(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Pens *x 4* to Ada: 4 pens to Ada."""
    tokens = [one for token in tokens for one in _apart(token)]
    said = [token.text for token in tokens]
    for at in range(1, len(said) - 1):
        if said[at] not in _TIMES or not said[at + 1].isdecimal():
            continue
        begin = next((n for n in range(max(0, at - 3), at) if _ends(index, said, n, at)), None)
        if begin is not None and (begin == 0 or said[begin - 1] in _BEFORE_THINGS):
            rest = tokens[at + 2 :]
            whither = _WHITHER.get(said[at + 2]) if at + 2 < len(said) and begin == 0 else None
            if whither is not None:
                rest = [Token(whither, rest[0].raw), *rest[1:]]  # pens x 4 on the bar
            return [*tokens[:begin], tokens[at + 1], *tokens[begin:at], *rest]
    return tokens


def _apart(token: Token) -> list[Token]:
    """*x6* as two words."""
    glued = token.text[:1] == "x" and token.text[1:].isdecimal()
    return [Token("x", ""), Token(token.text[1:], token.raw)] if glued else [token]


def _this_way(tokens: list[Token], index: NameIndex) -> list[Token]:
    """*Not to me, but* to Ada; to Ada, *not to me*: where it is not to go goes without saying."""
    said = [token.text for token in tokens]
    for at in range(1, len(said) - 2):
        end = _denied_way(said, at, index)
        if end is None:
            continue
        begun = max((n + 1 for n in range(at) if said[n] == FULL_STOP), default=0)
        links = end + (said[end : end + 1] == [COMMA])
        behind = said[links : links + 2] == ["but", said[at + 1]]
        ahead = said[at - 1] == COMMA and said[at + 1] in said[begun:at]
        if behind and not ahead:
            return [*tokens[:at], *tokens[links + 1 :]]
        if ahead and (end == len(said) or said[end] in (COMMA, FULL_STOP)):
            return [*tokens[: at - 1], *tokens[end:]]
    return tokens


def _denied_way(said: list[str], at: int, index: NameIndex) -> int | None:
    """Where "not to the *bench*" ends, of somebody or a place that is known."""
    if said[at] != "not" or said[at + 1] not in _WAYS:
        return None
    name = at + 2 + (said[at + 2] in DETERMINERS)
    if said[name : name + 1] in (["me"], ["her"], ["him"], ["us"], ["them"]):
        return name + 1
    match = index.match(said, name) if name < len(said) else None
    known = match is not None and match.of("place", "room", "person", "object")
    return match.end if match is not None and known else None


def _ends(index: NameIndex, said: list[str], begin: int, end: int) -> bool:
    match = index.match(said, begin)
    return match is not None and match.end == end


def _contrasted(tokens: list[Token]) -> list[Token]:
    """The small cup, *not the large one*, to Ada: what it is not goes without saying."""
    said = [token.text for token in tokens]
    for at in range(1, len(said) - 3):
        if said[at : at + 2] != [COMMA, "not"]:
            continue
        mark = at + 2 + (said[at + 2] in DETERMINERS)
        closes = said[mark + 1 : mark + 3] in (["one", COMMA], ["ones", COMMA])
        told = any(word in _MARKS for word in said[:at])
        if closes and said[mark] in _MARKS and said[mark] not in said[:at] and told:
            return [*tokens[:at], *tokens[mark + 3 :]]
    return tokens
