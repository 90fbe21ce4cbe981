"""What something is taken somewhere for: "put the bowls in the sink *for washing*".

It says what somebody does afterwards, and changes nothing of what is done; where something is told
it stays.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.names import NameIndex

_ENDS = (COMMA, FULL_STOP, "and", "then", "please")
_SPEAKS = lexicon.words("say tell announce ask shout whisper if what which how is are was needs")
_IDLE = lexicon.words("being something anything nothing everything evening morning")
_LONGEST = 3


def without_purposes(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens without "for washing" and its like, behind a name that closes a clause."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 2, 1, -1):
        verb = words[at + 1] if at + 1 < len(words) else FULL_STOP
        after = words[at + 2] if at + 2 < len(words) else FULL_STOP
        gerund = verb.endswith("ing") and len(verb) > _LONGEST + 2 and verb not in _IDLE
        if words[at] != "for" or not gerund or after not in _ENDS:
            continue
        named = any(
            (match := index.match(words, n)) is not None and match.end == at
            for n in range(max(0, at - _LONGEST), at)
        )
        if named and index.match(words, at + 1) is None and _SPEAKS.isdisjoint(words[:at]):
            tokens = [*tokens[:at], *tokens[at + 2 :]]
            words = [token.text for token in tokens]
    return tokens
