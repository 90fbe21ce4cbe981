"""How well learnt fields do on sentences of speakers that they have not heard."""

from collections import Counter
from collections.abc import Iterable, Iterator

from intents.context import Context
from intents.english.learnt.field import Fields
from intents.english.words.names import index_of
from intents.outcomes import Goals, Outcome
from intents.parser import first_look
from intents.second_look import Attempt, second_look
from training.learning import Example, Examples
from training.marked import Marked
from training.trusting import is_meant


def accuracies(told: Iterable[Examples], fields: Fields) -> Iterator[str]:
    """For each field a line: how many places, and how many whole chains, it labels rightly."""
    told = list(told)
    for name in filter(fields.__contains__, Examples._fields):
        field = fields[name]
        count: Counter[str] = Counter()
        for chain, labels in _of(name, told):
            if not chain:
                continue
            guessed = [field.labels[int(n)] for n in field.marginals(chain).argmax(axis=1)]
            same = [one == other for one, other in zip(guessed, labels, strict=True)]
            count.update(places=len(same), right=sum(same), chains=1, whole=all(same))
        yield (
            f"{name}: {count['right'] / max(1, count['places']):.3f} of {count['places']} places, "
            f"{count['whole'] / max(1, count['chains']):.3f} of {count['chains']} whole"
        )


def outcomes(heard: list[Marked], fields: Fields) -> str:
    """A line: what share of sentences is read as meant, asked or refused though clear, misread."""
    count: Counter[str] = Counter()
    for one in heard:
        outcome = _read(one, fields)
        idle = isinstance(one.gold, str) or any(isinstance(also, str) for also in one.also)
        if isinstance(outcome, Goals):
            count["right" if is_meant(one, outcome.goals) else "wrong"] += 1
        else:
            count["right" if idle else "asked"] += 1
    return ", ".join(
        f"{name} {count[name] / len(heard):.3f}" for name in ("right", "asked", "wrong")
    )


def _read(sentence: Marked, fields: Fields) -> Outcome:
    def read(said: str) -> Attempt:
        return first_look(said, sentence.vocabulary, Context())

    first = read(sentence.text)
    index = index_of(sentence.vocabulary)
    return second_look(sentence.text, index, first, read, fields=fields).outcome


def _of(name: str, told: list[Examples]) -> Iterator[Example]:
    for one in told:
        yield from getattr(one, name)
