"""How well learnt fields do on sentences of speakers that they have not heard."""

from collections import Counter
from collections.abc import Iterable, Iterator

from intents.english.learnt.field import Field
from training.learning import Example, Examples

Fields = dict[str, Field]


def accuracies(told: Iterable[Examples], fields: Fields) -> Iterator[str]:
    """For each field a line: how many places, and how many whole chains, it labels rightly."""
    told = list(told)
    for name, field in fields.items():
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


def _of(name: str, told: list[Examples]) -> Iterator[Example]:
    for one in told:
        yield from getattr(one, name)
