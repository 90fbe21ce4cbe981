"""Superlatives that are made on the spot: "the wee-est", "the teensiest", "the most small"."""

from intents.english.words.lexer import Token
from intents.english.words.lexicon import SIZES, SUPERLATIVES, unlisted

_MEANT: dict[str, str] = {
    "small": "smallest", "big": "largest", "thin": "thinnest", "thick": "thickest",
    "tall": "tallest", "long": "tallest", "short": "shortest", "heavy": "heaviest",
    "light": "lightest", "wide": "thickest",
}  # fmt: skip
_COLLOQUIAL: dict[str, str] = {
    **dict.fromkeys(unlisted("teensy teeny weeny titchy dinky diddy itty bitty petite"), "small"),
    **dict.fromkeys(unlisted("ginormous humongous whopping colossal immense hulking"), "big"),
    **dict.fromkeys(unlisted("hefty ponderous leaden"), "heavy"),
    **dict.fromkeys(unlisted("airy feathery"), "light"),
    **dict.fromkeys(unlisted("lanky lofty"), "tall"),
    **dict.fromkeys(unlisted("chubby chunky stout"), "thick"),
}
"""Sizes in words of home, which no list of adjectives has."""
_ENDING = "est"


def listed_superlatives(tokens: list[Token]) -> list[Token]:
    """The tokens with every superlative of a size as one that the grammar knows."""
    plain: list[Token] = []
    for token in tokens:
        torn = token.text == _ENDING and plain
        most = _meant(plain[-1].text) if torn else _formed(token.text)
        if not most:
            plain.append(token)
        elif torn:
            plain[-1] = Token(most, f"{plain[-1].raw}-{token.raw}")
        else:
            plain.append(Token(most, token.raw))
    return plain


def _meant(stem: str) -> str:
    """The superlative of a size; empty if a word is none."""
    return _MEANT.get(SIZES.get(stem) or _COLLOQUIAL.get(stem, ""), "")


def _formed(word: str) -> str:
    """The superlative that a word in -est stands for; empty if that is not known."""
    if not word.endswith(_ENDING) or (word,) in SUPERLATIVES:
        return ""
    stem = word.removesuffix(_ENDING)
    stems = (stem, f"{stem}e", stem[:-1], f"{stem[:-1]}y" if stem.endswith("i") else stem)
    return next((meant for meant in (_meant(one) for one in stems) if meant), "")
