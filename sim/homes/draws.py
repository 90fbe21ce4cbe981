"""Draws from a numpy generator, with types."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

import numpy as np

T = TypeVar("T")


def one_of(items: Sequence[T], rng: np.random.Generator) -> T:
    """One of several."""
    return items[int(rng.integers(len(items)))]


def shuffled(items: Iterable[T], rng: np.random.Generator) -> list[T]:
    """All of them, in any order."""
    known = list(items)
    return [known[int(index)] for index in rng.permutation(len(known))]
