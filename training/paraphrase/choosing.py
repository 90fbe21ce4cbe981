"""What the readings of sentences that the network has not heard tell of which to choose."""

from collections.abc import Iterable, Iterator

from intents.context import Context
from intents.english.learnt.choice import OTHER, OWN, signs
from intents.english.learnt.field import Field
from intents.english.learnt.trust import RIGHT, WRONG
from intents.english.paraphrase.network import Network
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard
from intents.english.words.names import NameIndex, index_of
from intents.goals import to_builtins
from intents.outcomes import Goals
from intents.parser import first_look
from intents.second_look import Attempt, second_look
from intents.third_look import looked
from training.learning import Example, learn
from training.marked import Marked
from training.sameness import same


def chosen(told: Iterable[tuple[Marked, str]], network: Network | None = None) -> Field:
    """What is learnt of which reading to choose.

    Args:
        told: Sentences that the network has not heard, each with its plain words.
        network: What says them in plain words; by default what comes with the package.
    """
    return learn(readings(told, network), l1=0.1, l2=0.5)


def readings(told: Iterable[tuple[Marked, str]], network: Network | None) -> Iterator[Example]:
    """The grammar's reading of each sentence and the network's, with whether it was meant."""
    for one, plain in told:
        vocabulary, index = one.vocabulary, index_of(one.vocabulary)

        def read(text: str, vocabulary=vocabulary) -> Attempt:
            return first_look(text, vocabulary, Context())

        def hear(text: str, index: NameIndex) -> Heard:
            return Heard(text, index, network)

        meant = None if plain in (ASK, NOTHING) else read(plain).outcome
        if meant is not None and not isinstance(meant, Goals):
            continue  # nothing that the grammar can say
        before = second_look(one.text, index, read(one.text), read)
        found = looked(one.text, index, before, read, hear)
        if found is None:
            continue
        both = found[0]
        for source, side in ((OWN, both.own), (OTHER, both.other)):
            if side.goals:
                is_right = meant is not None and same(
                    to_builtins(meant.goals), to_builtins(side.goals)
                )
                yield [signs(both, source)], [RIGHT if is_right else WRONG]
