"""Which sound of which word each moment of an utterance is: a forced alignment.

The words are known, each is a chain of phones, each phone a chain of three states, and between
words there may be silence; the best path is found by dynamic programming [Viterbi 1967].
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from intents.speech.acoustics import SILENCE, STATES, STREAMS, Acoustics, log_sum
from intents.speech.cepstra import Cepstra, with_changes

States = NDArray[np.intp]
"""Shape (frames, 2): the number of the phone, and which of its states."""
_STAYS, _LEAVES = np.log(0.7), np.log(0.3)
_NEVER = -1e30


def aligned(values: Cepstra, words: Iterable[Sequence[str]], model: Acoustics) -> States:
    """The state of each frame; all silence, if there is not time enough for the words.

    Args:
        values: centred cepstra.
        words: the phones of each word.
        model: whose sounds they are.
    """
    names, passed_over = [SILENCE], [False]
    for word in words:
        names += [*word, SILENCE]
        passed_over += [*([False] * len(word)), True]
    passed_over[-1] = False
    chain = np.array([(model.phones[name], k) for name in names for k in range(STATES)])
    from_before = np.full(len(chain), -1)
    for number in range(2, len(names)):
        if passed_over[number - 1]:
            from_before[STATES * number] = STATES * (number - 1) - 1
    if len(values) < len(chain) - STATES * sum(passed_over):
        return np.tile(chain[0], (len(values), 1))
    return chain[_best_path(_fitting(values, chain, model), from_before)]


def _fitting(values: Cepstra, chain: States, model: Acoustics) -> NDArray[np.float64]:
    """How well each frame fits each state of the chain [nat]."""
    streams = with_changes(values)
    found: dict[tuple[int, int], NDArray[np.float64]] = {}
    for phone in {int(phone) for phone in chain[:, 0]}:
        scores = [model.scores(phone, stream, streams[stream]) for stream in range(STREAMS)]
        for state in range(STATES):
            weighed = [scores[k] + model.weights[phone, state, k] for k in range(STREAMS)]
            found[phone, state] = np.sum([log_sum(one) for one in weighed], axis=0)
    return np.stack([found[int(phone), int(state)] for phone, state in chain], axis=1)


def _best_path(fitting: NDArray[np.float64], from_before: States) -> States:
    """The place in the chain at each frame: it stays, goes on, or passes over a silence."""
    frames, length = fitting.shape
    here = np.arange(length, dtype=np.intp)
    best = np.full(length, _NEVER)
    best[0] = fitting[0, 0]
    came_from = np.zeros((frames, length), dtype=np.intp)
    for frame in range(1, frames):
        ways = np.full((3, length), _NEVER)
        ways[0] = best + _STAYS
        ways[1, 1:] = best[:-1] + _LEAVES
        ways[2] = np.where(from_before >= 0, best[from_before] + _LEAVES, _NEVER)
        way = ways.argmax(axis=0)
        best = ways.max(axis=0) + fitting[frame]
        came_from[frame] = np.choose(way, np.stack([here, here - 1, from_before]))
    path = [length - 1]
    for frame in range(frames - 1, 0, -1):
        path.append(came_from[frame, path[-1]])
    return np.array(path[::-1])
