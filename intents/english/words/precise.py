"""The words of data sheets around a quantity: "for a duration of three seconds", "minus ninety".

They name the kind of what the unit says anyway, so the quantity stands for all of it.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.measures import measure, number

_KINDS = {
    "duration": "time", "period": "time", "time": "time", "span": "time", "distance": "length",
    "length": "length", "angle": "angle", "amount": "", "total": "", "maximum": "",
}  # fmt: skip
"""Nouns of quantities, and the kind of measure that has to follow."""
_BEFORE = lexicon.words("for over by with during through across")
_OF = (*lexicon.words("of is equals being"), COMMA)
_DESCRIBES = lexicon.words("a an the total exact full whole overall")


def plain_quantities(tokens: list[Token]) -> list[Token]:
    """The tokens with each quantity as it is said at home: "for 3 seconds", "-90 degrees"."""
    words = [t.text for t in tokens]
    plain: list[Token] = []
    at = 0
    while at < len(tokens):
        signed = _signed(words, at)
        named = None if signed else _named(words, at)
        if signed:
            value, end = signed
            plain.append(Token(f"{value:g}", _raw(tokens[at:end])))
            at = end
        elif named:
            kind, at = named
            if plain and plain[-1].text == COMMA:
                plain.pop()
            plain += [Token("for", "for")] if kind == "time" else []
        else:
            plain.append(tokens[at])
            at += 1
    return plain


def _signed(words: list[str], at: int) -> tuple[float, int] | None:
    """*Minus ninety* degrees, *plus thirty* degrees: the number with its sign."""
    if words[at] not in ("minus", "negative", "plus"):
        return None
    amount = number(words, at + 1)
    if amount is None:
        return None
    measured = measure(words, at + 1)
    ends = amount.end >= len(words) or words[amount.end] in (COMMA, FULL_STOP, "and")
    if not (ends or (measured and measured.kind != "times")) or (words[at] == "plus" and ends):
        return None
    return (amount.value if words[at] == "plus" else -amount.value), amount.end


def _named(words: list[str], at: int) -> tuple[str, int] | None:
    """*For a duration of* three seconds: the kind of measure, and where the measure begins."""
    n = at + (words[at] in _BEFORE)
    while n < len(words) and words[n] in _DESCRIBES and words[n] not in _KINDS:
        n += 1
    if n >= len(words) or words[n] not in _KINDS:
        return None
    kind, begin = _KINDS[words[n]], n + 1
    if begin < len(words) and words[begin] in _OF:
        begin += 1
    elif n == at and at and words[at - 1] != COMMA:
        return None  # how much time 2 minutes
    amount = measure(words, begin)
    if amount is None or amount.kind != (kind or amount.kind) or amount.kind == "times":
        return None
    beside = amount.end < len(words) and words[amount.end] == "from"
    return None if beside or (at and words[at - 1] == "at") else (amount.kind, begin)


def _raw(tokens: list[Token]) -> str:
    return " ".join(t.raw for t in tokens if t.raw)
