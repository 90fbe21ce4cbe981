"""Which words of a sentence are background, and how sure that is."""

from typing import NamedTuple

from intents.english.learnt.field import Array
from intents.english.learnt.looks import Said

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


def background(words: list[Said], likely: Array, least: float = 0.5) -> list[Passed]:
    """What of a sentence is rather background than not, in order.

    Args:
        words: The sentence.
        likely: How likely each of its words is background [0..1], shape (words,).
        least: How likely it has to be of a word.
    """
    found: list[Passed] = []
    at = 0
    while at < len(words):
        end = at
        while end < len(words) and (likely[end] > least or (end > at and words[end].is_sign)):
            end += 1
        heard = [n for n in range(at, end) if not words[n].is_sign]
        if heard:
            sure = min(float(likely[n]) for n in heard)
            found.append(Passed(words[at].start, words[end - 1].end, sure))
        at = max(end, at + 1)
    return found
