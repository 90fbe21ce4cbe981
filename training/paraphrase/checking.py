"""What the grammar's readings tell of when the network doubts them rightly."""

from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import chain

from intents.context import Context
from intents.english.learnt.check import signs
from intents.english.learnt.field import Field
from intents.english.learnt.trust import RIGHT, WRONG
from intents.english.paraphrase.paraphrasing import ASK, NOTHING
from intents.english.words.names import index_of
from intents.goals import to_builtins
from intents.outcomes import Goals
from intents.parser import first_look
from intents.sameness import same
from intents.second_look import Attempt, second_look
from intents.third_look import third_look
from intents.witness import Hears, to_check
from training.learning import Example, learn
from training.marked import Marked

Told = tuple[Marked, str]
"""A sentence and its plain words."""
_AT_ONCE = 20
"""So many sentences are read by a process before it is given others."""
_WEIGHT = 2
"""So often each plain order counts: the grammar is right on them, whatever the network thinks."""


def check_learnt(strange: Sequence[Told], plain: Sequence[Told], *, jobs: int = 1) -> Field:
    """What is learnt of whether the grammar's reading of a sentence is what was meant.

    Args:
        strange: Sentences that the network which ships has not heard, each with its plain words.
        plain: Plain orders, on which the grammar is right.
        jobs: So many processes read them.
    """
    told = [*strange, *[one for one in plain for _ in range(_WEIGHT)]]
    parts = [told[at : at + _AT_ONCE] for at in range(0, len(told), _AT_ONCE)]
    with ProcessPoolExecutor(jobs) as readers:
        found = readers.map(_read, parts)
        return learn(chain.from_iterable(found), l1=0.0, l2=10.0, steps=400)


def _read(told: Sequence[Told]) -> list[Example]:
    return list(readings(told))


def readings(told: Iterable[Told]) -> Iterator[Example]:
    """The grammar's reading of each sentence that would be acted on, with whether it was meant."""
    for one, plain in told:
        vocabulary, index = one.vocabulary, index_of(one.vocabulary)

        def read(text: str, vocabulary=vocabulary) -> Attempt:
            return first_look(text, vocabulary, Context())

        meant = None if plain in (ASK, NOTHING) else read(plain).outcome
        if meant is not None and not isinstance(meant, Goals):
            continue  # nothing that the grammar can say
        before, hear = second_look(one.text, index, read(one.text), read), Hears()
        if third_look(one.text, index, before, read, hear=hear) is not before:
            continue
        said = to_check(one.text, index, before, read, certain=1.1, hear=hear)
        if said is not None:
            right = meant and same(to_builtins(meant.goals), to_builtins(said.goals))
            yield [signs(said)], [RIGHT if right else WRONG]
