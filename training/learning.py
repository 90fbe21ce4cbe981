"""Learns fields with python-crfsuite (`pip install -e .[train]`)."""

import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from intents.english.learnt.background import ASKED, IDLE
from intents.english.learnt.field import Field
from intents.english.learnt.looks import looks, said
from intents.english.learnt.roles import act_looks
from intents.english.words.names import index_of
from training.marked import Marked
from training.roles import labelled

Example = tuple[list[list[str]], list[str]]
"""The features of each place of a chain, and its label."""
_LEAST = 0.005
"""Weights below it change no probability by a thousandth."""


class Examples(NamedTuple):
    """What one sentence tells each field."""

    background: list[Example]
    acts: list[Example]
    roles: list[Example]


def examples(sentence: Marked) -> Examples:
    """What a sentence tells each field."""
    index = index_of(sentence.vocabulary)
    words = said(sentence.text)
    idle = [IDLE if all(sentence.idle[w.start : w.end]) else ASKED for w in words]
    told = Examples([(looks(words, index), idle)], [], [])
    for text, act, roles in labelled(sentence, index):
        chain = looks(said(text), index)
        told.acts.append(([act_looks(said(text), chain)], [act]))
        if roles is not None:
            told.roles.append((chain, roles))
    return told


def learn(
    told: Iterable[Example], *, l1: float = 0.03, l2: float = 0.05, steps: int = 200
) -> Field:
    """The field that examples make most likely.

    Args:
        told: Features and labels.
        l1: Weight of the sum of the weights' sizes: it makes most of them zero.
        l2: Weight of the sum of their squares.
        steps: So many steps of L-BFGS at most.

    Raises:
        ModuleNotFoundError: python-crfsuite is not installed.
    """
    import pycrfsuite

    crfsuite: Any = pycrfsuite
    trainer = crfsuite.Trainer(verbose=False)
    for features, labels in told:
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
        labels = tuple(sorted(tagger.labels()))
        at = {label: n for n, label in enumerate(labels)}
        kept = {key: w for key, w in info.state_features.items() if abs(w) >= _LEAST}
        rows = {name: row for row, name in enumerate(sorted({name for name, _ in kept}))}
        weights = np.zeros((len(rows), len(labels)))
        for (name, label), weight in kept.items():
            weights[rows[name], at[label]] = weight
        moves = np.zeros((len(labels), len(labels)))
        for (one, other), weight in info.transitions.items():
            moves[at[one], at[other]] = weight
        tagger.close()
    return Field(labels, rows, weights, moves)
