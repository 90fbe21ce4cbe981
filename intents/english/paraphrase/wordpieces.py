"""Words in pieces that the encoder knows [Wu et al. 2016, greedy longest match first]."""

from collections.abc import Mapping

UNKNOWN = "[UNK]"
_GOES_ON = "##"
_LONGEST = 100
"""What has more letters is no word, as BERT has it; cutting it would take quadratic time."""


def pieces(word: str, known: Mapping[str, int]) -> list[int]:
    """The pieces of a word, the longest first from its beginning; one unknown piece if none fit."""
    plain = word.lower().replace("’", "'")
    if len(plain) > _LONGEST:
        return [known[UNKNOWN]]
    found: list[int] = []
    at = 0
    while at < len(plain):
        before = _GOES_ON if at else ""
        end = next(
            (end for end in range(len(plain), at, -1) if before + plain[at:end] in known), None
        )
        if end is None:
            return [known[UNKNOWN]]
        found.append(known[before + plain[at:end]])
        at = end
    return found
