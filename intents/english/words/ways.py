"""What is done on the way somewhere is done before: "go to the hall, stopping at the bar"."""

from collections.abc import Collection

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import DETERMINERS, Phrase, phrases, words
from intents.english.words.names import NameIndex
from intents.english.words.verbs import verbs_at

_THROUGH = phrases(
    "via,by way of,stopping at,stopping by,stopping off at,stopping in at,calling at,calling in at,"
    "calling by,calling in on,dropping by,swinging by,passing by,passing through,going via,"
    "going by way of,with a stop at,with a stopover at,with a quick stop at"
)
"""What leads to a place that is gone to first."""
_ON_THE_WAY = phrases(
    "on the way,on your way,on the way there,on your way there,along the way,en route,"
    "on the way over,on your way over,as you go,while on your way"
)
_FIRST = phrases("first,first of all,beforehand")
_ON_THE_WAY_TO = phrases("on the way to,on your way to,en route to")
_AHEAD_OF: dict[Phrase, list[str]] = {
    ("prior", "to"): ["before"], ("before", "to"): ["before", "you"],
    ("previous", "to"): ["before"], ("subsequent", "to"): ["after"],
    ("after", "to"): ["after", "you"],
}  # fmt: skip
"""Other words for "before" and "after" with what is done."""
_LINKS = words("and but then so") | {COMMA, FULL_STOP}
_TO = words("to into towards")
_TELLS = words("tell say inform remind announce")
_THEN = words("then and after afterwards")
_ONCE_THERE = phrases(
    "when you get there,once you get there,when you are there,once you are there,"
    "when you arrive,once you arrive,when you arrive there,once there,when there,"
    "as soon as you get there,as soon as you are there"
)
_AHEAD = phrases("ahead of,before,in front of")
_BEFORE_ORDERS = words("please and then you could can would to just") | {COMMA, FULL_STOP}
_SPREADS = words("lay drape spread sling")
_LAYS = words("put throw hang fling toss place pop pull draw chuck")
_CLOTHS = words(
    "blanket towel cloth tablecloth sheet coat jacket shirt scarf shawl rug quilt duvet "
    "apron rag bedspread blankets towels sheets coats tarpaulin"
)
"""What is put over a thing lies on it."""
_WHITHER = phrases("into,onto,to")
_BETWEEN = words("then back straight right over")
_OFF = words("off from out")
_FAR = 7
"""So many words before its end where something comes from begins."""
_LONGEST = 6


