"""Whatever there is of something is all of it: "whatever cups are left", "any cups there are"."""

from intents.english.words import lexicon
from intents.english.words.lexer import Token, singular

_WHICHEVER = lexicon.words("whatever whichever any")
_THERE = (
    ("are", "left"), ("there", "are", "left"), ("that", "are", "left"), ("are", "still", "left"),
    ("are", "still", "there"), ("are", "there"), ("there", "are"), ("that", "are", "there"),
    ("you", "find"), ("you", "can", "find"), ("are", "lying", "around"), ("remain",),
    ("that", "remain"), ("are", "around"), ("that", "you", "find"), ("that", "there", "are"),
)  # fmt: skip
_LONGEST_NAME = 3


def all_there_is(tokens: list[Token]) -> list[Token]:
    """The tokens with "all the cups" for "whatever cups are left"."""
    words = [token.text for token in tokens]
    if _WHICHEVER.isdisjoint(words):
        return tokens
    for at, word in enumerate(words):
        if word not in _WHICHEVER:
            continue
        for noun in range(at + 1, min(len(words), at + 1 + _LONGEST_NAME)):
            said = next((s for s in _THERE if tuple(words[noun + 1 : noun + 1 + len(s)]) == s), ())
            if said and words[noun] != singular(words[noun]):
                everything = [Token("all", tokens[at].raw), Token("the", "")]
                rest = tokens[noun + 1 + len(said) :]
                return [*tokens[:at], *everything, *tokens[at + 1 : noun + 1], *rest]
    return tokens
