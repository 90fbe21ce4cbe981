"""Which words of a sentence are background, and how sure that is."""

from typing import NamedTuple

from intents.english.learnt.field import Field, learnt
from intents.english.learnt.looks import looks, said
from intents.english.words.names import NameIndex

IDLE, ASKED = "idle", "asked"


class Passed(NamedTuple):
    """Words in a row that are taken for background.

    Attributes:
        start: The first character.
        end: The character after the last.
        sure: How likely it is that all of them are [0..1]: the least of their probabilities.
    """

    start: int
    end: int
    sure: float


def background(text: str, index: NameIndex, field: Field | None = None) -> list[Passed]:
    """What of a text is rather background than not, in order.

    Args:
        text: A sentence as it was said or typed.
        index: The names of its world.
        field: What was learnt; by default what comes with the package.
    """
    words = said(text)
    if not words:
        return []
    field = field or learnt("background")
    likely = field.marginals(looks(words, index))[:, field.labels.index(IDLE)]
    found: list[Passed] = []
    at = 0
    while at < len(words):
        end = at
        while end < len(words) and (likely[end] > 0.5 or (end > at and words[end].is_sign)):
            end += 1
        heard = [n for n in range(at, end) if not words[n].is_sign]
        if heard:
            sure = min(float(likely[n]) for n in heard)
            found.append(Passed(words[at].start, words[end - 1].end, sure))
        at = max(end, at + 1)
    return found