def in_order(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with what is done on the way said to be done first."""
    for at in range(len(tokens) - 1, -1, -1):
        tokens = _if_there(_ahead_of(tokens, at), at)
        said = [token.text for token in tokens]
        tokens = (
            _through(tokens, said, at, index)
            or _before_going(tokens, said, at, index)
            or _on_the_way(tokens, said, at)
            or tokens
        )
    return tokens


def led(tokens: list[Token]) -> list[Token]:
    """Walk *ahead of me* to the hall: guide me there."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 4):
        if said[at] not in ("go", "walk") or (at and said[at - 1] not in _BEFORE_ORDERS):
            continue
        first = at + 1 + (said[at + 1] == "you")
        end = _end(_AHEAD, said, first)
        if end and said[end : end + 1] in (["me"], ["us"]) and said[end + 1 : end + 2]:
            to = said[end + 1]
            if to in _TO or (to == "in" and said[end + 2 : end + 3] != []):
                guide = [
                    Token("guide", tokens[at].raw),
                    tokens[end],
                    Token("to", tokens[end + 1].raw),
                ]
                return [*tokens[:at], *guide, *tokens[end + 2 :]]
    return tokens


def laid(tokens: list[Token]) -> list[Token]:
    """Lay the blanket *over* the sofa: on it; what is held or thrown over it is not."""
    said = [token.text for token in tokens]
    for at in range(1, len(said) - 1):
        begun = max((n + 1 for n in range(at) if said[n] in _LINKS), default=0)
        cloth = not _CLOTHS.isdisjoint(said[begun:at])
        spreads = not _SPREADS.isdisjoint(said[begun:at])
        spreads = spreads or (cloth and not _LAYS.isdisjoint(said[begun:at]))
        if said[at] == "over" and spreads and said[at + 1] in DETERMINERS:
            tokens = [*tokens[:at], Token("onto", tokens[at].raw), *tokens[at + 1 :]]
    return tokens


def hauled(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Off the shelf *and* into the box: from where and whither, of one and the same thing."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 2, 0, -1):
        begins = next((n for n in (at + 1, at + 2) if tuple(said[n : n + 1]) in _WHITHER), 0)
        between = {*said[at + 1 : begins]} <= _BETWEEN
        if said[at] != "and" or not begins or not between or not _spot_end(said, begins + 1, index):
            continue
        stop = at - (said[at - 1] == COMMA)
        if any(said[n] in _OFF and _spot_end(said, n + 1 + (said[n + 1] == "of"), index) == stop
               for n in range(max(0, stop - _FAR), stop - 1)):  # fmt: skip
            tokens = [*tokens[:stop], *tokens[begins:]]
            said = [token.text for token in tokens]
    return tokens


def tells_first(said: list[str], at: int) -> bool:
    """Whether "first" belongs to what is told: "tell Leo that dinner comes *first*".

    Behind a message it is about the message, unless more is to be done then.
    """
    if said[at] != "first" or said[at - 1] in _LINKS:
        return False
    begun = max((n + 1 for n in range(at) if said[n] in _LINKS), default=0)
    told = next((n for n in range(begun, at) if said[n] in _TELLS), None)
    if told is None or at < told + 3 or said[at + 1 : at + 2] in (["that"], ["to"]):
        return False
    return _THEN.isdisjoint(said[at + 1 : at + 3])


def _ahead_of(tokens: list[Token], at: int) -> list[Token]:
    """*Prior to* opening it, *before to* open it: before opening it, before you open it."""
    said = tuple(token.text for token in tokens[at : at + 3])
    if said[:2] not in _AHEAD_OF or len(said) < len(_AHEAD_OF[said[:2]]):
        return tokens
    plain = [Token(word, tokens[at].raw) for word in _AHEAD_OF[said[:2]]]
    return [*tokens[:at], *plain, *tokens[at + 2 :]]


def _if_there(tokens: list[Token], at: int) -> list[Token]:
    """Go to the hall *and when you get there* if the lamp is on, ...: a sentence of its own."""
    said = [token.text for token in tokens]
    end = _end(_ONCE_THERE, said, at)
    end += bool(end) and said[end : end + 1] == [COMMA]
    if not end or said[end : end + 1] not in (["if"], ["unless"]) or not at:
        return tokens
    begin = at
    while begin and said[begin - 1] in _LINKS:
        begin -= 1
    return [*tokens[:begin], Token(FULL_STOP, ""), *tokens[end:]] if begin else tokens


def _end(table: Collection[Phrase], said: list[str], at: int) -> int:
    """Where the longest phrase of a table ends; 0 if none begins here."""
    ends = range(min(len(said), at + _LONGEST), at, -1)
    return next((end for end in ends if tuple(said[at:end]) in table), 0)


def _closes(said: list[str], at: int) -> bool:
    return at >= len(said) or said[at] in (COMMA, FULL_STOP)


def _spot_end(said: list[str], at: int, index: NameIndex) -> int:
    """Where the name of a place ends; 0 if none begins here."""
    at += at < len(said) and said[at] in DETERMINERS
    match = index.match(said, at) if at < len(said) else None
    return match.end if match is not None and match.of("place", "room") else 0


def _first(*words_: str) -> list[Token]:
    return [Token(COMMA, ""), *(Token(word, "") for word in ("but", "first", *words_))]


def _through(tokens: list[Token], said: list[str], at: int, index: NameIndex) -> list[Token] | None:
    """Go to the hall *via the bar*; go *via the bar* to the hall."""
    start = _end(_THROUGH, said, at) if at else 0
    end = _spot_end(said, start, index) if start else 0
    if not end:
        return None
    closing = next((n for n in range(end, len(said)) if _closes(said, n)), len(said))
    rest = tokens[(_end(_ON_THE_WAY, said, end) or end) : closing]
    if rest and rest[0].text not in _TO:
        return None
    before = tokens[: at - 1] if said[at - 1] == COMMA else tokens[:at]
    return [*before, *rest, *_first("go", "to"), *tokens[start:end], *tokens[closing:]]


def _before_going(
    tokens: list[Token], said: list[str], at: int, index: NameIndex
) -> list[Token] | None:
    """*On your way to* the hall, take the cup: before you go there."""
    start = _end(_ON_THE_WAY_TO, said, at)
    if not (start and _spot_end(said, start, index)):
        return None
    before = [Token(word, "") for word in ("before", "you", "go", "to")]
    return [*tokens[:at], *before, *tokens[start:]]


def _on_the_way(tokens: list[Token], said: list[str], at: int) -> list[Token] | None:
    """Go to the hall and take the cup *on the way*, or *first*: but first take the cup."""
    end = _end(_ON_THE_WAY, said, at)
    first = 0 if tells_first(said, at) else _end(_FIRST, said, at)
    if first and said[first : first + 1] in (["that"], ["to"]) and said[at - 2] in _TELLS:
        return [*tokens[:at], *tokens[first:]]  # tell Ada first that lunch is ready
    behind = bool(first) or said[at - 1] not in _LINKS
    end = first or end
    if not end or not at or (behind and not _closes(said, end)):
        return None
    link = at if not behind else next((n + 1 for n in range(at - 1, 0, -1) if said[n] in _LINKS), 0)
    begin = link
    while begin and said[begin - 1] in _LINKS:
        begin -= 1
    but = "but" in said[begin:link]
    clause = tokens[link:at] if behind else []
    if first and not begin and said[at - 1] not in DETERMINERS:
        return [*tokens[:at], *tokens[end:]]  # wave first, then nod
    ordered = _LINKS.issuperset(said[end:]) and verbs_at(said, link)
    if not begin or (behind and not clause) or (first and not (but or ordered)):
        return None
    end += not behind and end < len(said) and said[end] == COMMA
    return [*tokens[:begin], *_first(), *clause, *tokens[end:]]
