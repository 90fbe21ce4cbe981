"""The network in PyTorch: the encoder of MiniLM, and a decoder that writes or points.

Encoder: BERT [Devlin et al. 2019] with the weights of MiniLM [Wang et al. 2020]; decoder: two
layers of a transformer [Vaswani et al. 2017] whose answer is one distribution over its own words
and the units of the sentence, as pointer networks have it for parsing [Rongali et al. 2020].
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import torch
from torch import Tensor, nn
from torch.nn import functional as fn

from intents.english.paraphrase.source import SORTS


class Size(NamedTuple):
    """How large a network is."""

    pieces: int
    words: int
    layers: int = 6
    wide: int = 384
    heads: int = 12
    inner: int = 1536
    writers: int = 2
    writer_heads: int = 6
    writer_inner: int = 768
    longest: int = 96
    longest_plain: int = 64


_NAMES = {
    "attention.query": "attention.self.query", "attention.key": "attention.self.key",
    "attention.value": "attention.self.value", "attention.out": "attention.output.dense",
    "attended": "attention.output.LayerNorm", "inner": "intermediate.dense",
    "outer": "output.dense", "done": "output.LayerNorm",
}  # fmt: skip
"""What the parts of a layer are called by us and by them."""


class Attention(nn.Module):
    """Attention of several heads, from one row of states to another."""

    def __init__(self, wide: int, heads: int, drop: float) -> None:
        super().__init__()
        self.heads, self.drop = heads, drop
        self.query, self.key, self.value, self.out = (nn.Linear(wide, wide) for _ in range(4))

    def forward(self, to: Tensor, of: Tensor, mask: Tensor) -> Tensor:
        """From each state of `to` to those of `of`."""

        def split(x: Tensor) -> Tensor:
            return x.unflatten(-1, (self.heads, -1)).transpose(1, 2)

        drop = self.drop if self.training else 0.0
        heads = fn.scaled_dot_product_attention(
            split(self.query(to)), split(self.key(of)), split(self.value(of)), mask, drop
        )
        return self.out(heads.transpose(1, 2).flatten(2))


class Reader(nn.Module):
    """A layer of the encoder."""

    def __init__(self, size: Size, drop: float) -> None:
        super().__init__()
        self.attention = Attention(size.wide, size.heads, drop)
        self.attended = nn.LayerNorm(size.wide, 1e-12)
        self.inner, self.outer = nn.Linear(size.wide, size.inner), nn.Linear(size.inner, size.wide)
        self.done = nn.LayerNorm(size.wide, 1e-12)
        self.drop = nn.Dropout(drop)

    def forward(self, x: Tensor, mask: Tensor) -> Tensor:
        """The states after this layer."""
        x = self.attended(x + self.drop(self.attention(x, x, mask)))
        return self.done(x + self.drop(self.outer(fn.gelu(self.inner(x)))))


class Writer(nn.Module):
    """A layer of the decoder."""

    def __init__(self, size: Size, drop: float) -> None:
        super().__init__()
        self.own = Attention(size.wide, size.writer_heads, drop)
        self.cross = Attention(size.wide, size.writer_heads, drop)
        self.inner = nn.Linear(size.wide, size.writer_inner)
        self.outer = nn.Linear(size.writer_inner, size.wide)
        self.norms = nn.ModuleList(nn.LayerNorm(size.wide) for _ in range(3))
        self.drop = nn.Dropout(drop)

    def forward(self, x: Tensor, before: Tensor, read: Tensor, mask: Tensor) -> Tensor:
        """The states after this layer; `before` is what each may look back at."""
        own, cross, inner = self.norms
        y = own(x)
        x = x + self.drop(self.own(y, y, before))
        x = x + self.drop(self.cross(cross(x), read, mask))
        return x + self.drop(self.outer(fn.gelu(self.inner(inner(x)))))


class Network(nn.Module):
    """Reads pieces, writes plain words or points at units."""

    def __init__(self, size: Size, drop: float = 0.1) -> None:
        super().__init__()
        self.size = size
        wide = size.wide
        self.pieces = nn.Embedding(size.pieces, wide)
        self.places = nn.Embedding(size.longest, wide)
        self.sorts = nn.Embedding(2 * len(SORTS), wide)
        self.read_in = nn.LayerNorm(wide, 1e-12)
        self.readers = nn.ModuleList(Reader(size, drop) for _ in range(size.layers))
        self.words = nn.Embedding(size.words, wide)
        self.plain_places = nn.Embedding(size.longest_plain, wide)
        self.pointed = nn.Linear(wide, wide)
        self.writers = nn.ModuleList(Writer(size, drop) for _ in range(size.writers))
        self.write_out = nn.LayerNorm(wide)
        self.points = nn.Linear(wide, wide)
        self.bias = nn.Parameter(torch.zeros(size.words))
        self.drop = nn.Dropout(drop)
        for part in (self.words, self.plain_places):
            nn.init.normal_(part.weight, std=0.05)
        nn.init.zeros_(self.sorts.weight)

    def encode(self, pieces: Tensor, sorts: Tensor, mask: Tensor) -> Tensor:
        """States of the pieces; shapes (n, t), mask True where there is a piece."""
        at = torch.arange(pieces.shape[1])
        x = self.pieces(pieces) + self.places(at) + self.sorts(sorts)
        x = self.drop(self.read_in(x))
        for layer in self.readers:
            x = layer(x, mask[:, None, None, :])
        return x

    def decode(
        self, read: Tensor, mask: Tensor, heads: Tensor, has: Tensor, plain: Tensor
    ) -> Tensor:
        """Scores of what comes after each plain word.

        Args:
            read: states, shape (n, t, wide).
            mask: where there is a piece, shape (n, t).
            heads: the first piece of each unit, shape (n, u).
            has: where there is a unit, shape (n, u).
            plain: what was written, below `words` a word, else a unit; shape (n, s).

        Returns:
            Shape (n, s, words + u).
        """
        wide, words = self.size.wide, self.size.words
        states = read.gather(1, heads[..., None].expand(-1, -1, wide))
        unit = (plain - words).clamp(min=0)
        pointed = self.pointed(states).gather(1, unit[..., None].expand(-1, -1, wide))
        written = self.words(plain.clamp(max=words - 1))
        x = torch.where((plain >= words)[..., None], pointed.to(written.dtype), written)
        count = plain.shape[1]
        x = self.drop(x + self.plain_places(torch.arange(count)))
        before = torch.ones(count, count, dtype=torch.bool).tril()
        for layer in self.writers:
            x = layer(x, before, read, mask[:, None, None, :])
        x = self.write_out(x)
        own = x @ self.words.weight.T / math.sqrt(wide) * 4.0 + self.bias
        point = self.points(x) @ states.transpose(1, 2) / math.sqrt(wide)
        point = point.masked_fill(~has[:, None, :], -1e4)
        return torch.cat([own, point], dim=-1)

    def take_over(self, weights: Mapping[str, Tensor], pieces: Sequence[int]) -> None:
        """Begin with the encoder of MiniLM; the states of its pieces are not learnt.

        Args:
            weights: the tensors of MiniLM-L6-H384 by name.
            pieces: which of its pieces are read.
        """
        words = "embeddings.word_embeddings.weight"
        known = {
            "pieces.weight": weights[words][list(pieces)],
            "places.weight": weights["embeddings.position_embeddings.weight"][: self.size.longest]
            + weights["embeddings.token_type_embeddings.weight"][0],
            "read_in.weight": weights["embeddings.LayerNorm.weight"],
            "read_in.bias": weights["embeddings.LayerNorm.bias"],
        }
        for n in range(self.size.layers):
            for ours, theirs in _NAMES.items():
                for kind in ("weight", "bias"):
                    name = f"readers.{n}.{ours}.{kind}"
                    known[name] = weights[f"encoder.layer.{n}.{theirs}.{kind}"]
        self.load_state_dict(known, strict=False)
        self.pieces.weight.requires_grad_(requires_grad=False)

    def parameters_by_part(self) -> tuple[list[nn.Parameter], list[nn.Parameter]]:
        """What is learnt of the encoder, and of all else."""
        reads = ("readers", "read_in", "places")
        learnt = [(name, one) for name, one in self.named_parameters() if one.requires_grad]
        return (
            [one for name, one in learnt if name.startswith(reads)],
            [one for name, one in learnt if not name.startswith(reads)],
        )
