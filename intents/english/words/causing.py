"""What somebody else is to be made to do: "get Leo to close the gate" is to tell him to.

The robot does not do it itself. "Let Ada have the cup" is to give it to her.
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import words
from intents.english.words.names import NameIndex
from intents.english.words.verbs import base_form, verbs_at

_CAUSES = words("get have let")
_BEGINS = words("and then please now you to just robot") | {COMMA, FULL_STOP}
_LED = words("follow come go")
"""Have her *follow you*: that is to lead her, and no message."""


def caused(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with "tell Leo to close the gate" for "get Leo to close the gate"."""
    said = [token.text for token in tokens]
    if _CAUSES.isdisjoint(said):
        return tokens
    for at in range(len(said) - 1, -1, -1):
        if said[at] in _CAUSES and (not at or said[at - 1] in _BEGINS):
            tokens = _told(tokens, at, index) or tokens
    return tokens


def _told(tokens: list[Token], at: int, index: NameIndex) -> list[Token] | None:
    said = [token.text for token in tokens]
    match = index.match(said, at + 1)
    if match is None or not match.of("person") or match.end >= len(said):
        return None
    who, after = tokens[at + 1 : match.end], match.end
    if said[at] == "let":
        had = said[after] == "have" and after + 1 < len(said)
        return [*tokens[:at], Token("give", ""), *who, *tokens[after + 1 :]] if had else None
    begin = after + (said[after] == "to")
    if (begin > after) != (said[at] == "get") or begin >= len(said) or said[begin] in _LED:
        return None
    orders = base_form(said[begin]) == said[begin] and bool(verbs_at(said, begin))
    if not orders or index.match(said, begin) is not None:
        return None  # get Ada to the hall
    return [*tokens[:at], Token("tell", ""), *who, Token("to", ""), *tokens[begin:]]
