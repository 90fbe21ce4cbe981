"""Sentences side by side as arrays, and sentences told otherwise so that more can be learnt."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import torch
from torch import Tensor

from intents.english.paraphrase.paraphrasing import read_in
from intents.english.paraphrase.source import Unit
from training.paraphrase.examples import Pair

BEGIN, END = "<", ">"
_NAMED = ("object", "category", "place", "room", "person")


class Batch(NamedTuple):
    """Sentences of about the same length; see `network.Network` for the shapes."""

    pieces: Tensor
    sorts: Tensor
    mask: Tensor
    heads: Tensor
    has: Tensor
    plain: Tensor
    goal: Tensor


class Told(NamedTuple):
    """A sentence as units with their words."""

    units: tuple[Unit, ...]
    words: tuple[tuple[str, ...], ...]
    plain: tuple[str | int, ...]


def told(pair: Pair) -> Told:
    """A pair as it was said."""
    return Told(pair.units, tuple(pair.words[u.start : u.end] for u in pair.units), pair.plain)


class Otherwise:
    """Tells a sentence with other names, without signs, misspelt.

    Args:
        names: Names of each sort, of all worlds.
        seed: of the dice.
    """

    def __init__(self, names: Mapping[str, Sequence[str]], seed: int) -> None:
        self._names, self._dice = names, random.Random(seed)

    def __call__(self, pair: Pair) -> Told:
        """A pair told otherwise."""
        dice, one = self._dice, told(pair)
        words = list(one.words)
        if dice.random() < 0.6:
            kept = {"switch", "open", "close"} & set(one.plain)
            for n, unit in enumerate(one.units):
                other = unit.is_whole and unit.sort in _NAMED and dice.random() < 0.6
                if other and not (kept and unit.sort != "person"):
                    words[n] = tuple(dice.choice(self._names[unit.sort]).split())
        if dice.random() < 0.1:
            words = [tuple(map(self._misspelt, said)) for said in words]
        if dice.random() < 0.2:
            return _without_signs(one._replace(words=tuple(words)))
        return one._replace(words=tuple(words))

    def _misspelt(self, word: str) -> str:
        dice = self._dice
        if len(word) < 4 or dice.random() > 0.15:
            return word
        at = dice.randrange(1, len(word) - 1)
        return dice.choice([
            word[:at] + word[at + 1 :],
            word[:at] + word[at + 1] + word[at] + word[at + 2 :],
            word[:at] + word[at] + word[at:],
        ])  # fmt: skip


def _without_signs(one: Told) -> Told:
    kept = [n for n, unit in enumerate(one.units) if unit.sort != "sign"]
    at = {old: new for new, old in enumerate(kept)}
    if not kept or any(isinstance(word, int) and word not in at for word in one.plain):
        return one
    plain = tuple(at[word] if isinstance(word, int) else word for word in one.plain)
    return Told(tuple(one.units[n] for n in kept), tuple(one.words[n] for n in kept), plain)


def batch(
    said: Sequence[Told], known: Mapping[str, int], words: Mapping[str, int], longest: int
) -> Batch:
    """Sentences side by side.

    Args:
        said: sentences.
        known: the number of each piece.
        words: the number of each plain word.
        longest: so many pieces are read.
    """
    rows = [_row(one, known, words, longest) for one in said]
    lengths = [max(len(row[n]) for row in rows) for n in range(4)]
    count = len(rows)
    first, sorts = (torch.zeros(count, lengths[0], dtype=torch.long) for _ in range(2))
    mask = torch.zeros(count, lengths[0], dtype=torch.bool)
    heads = torch.zeros(count, lengths[2], dtype=torch.long)
    has = torch.zeros(count, lengths[2], dtype=torch.bool)
    plain = torch.zeros(count, lengths[3] - 1, dtype=torch.long)
    goal = torch.full((count, lengths[3] - 1), -1)
    for n, (p, s, h, w) in enumerate(rows):
        first[n, : len(p)], sorts[n, : len(s)] = torch.tensor(p), torch.tensor(s)
        mask[n, : len(p)] = True
        heads[n, : len(h)], has[n, : len(h)] = torch.tensor(h), torch.tensor([x > 0 for x in h])
        plain[n, : len(w) - 1], goal[n, : len(w) - 1] = torch.tensor(w[:-1]), torch.tensor(w[1:])
    return Batch(first, sorts, mask, heads, has, plain, goal)


def _row(
    one: Told, known: Mapping[str, int], words: Mapping[str, int], longest: int
) -> tuple[list[int], list[int], list[int], list[int]]:
    ids, sorts, heads = read_in(one.units, one.words, known, longest)
    plain = [
        len(words) + word if isinstance(word, int) else words[word]
        for word in (BEGIN, *one.plain, END)
    ]
    return ids, sorts, heads, plain
