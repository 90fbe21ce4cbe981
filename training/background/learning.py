"""Learns the weights of the tagger of background with python-crfsuite (`pip install .[train]`)."""

import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from intents.english.background.looks import looks, said
from intents.english.background.tagger import Weights
from intents.english.words.names import index_of
from training.background.marked import Marked

Example = tuple[list[list[str]], list[str]]
_IDLE, _ASKED = "B", "O"


def example(sentence: Marked) -> Example:
    """The features of the words of a sentence, and whether each is background."""
    words = said(sentence.text)
    labels = [_IDLE if all(sentence.idle[w.start : w.end]) else _ASKED for w in words]
    return looks(words, index_of(sentence.vocabulary)), labels


def learn(
    examples: Iterable[Example], *, l1: float = 0.03, l2: float = 0.05, steps: int = 200
) -> Weights:
    """What a field learns from examples.

    Args:
        examples: Features and labels.
        l1: Weight of the sum of the weights' sizes: it makes most of them zero.
        l2: Weight of the sum of their squares.
        steps: So many steps of L-BFGS at most.

    Raises:
        ModuleNotFoundError: python-crfsuite is not installed.
    """
    import pycrfsuite  # pyright: ignore[reportMissingImports]  # of the extra `train`

    crfsuite: Any = pycrfsuite
    trainer = crfsuite.Trainer(verbose=False)
    for features, labels in examples:
        if features:
            trainer.append(features, labels)
    trainer.set_params(
        {"c1": l1, "c2": l2, "max_iterations": steps, "feature.possible_transitions": True}
    )
    with tempfile.TemporaryDirectory() as folder:
        model = str(Path(folder) / "model")
        trainer.train(model)
        tagger = crfsuite.Tagger()
        tagger.open(model)
        info = tagger.info()
        features: dict[str, float] = {}
        for (name, label), weight in info.state_features.items():
            features[name] = features.get(name, 0.0) + (weight if label == _IDLE else -weight)
        moves = [
            [info.transitions.get((one, other), 0.0) for other in (_ASKED, _IDLE)]
            for one in (_ASKED, _IDLE)
        ]
        tagger.close()
    kept = {name: round(weight, 3) for name, weight in features.items() if abs(weight) >= 0.005}
    return Weights(kept, np.array(moves))
