"""A sentence said again in plain words, and how sure the network is of them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from intents.english.paraphrase.network import BEGIN, END, Network, shipped
from intents.english.paraphrase.pointing import pointing
from intents.english.paraphrase.source import SORTS, Unit, units, words_of
from intents.english.paraphrase.wordpieces import pieces
from intents.english.words.names import NameIndex

NOTHING, ASK = "nothing", "ask"
"""What is written of a sentence that asks for nothing, and of one that has to be asked about."""
HOPELESS = 0.02
"""What is less likely than that is not written to its end: nobody acts on it or asks about it."""
_LOST = float(np.log(HOPELESS))
_CLOSE = {"°", "'s"}
"""What stands right behind the word before it."""


class Paraphrase(NamedTuple):
    """A sentence in plain words.

    Attributes:
        text: The plain words.
        likely: How likely they are by the network [0..1].
    """

    text: str
    likely: float


def read_in(
    said: Sequence[Unit], words: Sequence[Sequence[str]], known: dict[str, int], longest: int
) -> tuple[list[int], list[int], list[int]]:
    """A sentence as the network takes it in.

    Args:
        said: The units.
        words: The words of each unit.
        known: The number of each piece.
        longest: So many pieces are read; what is behind them is not.

    Returns:
        The pieces, what each is, and the first piece of each unit (0 where it was not read).
    """
    ids, sorts, heads = [known["[CLS]"]], [0], list[int]()
    for unit, spelled in zip(said, words, strict=True):
        found = [piece for word in spelled for piece in pieces(word, known)]
        fits = len(ids) + len(found) < longest
        heads.append(len(ids) if fits else 0)
        if fits:
            ids += found
            sorts += [SORTS.index(unit.sort) + (0 if unit.is_whole else len(SORTS))] * len(found)
    return [*ids, known["[SEP]"]], [*sorts, 0], heads


class Heard:
    """A sentence as the network has read it.

    Attributes:
        units: What it consists of.
        is_whole: Whether all of it was read; it may have been too long.
    """

    def __init__(self, text: str, index: NameIndex, network: Network | None = None) -> None:
        """Read a sentence.

        Args:
            text: The sentence.
            index: The names of its world.
            network: What was learnt; by default what comes with the package.
        """
        self._net = network or shipped()
        words = words_of(text)
        self.units = units(words, index)
        spelled = [[word.raw for word in words[unit.start : unit.end]] for unit in self.units]
        ids, sorts, self._heads = read_in(self.units, spelled, self._net.known, self._net.longest)
        self.is_whole = all(self._heads)
        self._read = self._net.read(ids, sorts)
        self._said: Paraphrase | None = None

    def finds(self, plain: str, index: NameIndex) -> list[tuple[float, float]] | None:
        """How likely the network finds other plain words.

        Args:
            plain: The plain words, as :mod:`intents.plain_words` puts goals.
            index: The names of the world.

        Returns:
            For each word, and for the end behind them, the logarithm of its probability and that
            of the word that the network would have written there; None if one of them comes from
            nowhere in the sentence, or they are too many.
        """
        net = self._net
        told = pointing(plain, self.units, index, net.numbers_of)
        if told is None or len(told) >= net.longest_plain:
            return None
        known = len(net.words)
        written = [known + w if isinstance(w, int) else net.numbers_of[w] for w in told]
        found = net.begin(self._read, self._heads).finds([*written, END])
        return [(float(own), float(most)) for own, most in found.T]

    def paraphrase(self) -> Paraphrase:
        """What the network says instead of it; that it has to be asked if it is lost for words."""
        if self._said is None:
            self._said = self._paraphrase()
        return self._said

    def _paraphrase(self) -> Paraphrase:
        writing, known = self._net.begin(self._read, self._heads), len(self._net.words)
        told, sure, last = list[int](), 0.0, BEGIN
        while len(told) < self._net.longest_plain:
            odds = writing.after(last)
            last = int(odds.argmax())
            sure += float(odds[last])
            if last == END:
                break
            told.append(last)
            if sure < _LOST or _goes_round(told):
                return Paraphrase(ASK, float(np.exp(sure)))
        plain = [self.units[w - known].meant if w >= known else self._net.words[w] for w in told]
        return Paraphrase(joined(plain), float(np.exp(sure)))


def _goes_round(told: Sequence[int]) -> bool:
    """Whether the last few words are those before them again: nobody orders that way."""
    lengths = range(2, len(told) // 2 + 1)
    return any(told[-n:] == told[-2 * n : -n] for n in lengths)


def joined(plain: Sequence[str]) -> str:
    """Plain words as a text."""
    text = " ".join(plain).replace("“ ", "“").replace(" ”", "”").replace(" ,", ",")
    for sign in _CLOSE:
        text = text.replace(f" {sign}", sign)
    return text
