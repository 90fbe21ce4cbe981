"""How it is said in a condition that somebody is there: "if she has come to the lab"."""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import words

_CONDITIONS = words("if when once unless whether provided should case")
_BEING = {
    (*be, *way): where
    for be in (("is",), ("are",), ("'s",), ("be",), ("has", "been"), ("have", "been"))
    for way, where in (
        (("back", "in"), "in"), (("back", "at"), "at"), (("already", "in"), "in"),
        (("to", "be", "found"), ""), (("found",), ""), (("currently",), ""),
    )
} | {
    (*be, *way): where
    for be in (("has",), ("have",), ("is",), ("are",), ("'s",), ("has", "already"))
    for way, where in (
        (("come", "to"), "in"), (("come", "into"), "in"), (("come", "in"), "in"),
        (("arrived", "in"), "in"), (("arrived", "at"), "at"), (("returned", "to"), "in"),
        (("got", "to"), "in"), (("gone", "to"), "in"), (("come", "back", "to"), "in"),
    )
} | {
    (can, "be", found): "" for can in ("can", "may", "could") for found in ("found", "seen")
} | {
    ("happens", "to", "be"): "", ("happen", "to", "be"): "", ("turns", "out", "to", "be"): "",
}  # fmt: skip
"""How it is said of somebody that they are there, and in which place if that is not said."""
_LONGEST_BEING = 4
_REACH = 6


def being_there(tokens: list[Token]) -> list[Token]:
    """If she *has come to* the lab, *can be found in* it, *is back in* it: if she is in it."""
    said = [token.text for token in tokens]
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        ends = range(min(len(said), at + _LONGEST_BEING), at + 1, -1)
        end = next((end for end in ends if tuple(said[at:end]) in _BEING), at)
        if end > at and _depends(said, at):
            where = _BEING[tuple(said[at:end])]
            kept.append(Token("is", " ".join(token.raw for token in tokens[at:end])))
            kept += [Token(where, "")] if where else []
            at = end
        else:
            kept.append(tokens[at])
            at += 1
    return kept


def _depends(said: list[str], at: int) -> bool:
    """Whether a condition begins shortly before a word, in its clause."""
    begin = max((n + 1 for n in range(at) if said[n] in (COMMA, FULL_STOP)), default=0)
    return not _CONDITIONS.isdisjoint(said[max(begin, at - _REACH) : at])
