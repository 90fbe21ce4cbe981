"""All there is of something, and all but some: "whatever cups are left", "all bar the blue one"."""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token, singular

_WHICHEVER = lexicon.words("whatever whichever any")
_THERE = (
    ("are", "left"), ("there", "are", "left"), ("that", "are", "left"), ("are", "still", "left"),
    ("are", "still", "there"), ("are", "there"), ("there", "are"), ("that", "are", "there"),
    ("you", "find"), ("you", "can", "find"), ("are", "lying", "around"), ("remain",),
    ("that", "remain"), ("are", "around"), ("that", "you", "find"), ("that", "there", "are"),
)  # fmt: skip
_LONGEST_NAME = 3
_BARRING = lexicon.words("bar barring save")
_SPOTTED = lexicon.DETERMINERS | lexicon.words(
    "on to at in from behind under by near into onto and"
)
"""Behind one of these "bar" is a place or a thing."""
_ALL = lexicon.ALL | lexicon.words("everything anything everyone everybody any")
_SIGNS = (COMMA, FULL_STOP)


def all_but(tokens: list[Token]) -> list[Token]:
    """The tokens with "everything except the cups" for "everything bar the cups"."""
    words = [token.text for token in tokens]
    if _BARRING.isdisjoint(words):
        return tokens
    plain, of_all = list(tokens), False
    for at, word in enumerate(words[:-1]):
        of_all = (of_all or word in _ALL) and word not in _SIGNS
        meant = word in _BARRING and words[at + 1] in lexicon.DETERMINERS
        if of_all and meant and words[at - 1] not in _SPOTTED:
            plain[at] = Token("except", tokens[at].raw)
    return plain


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
