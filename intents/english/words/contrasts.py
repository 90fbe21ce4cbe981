"""What is wanted, set against what is not: "I want *not the small axe but* the big one"."""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import COLORS, DETERMINERS, ONES, SIZES, words

_WANTS = words(
    "want need bring give fetch get take pass hand grab carry put pick me us him her them for like "
    "mean meant"
)
"""Behind one of these something is named."""
_MARKS = frozenset(COLORS) | frozenset(SIZES) | DETERMINERS
_LONGEST = 6
_SIGNS = (COMMA, FULL_STOP)


def but_this(tokens: list[Token]) -> list[Token]:
    """The tokens without what is said not to be meant ahead of what is."""
    said = [token.text for token in tokens]
    for at in range(1, len(said) - 3):
        if said[at] != "not" or said[at - 1] not in _WANTS or said[at + 1] not in DETERMINERS:
            continue
        ends = range(at + 3, min(len(said) - 1, at + _LONGEST))
        but = next((n for n in ends if said[n] == "but"), None)
        rather = but is not None and said[but + 1] in ("rather", "only", "just")
        if but is None or not set(said[at:but]).isdisjoint(_SIGNS):
            continue
        first = but + 1 + rather
        one = next((n for n in range(first, min(len(said), first + 4)) if said[n] in ONES), None)
        if first >= len(said) or said[first] not in DETERMINERS:
            continue
        noun = [token for token in tokens[at + 1 : but] if token.text not in _MARKS]
        if one is None:
            return [*tokens[:at], *tokens[first:]]
        return [*tokens[:at], *tokens[first:one], *noun, *tokens[one + 1 :]]
    return tokens
