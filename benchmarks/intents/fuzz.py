"""Arbitrary strings: none may raise, none may take long."""

from __future__ import annotations

import random
import time
from collections.abc import Iterator
from typing import NamedTuple

from intents.goals import from_json, to_json
from intents.outcomes import Goals
from intents.parser import hear
from intents.vocabulary import Vocabulary

LONG = 100_000


class Fuzzed(NamedTuple):
    """How many strings there were, the errors, and the longest that one took."""

    strings: int
    errors: list[str]
    worst_ms: float
    worst: str


def fuzz(vocabulary: Vocabulary, corpus: list[str], *, strings: int, seed: int) -> Fuzzed:
    """Parse strings made by chance and from pieces of a corpus."""
    errors: list[str] = []
    worst_ms, worst, context = 0.0, "", None
    for text in made_up(corpus, strings=strings, seed=seed):
        began = time.perf_counter()
        try:
            outcome, context = hear(text, vocabulary, context=context)
            if isinstance(outcome, Goals):
                from_json(to_json(outcome.goals))
        except Exception as error:
            errors.append(f"{text[:60]!r}: {error!r}")
            context = None
        took_ms = (time.perf_counter() - began) * 1e3
        if took_ms > worst_ms:
            took_ms = min(took_ms, *(_alone_ms(text, vocabulary) for _ in range(3)))
        if took_ms > worst_ms:
            worst_ms, worst = took_ms, text
    return Fuzzed(strings, errors, worst_ms, worst)


def _alone_ms(text: str, vocabulary: Vocabulary) -> float:
    """Again, because a busy machine interrupts now and then."""
    began = time.perf_counter()
    hear(text, vocabulary)
    return (time.perf_counter() - began) * 1e3


def made_up(corpus: list[str], *, strings: int, seed: int) -> Iterator[str]:
    """Strings of five kinds in turn: any characters, salads, cut, crossed and very long ones."""
    rng = random.Random(seed)
    words = sorted({word for text in corpus for word in text.split()})
    for number in range(strings):
        kind = number % 100
        if kind == 0:
            yield rng.choice((chr(rng.randrange(32, 0x3000)), rng.choice(words) + " ")) * LONG
        elif kind < 30:
            yield "".join(_character(rng) for _ in range(rng.randrange(120)))
        elif kind < 60:
            yield " ".join(rng.choices(words, k=rng.randrange(1, 30)))
        elif kind < 80:
            text = rng.choice(corpus)
            at = rng.randrange(len(text) + 1)
            yield text[:at] + _character(rng) * rng.randrange(3) + text[at + rng.randrange(3) :]
        else:
            one, other = rng.choice(corpus).split(), rng.choice(corpus).split()
            yield " ".join(one[: rng.randrange(len(one) + 1)] + other[rng.randrange(len(other)) :])


def _character(rng: random.Random) -> str:
    """Any character of Unicode, control characters and lone surrogates included."""
    ranges = ((0, 0x20), (0x20, 0x7F), (0x7F, 0x250), (0x250, 0x3000), (0x3000, 0x110000))
    return chr(rng.randrange(*rng.choice(ranges)))
