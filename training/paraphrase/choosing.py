"""What the readings of sentences that the network has not heard tell of which to choose."""

from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import cache, partial
from itertools import chain
from pathlib import Path

import numpy as np

from intents.context import Context
from intents.english.learnt.choice import ALONE, OTHER, OWN, Both, Source, signs
from intents.english.learnt.field import Field
from intents.english.learnt.trust import RIGHT, WRONG
from intents.english.paraphrase.network import Network, unpacked
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard
from intents.english.words.names import NameIndex, index_of
from intents.goals import Goal, to_builtins
from intents.outcomes import Goals
from intents.parser import first_look
from intents.sameness import same
from intents.second_look import Attempt, second_look
from intents.third_look import looked
from intents.vocabulary import Vocabulary
from training.learning import Example, learn
from training.marked import Marked

_AT_ONCE = 20
"""So many sentences are read by a process before it is given others."""
Told = tuple[Marked, str]
"""A sentence and its plain words."""


def chosen(told: Sequence[Told], network: Path, *, jobs: int = 1) -> Field:
    """What is learnt of which reading to choose; the same whatever the number of processes.

    Args:
        told: Sentences that the network has not heard, each with its plain words: what strangers
            say, and plain orders, on which the grammar is right.
        network: The file of what says them in plain words.
        jobs: So many processes read them.
    """
    parts = [told[at : at + _AT_ONCE] for at in range(0, len(told), _AT_ONCE)]
    with ProcessPoolExecutor(jobs) as readers:
        found = readers.map(partial(_read, network), parts)
        return learn(chain.from_iterable(found), l1=0.5, l2=2.0)


def _read(network: Path, told: Sequence[Told]) -> list[Example]:
    return list(readings(told, _loaded(network)))


@cache
def _loaded(file: Path) -> Network:
    with np.load(file) as stored:
        return unpacked(dict(stored))


def readings(told: Iterable[Told], network: Network) -> Iterator[Example]:
    """The grammar's reading of each sentence and the network's, with whether it was meant.

    All of them, also those that are never given up for the other: what is acted on, asked about
    and refused.
    """
    for one, plain in told:
        vocabulary, index = one.vocabulary, index_of(one.vocabulary)

        @cache
        def read(text: str, vocabulary: Vocabulary = vocabulary) -> Attempt:
            return first_look(text, vocabulary, Context())

        def hear(text: str, index: NameIndex) -> Heard:
            return Heard(text, index, network)

        meant = None if plain in (ASK, NOTHING) else read(plain).outcome
        if meant is not None and not isinstance(meant, Goals):
            continue  # nothing that the grammar can say
        before = second_look(one.text, index, read(one.text), read)
        found = looked(one.text, index, before, read, hear)
        if found is not None:
            yield from examples(found[0], None if meant is None else meant.goals)


def examples(both: Both, meant: tuple[Goal, ...] | None) -> Iterator[Example]:
    """What a sentence tells of either reading, and of the grammar's by itself.

    Args:
        both: The sentence.
        meant: What is asked for; None where nothing is, or it has to be asked about.
    """
    gold = None if meant is None else to_builtins(meant)
    sources: tuple[Source, ...] = (OWN, ALONE, OTHER)
    for source in sources:
        side = both.other if source == OTHER else both.own
        if not side.goals or (source == ALONE and side.kind != "goals"):
            continue
        is_right = gold is not None and same(gold, to_builtins(side.goals))
        yield [signs(both, source)], [RIGHT if is_right else WRONG]
