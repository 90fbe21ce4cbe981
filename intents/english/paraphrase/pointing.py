"""Plain words about a sentence as the network writes them: its own words, or units pointed at."""

from collections.abc import Collection, Sequence

from intents.english.paraphrase.source import Unit, units, words_of
from intents.english.words.names import NameIndex

_QUOTES = "“”"


def pointing(
    plain: str, said: Sequence[Unit], index: NameIndex, known: Collection[str]
) -> list[str | int] | None:
    """Plain words, each as a word that is known or as the number of the unit that it comes from.

    Args:
        plain: The plain words.
        said: The units of the sentence that they are about.
        index: The names of its world.
        known: The words that the network can write.

    Returns:
        None if a name or a word comes from nowhere.
    """
    told: list[str | int] = []
    last, quoted = -1, False
    for unit in units(words_of(plain), index):
        quoted = quoted != (unit.said in _QUOTES)
        at = _pointed(unit, said, last)
        if at is not None and (unit.names or quoted or unit.said not in known):
            told.append(at)
            last = at
        elif unit.said in known:
            told.append(unit.said)
        else:
            return None
    return told


def _pointed(unit: Unit, said: Sequence[Unit], last: int) -> int | None:
    """What a plain word or name points at: what stands behind the last one, else the first."""
    order = [*range(last + 1, len(said)), *range(last + 1)]
    if unit.names:
        alike = [n for n in order if set(unit.names) & set(said[n].names)]
        return min(alike, key=lambda n: not said[n].is_whole, default=None)
    return next((n for n in order if said[n].said == unit.said and not said[n].names), None)
