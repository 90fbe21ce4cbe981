"""`python -m training`: learn what people say from the marked sentences, and write the weights.

With `--folds 4` nothing is written: it learns from the other speakers and is judged by those it has
not heard.
"""

import argparse
import random
import sys
from pathlib import Path

from rich.progress import track

from intents.english.learnt import field
from intents.english.learnt.field import Field
from training.judging import accuracies
from training.learning import Examples, examples, learn
from training.marked import sentences

_FOLDER = Path(field.__file__).parent


def main() -> int:
    """Learn from all sentences, or measure on speakers that were not heard."""
    asked = argparse.ArgumentParser(prog="python -m training", description=__doc__)
    asked.add_argument("--folds", type=int, default=0, help="so many parts are judged in turn")
    folds = asked.parse_args().folds
    heard = list(sentences())
    told = [examples(one) for one in track(heard, "looking at sentences")]
    if not folds:
        for name, learnt in fields(told).items():
            file = _FOLDER / f"{name}.npz"
            file.write_bytes(field.packed(learnt))
            print(f"{file.name}: {len(learnt.rows)} features of {len(heard)} sentences")
        return 0
    speakers = sorted({one.speaker for one in heard})
    random.Random(1).shuffle(speakers)
    for fold in range(folds):
        kept = set(speakers[fold::folds])
        pairs = list(zip(heard, told, strict=True))
        learnt = fields([e for one, e in pairs if one.speaker not in kept])
        print(*accuracies([e for one, e in pairs if one.speaker in kept], learnt), sep="\n")
    return 0


def fields(told: list[Examples]) -> dict[str, Field]:
    """All that is learnt from examples."""
    return {
        "background": learn(e for one in told for e in one.background),
        "acts": learn((e for one in told for e in one.acts), l1=0.02, l2=0.1),
        "roles": learn(e for one in told for e in one.roles),
    }


if __name__ == "__main__":
    sys.exit(main())
