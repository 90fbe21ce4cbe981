"""`python -m training.background`: learn the weights of the tagger of background, and write them.

With `--folds 4` nothing is written: it learns from the other speakers and is judged by those it has
not heard.
"""

import argparse
import random
import sys

from rich.progress import track

from intents.english.background import tagger
from training.background.judging import judged
from training.background.learning import example, learn
from training.background.marked import Marked, sentences

_FILE = "intents/english/background/weights.json.gz"


def main() -> int:
    """Learn from all sentences, or measure on speakers that were not heard."""
    asked = argparse.ArgumentParser(prog="python -m training.background", description=__doc__)
    asked.add_argument("--folds", type=int, default=0, help="so many parts are judged in turn")
    folds = asked.parse_args().folds
    told = list(sentences())
    examples = [example(one) for one in track(told, "looking at sentences")]
    if not folds:
        weights = learn(examples)
        with open(_FILE, "wb") as file:
            file.write(tagger.packed(weights))
        print(f"{len(told)} sentences, {len(weights.features)} features: {_FILE}")
        return 0
    speakers = sorted({one.speaker for one in told})
    random.Random(1).shuffle(speakers)
    seen: list[tuple[Marked, list[float]]] = []
    for fold in track(range(folds), "learning"):
        kept = set(speakers[fold::folds])
        pairs = list(zip(told, examples, strict=True))
        weights = learn(e for one, e in pairs if one.speaker not in kept)
        seen += [
            (one, list(tagger.probabilities(e[0], weights)))
            for one, e in pairs
            if one.speaker in kept
        ]
    print(judged(seen))
    return 0


if __name__ == "__main__":
    sys.exit(main())
