"""Teaches the network with PyTorch: one that has read English, or the one that ships, further."""

from __future__ import annotations

import json
import math
import random
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import torch
from torch.nn import functional as fn

from intents.english.paraphrase.network import shipped
from training.paraphrase.batches import BEGIN, END, Otherwise, batch
from training.paraphrase.examples import Pair
from training.paraphrase.network import Network, Size

_SPECIAL = ("[PAD]", "[UNK]", "[CLS]", "[SEP]", "[MASK]")
_FREQUENT = 20_000
"""Pieces of BERT's list are about in the order of how frequent they are."""
_BATCH = 24
_READ_RATE, _WRITE_RATE, _WARM_STEPS = 1e-4, 8e-4, 200
_HIDDEN = 0.02
"""So many pieces are hidden, so that no single word decides."""
_LONGEST_PLAIN = 63


class Begun(NamedTuple):
    """A network to teach.

    Attributes:
        network: It.
        pieces: The pieces that it reads.
        words: The plain words that it writes, with those that begin and end.
        pace: How fast it learns: so much of the rates for one that has learnt only to read.
    """

    network: Network
    pieces: list[str]
    words: list[str]
    pace: float = 1.0


def reader(folder: Path, words: Sequence[str]) -> Begun:
    """MiniLM-L6-H384 (uncased), which has read English, without the pieces that are rare.

    Args:
        folder: Holds its `model.safetensors` and `vocab.txt`.
        words: The plain words to write.

    Raises:
        FileNotFoundError: The folder does not hold it.
    """
    every = (folder / "vocab.txt").read_text(encoding="utf-8").rstrip("\n").split("\n")
    kept = [
        n for n, piece in enumerate(every)
        if piece in _SPECIAL or (piece.isascii() and not piece.startswith("[unused")
                                 and (n < _FREQUENT or piece.startswith("##")))
    ]  # fmt: skip
    written = [BEGIN, END, *words]
    network = Network(Size(len(kept), len(written)))
    network.take_over(_tensors(folder / "model.safetensors"), kept)
    return Begun(network, [every[n] for n in kept], written)


def taught() -> Begun:
    """What comes with the package, to go on with."""
    ours = shipped()
    state = {name: torch.from_numpy(one.copy()) for name, one in ours.numbers.items()}
    for name, matrix in ours.matrices.items():
        state[name] = torch.from_numpy(matrix.bytes.astype(np.float32) * matrix.scale[:, None])
    network = Network(Size(len(ours.known), len(ours.words)))
    network.load_state_dict(state)
    network.pieces.weight.requires_grad_(requires_grad=False)
    return Begun(network, list(ours.known), list(ours.words), pace=0.5)


def _tensors(path: Path) -> dict[str, torch.Tensor]:
    """The tensors of a safetensors file: the length of a JSON header, the header, the numbers."""
    data = path.read_bytes()
    length = int.from_bytes(data[:8], "little")
    header: dict[str, Any] = json.loads(data[8 : 8 + length])
    body = data[8 + length :]
    found = {}
    for name, told in header.items():
        if name != "__metadata__" and told["dtype"] == "F32":
            start, end = told["data_offsets"]
            numbers = np.frombuffer(body[start:end], np.float32).reshape(told["shape"])
            found[name] = torch.from_numpy(numbers.copy())
    return found


class Lesson(NamedTuple):
    """How far it is: the mean of so many losses, and the network."""

    loss: float
    network: Network


class Teacher:
    """Teaches pairs.

    Attributes:
        words: The plain words that the network writes.
        pieces: The pieces that it reads.
        steps: So many batches it takes.
    """

    def __init__(self, pairs: Sequence[Pair], begun: Begun, *, epochs: int, seed: int) -> None:
        torch.manual_seed(seed)
        self._dice = random.Random(seed)
        self._pairs, self._epochs, self._pace = list(pairs), epochs, begun.pace
        self.network, self.pieces, self.words = begun.network, begun.pieces, begun.words
        self.steps = epochs * math.ceil(len(pairs) / _BATCH)
        self._otherwise = Otherwise(_names(pairs), seed)

    def lessons(self) -> Iterator[Lesson]:
        """Learn, one batch after the other."""
        network = self.network
        reads, writes = network.parameters_by_part()
        adam = torch.optim.AdamW(
            [{"params": reads, "lr": self._pace * _READ_RATE},
             {"params": writes, "lr": self._pace * _WRITE_RATE}],
            weight_decay=0.01, betas=(0.9, 0.98), fused=True,
        )  # fmt: skip
        rate = torch.optim.lr_scheduler.LambdaLR(adam, self._rate)
        known, numbers = _numbered(self.pieces), _numbered(self.words)
        for _ in range(self._epochs):
            for chosen in self._batches():
                told = [self._otherwise(one) for one in chosen]
                now = batch(told, known, numbers, network.size.longest)
                hides = (torch.rand(now.pieces.shape) < _HIDDEN) & now.mask & (now.sorts == 0)
                hides[:, 0] = False
                pieces = torch.where(hides, known["[MASK]"], now.pieces)
                network.train()
                with torch.autocast("cpu", torch.bfloat16):
                    read = network.encode(pieces, now.sorts, now.mask)
                    scores = network.decode(read, now.mask, now.heads, now.has, now.plain)
                loss = fn.cross_entropy(
                    scores.float().flatten(0, 1), now.goal.flatten(), ignore_index=-1
                )
                adam.zero_grad()
                loss.backward()
                torch.nn.utils.clip_grad_norm_(network.parameters(), 1.0)
                adam.step()
                rate.step()
                yield Lesson(loss.item(), network)

    def _rate(self, step: int) -> float:
        """Warming up, then falling as a cosine does."""
        return min(1.0, step / _WARM_STEPS) * 0.5 * (1 + math.cos(math.pi * step / self.steps))

    def _batches(self) -> list[list[Pair]]:
        """Batches of sentences of about the same length."""
        order = [one for one in self._pairs if len(one.plain) < _LONGEST_PLAIN]
        self._dice.shuffle(order)
        wide = 20 * _BATCH
        parts = [
            sorted(order[at : at + wide], key=lambda one: len(one.words))
            for at in range(0, len(order), wide)
        ]
        found = [part[at : at + _BATCH] for part in parts for at in range(0, len(part), _BATCH)]
        self._dice.shuffle(found)
        return found


def _numbered(words: Sequence[str]) -> dict[str, int]:
    return {word: n for n, word in enumerate(words)}


def _names(pairs: Sequence[Pair]) -> dict[str, list[str]]:
    """The names of all worlds, by what they are."""
    found: defaultdict[str, set[str]] = defaultdict(set)
    for vocabulary in {id(one.source.vocabulary): one.source.vocabulary for one in pairs}.values():
        found["category"] |= {one.singular for one in vocabulary.categories}
        named = (
            ("object", vocabulary.objects), ("place", vocabulary.places),
            ("room", vocabulary.rooms), ("person", vocabulary.people),
        )  # fmt: skip
        for sort, some in named:
            found[sort] |= {one.name for one in some}
    return {sort: sorted(some) for sort, some in found.items()}
