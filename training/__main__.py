"""`python -m training`: learn what people say from the marked sentences, and write the weights.

With `--folds 4` nothing is written: it learns from the other speakers and is judged by those it has
not heard.
"""

import argparse
import random
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from rich.progress import track

from intents.english.learnt import field
from intents.english.learnt.field import Field
from training.judging import accuracies, outcomes
from training.learning import Example, Examples, examples, learn
from training.marked import Marked, sentences
from training.trusting import readings

_FOLDER = Path(field.__file__).parent
_PARTS = 4
"""So many parts of the speakers are read by what was learnt from the others, to learn from those
readings which to trust."""


class _Part(NamedTuple):
    """Some speakers' sentences, what was learnt from the others, and the readings by that."""

    heard: list[Marked]
    told: list[Examples]
    fields: dict[str, Field]
    readings: list[Example]


def main() -> int:
    """Learn from all sentences, or measure on speakers that were not heard."""
    asked = argparse.ArgumentParser(prog="python -m training", description=__doc__)
    asked.add_argument("--folds", type=int, default=0, help="so many parts are judged in turn")
    folds = asked.parse_args().folds
    heard = list(sentences())
    told = [examples(one) for one in track(heard, "looking at sentences")]
    parts = list(_parts(heard, told, folds or _PARTS))
    if not folds:
        for name, one in {**fields(told), "trust": trust(parts)}.items():
            file = _FOLDER / f"{name}.npz"
            file.write_bytes(field.packed(one))
            print(f"{file.name}: {len(one.rows)} features of {len(heard)} sentences")
        return 0
    for part in parts:
        part.fields["trust"] = trust(other for other in parts if other is not part)
        print(*accuracies(part.told, part.fields), sep="\n")
        print(outcomes(part.heard, part.fields))
    return 0


def _parts(heard: list[Marked], told: list[Examples], number: int) -> Iterator[_Part]:
    """The speakers in so many parts, each read by what was learnt from the others."""
    speakers = sorted({one.speaker for one in heard})
    random.Random(1).shuffle(speakers)
    pairs = list(zip(heard, told, strict=True))
    for n in track(range(number), "learning from the others"):
        kept = set(speakers[n::number])
        learnt = fields(e for one, e in pairs if one.speaker not in kept)
        own = [pair for pair in pairs if pair[0].speaker in kept]
        read = [example for one, _ in own for example in readings(one, learnt)]
        yield _Part([one for one, _ in own], [e for _, e in own], learnt, read)


def fields(told: Iterable[Examples]) -> dict[str, Field]:
    """What is learnt of words and of whole sentences."""
    told = list(told)
    return {
        "background": learn(e for one in told for e in one.background),
        "acts": learn((e for one in told for e in one.acts), l1=0.02, l2=0.1),
        "roles": learn(e for one in told for e in one.roles),
    }


def trust(parts: Iterable[_Part]) -> Field:
    """What is learnt of which reading to trust."""
    return learn((example for part in parts for example in part.readings), l1=0.1, l2=0.5)


if __name__ == "__main__":
    sys.exit(main())
