"""How many, said behind the thing, as learners and note-takers put it: before it.

"Seeded roll three piece" (three seeded rolls), "teaspoon also five" (five teaspoons too), "the
drysuits, the lot" (all the drysuits), and "five bowl put on the table" (put five bowls ...).
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.measures import number
from intents.english.words.names import NameIndex

_PIECES = lexicon.unlisted("piece pieces pcs pc nos numbers")
_LOTS = (
    ("the", "whole", "lot", "of", "them"), ("the", "lot", "of", "them"), ("the", "whole", "lot"),
    ("the", "lot"), ("the", "whole", "bunch"), ("every", "last", "one"),
    ("each", "and", "every", "one"), ("every", "single", "one"),
)  # fmt: skip
_HANDLES = lexicon.unlisted("put take bring carry give send fetch move place keep")
_SIGNS = (COMMA, FULL_STOP)


def counted_first(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with each amount before the thing that it counts."""
    at = 0
    while at < len(tokens):
        words = [token.text for token in tokens]
        match = index.match(words, at)
        if match is None or not match.of("object", "category"):
            at += 1
            continue
        changed = (
            _pieces(tokens, words, at, match.end)
            or _as_many(tokens, words, at, match.end)
            or _all_of_it(tokens, words, at, match.end)
            or _verb_behind(tokens, words, at, match.end)
        )
        tokens = changed or tokens
        at = match.end + (1 if changed else 0)
    return tokens


def _pieces(tokens: list[Token], words: list[str], at: int, end: int) -> list[Token] | None:
    """Seeded roll *three piece*."""
    count = number(words, end) if end < len(words) else None
    if count is None or words[count.end : count.end + 1] == [] or words[count.end] not in _PIECES:
        return None
    amount = tokens[end : count.end]
    return [*tokens[:at], *amount, *tokens[at:end], *tokens[count.end + 1 :]]


def _as_many(tokens: list[Token], words: list[str], at: int, end: int) -> list[Token] | None:
    """Put five bowls there, *teaspoon also five*."""
    start = end + (words[end : end + 1] == [COMMA])
    also = words[start : start + 1] in (["also"], ["too"])
    count = number(words, start + 1) if also and start + 1 < len(words) else None
    if count is None or at < 1 or words[at - 1] != COMMA:
        return None
    closes = words[count.end : count.end + 1] in ([], [COMMA], [FULL_STOP])
    if not closes:
        return None
    amount = tokens[start + 1 : count.end]
    said = [Token("and", "and"), *amount, *tokens[at:end], Token("too", "too")]
    return [*tokens[:at], *said, *tokens[count.end :]]


def _all_of_it(tokens: list[Token], words: list[str], at: int, end: int) -> list[Token] | None:
    """The drysuits, *the lot*, from here to there."""
    start = end + (words[end : end + 1] == [COMMA])
    for lot in _LOTS:
        stop = start + len(lot)
        if tuple(words[start:stop]) != lot or start == end:
            continue
        stop += words[stop : stop + 1] == [COMMA]
        first = at - (at > 0 and words[at - 1] in lexicon.DETERMINERS)
        if words[max(0, first - 1) : first] == ["and"]:
            return None  # the cap and the torch, the lot: of both
        return [
            *tokens[:first], Token("all", "all"), Token("the", "the"), *tokens[at:end],
            *tokens[stop:],
        ]  # fmt: skip
    return None


def _verb_behind(tokens: list[Token], words: list[str], at: int, end: int) -> list[Token] | None:
    """*Five bowl put* on the table: put five bowls on the table."""
    if words[end : end + 1] == [] or words[end] not in _HANDLES:
        return None
    begins = next(
        (n for n in range(max(0, at - 2), at) if (count := number(words, n)) and count.end == at),
        None,
    )
    if begins is None or (begins > 0 and words[begins - 1] not in _SIGNS):
        return None
    return [*tokens[:begins], tokens[end], *tokens[begins:end], *tokens[end + 1 :]]
