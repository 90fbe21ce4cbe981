"""Several orders in one sentence: each is said again in plain words, one after the other."""

from collections.abc import Sequence

from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.looks import Said, looks, said
from intents.english.learnt.rewording import Reworded, reworded
from intents.english.learnt.roles import ASK, IDLE, SEVERAL, act_looks
from intents.english.words import lexicon
from intents.english.words.names import NameIndex

_BETWEEN = lexicon.words("and then afterwards after , ; . : an n nd")
"""What stands between two orders."""
_FEWEST = 2
"""So many words an order has at least."""
_MOST = 6
"""So many places to cut a sentence at are tried."""
_LIKELY = 0.15
"""How likely both parts have to be an order [0..1]."""


def several(
    text: str, index: NameIndex, idle: Sequence[float], fields: Fields = LEARNT
) -> Reworded | None:
    """Two orders in plain words; None where a sentence cannot be cut into such.

    Args:
        text: A sentence.
        index: The names of its world.
        idle: How likely each of its words is background [0..1].
        fields: What was learnt.
    """
    words = said(text)
    best, parts = _LIKELY, None
    for end, start in _cuts(words)[:_MOST]:
        likely = 1.0
        for part in (words[:end], words[start:]):
            likely *= _order(part, index, fields)
        if likely > best:
            best, parts = likely, (end, start)
    if parts is None:
        return None
    end, start = parts
    one = reworded(text[: words[end - 1].end], index, idle[:end], fields=fields)
    rest = text[words[start].start :]
    two = reworded(rest, index, idle[start:], going_on=True, fields=fields)
    if one is None or two is None:
        return None
    both, least = f"{one.text}, then {two.text}", max(one.least, two.least)
    return Reworded(both, (*one.left, *two.left), least, one.harms | two.harms)


def _cuts(words: list[Said]) -> list[tuple[int, int]]:
    """Where one order may end and the next begin."""
    found: list[tuple[int, int]] = []
    at = 0
    while at < len(words):
        end = at
        while end < len(words) and words[end].raw.lower() in _BETWEEN:
            end += 1
        if end > at >= _FEWEST and len(words) - end >= _FEWEST:
            found.append((at, end))
        at = max(end, at + 1)
    return found


def _order(words: list[Said], index: NameIndex, fields: Fields) -> float:
    """How likely words are one order [0..1]."""
    acts = fields["acts"]
    likely = acts.marginals([act_looks(words, looks(words, index))])[0]
    told = zip(acts.labels, likely.tolist(), strict=True)
    return max(p for act, p in told if act not in (ASK, IDLE, SEVERAL))
