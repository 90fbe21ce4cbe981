"""A pause between two steps is a wait: "a minute's wait", "a pause of ten seconds".

So is to stand somewhere for a while, when one has gone there: "stand there for five minutes".
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.measures import Measure, measure

_PAUSES = lexicon.words("wait pause break rest delay breather")
_BEFORE = frozenset((COMMA, FULL_STOP, "then", "and"))
_AFTER = _BEFORE | {"before", "but"}
_STANDS = lexicon.words("stand stay remain")
_SHORT = lexicon.words("short brief little quick")


def pauses_as_waits(tokens: list[Token]) -> list[Token]:
    """The tokens with "wait for a minute" for "a minute's wait" where a clause says no more."""
    words = [token.text for token in tokens]
    if "there" in words:
        tokens = _standing_there(tokens, words)
        words = [token.text for token in tokens]
    if _PAUSES.isdisjoint(words):
        return tokens
    plain: list[Token] = []
    at = 0
    while at < len(tokens):
        begins = at == 0 or words[at - 1] in _BEFORE
        found = _pause(words, at) if begins else None
        if found is None:
            plain.append(tokens[at])
            at += 1
            continue
        first, last, end = found
        said = " ".join(token.raw for token in tokens[at:first] if token.raw)
        plain += [Token("wait", said), Token("for", ""), *tokens[first:last]]
        at = end
    return plain


def _standing_there(tokens: list[Token], words: list[str]) -> list[Token]:
    """Go to the bar and *stand there* for a minute: wait for a minute."""
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        stands = words[at] in _STANDS and words[at + 1 : at + 2] == ["there"] and at > 1
        if stands and words[at - 1] in _BEFORE and words[at + 2 : at + 3] in (["for"], []):
            stands = words[at + 2 :] != [] and _time(words, at + 3) is not None
            kept.append(Token("wait", tokens[at].raw) if stands else tokens[at])
            at += 1 + stands
            continue
        kept.append(tokens[at])
        at += 1
    return kept


def _pause(words: list[str], at: int) -> tuple[int, int, int] | None:
    """Where in the pause that begins at a word its amount begins and ends, and where it ends."""
    first = at
    amount = _time(words, first)
    if amount is None:
        first += words[at] in lexicon.DETERMINERS
        first += words[first : first + 1] != [] and words[first] in _SHORT
        amount = _time(words, first)
    if amount is not None:
        end = amount.end + (words[amount.end : amount.end + 1] == ["'s"])
        return (first, amount.end, end + 1) if _is_pause(words, end, end + 1) else None
    if (
        words[first : first + 1]
        and words[first] in _PAUSES
        and words[first + 1 : first + 2] == ["of"]
    ):
        amount = _time(words, first + 2)
        if first > at and amount is not None and _ends(words, amount.end):
            return first + 2, amount.end, amount.end
    return None


def _time(words: list[str], at: int) -> Measure | None:
    amount = measure(words, at)
    return amount if amount is not None and amount.kind == "time" else None


def _is_pause(words: list[str], at: int, end: int) -> bool:
    return words[at:end] != [] and words[at] in _PAUSES and _ends(words, end)


def _ends(words: list[str], at: int) -> bool:
    return at >= len(words) or words[at] in _AFTER
