"""A network as a file: matrices as bytes with a scale for each row."""

from __future__ import annotations

import io
from collections.abc import Sequence

import numpy as np
import torch

from training.paraphrase.network import Network

_SMALL = ("places.weight", "plain_places.weight", "sorts.weight")


def packed(network: Network, known: Sequence[str], words: Sequence[str]) -> bytes:
    """A network with the pieces that it reads and the words that it writes."""
    stored = {"pieces": _bytes(known), "words": _bytes(words)}
    for name, value in network.state_dict().items():
        plain = value.detach().to(torch.float32).numpy()
        if plain.ndim < 2 or name in _SMALL:
            stored[name] = plain.astype(np.float16 if plain.ndim > 1 else np.float32)
            continue
        scale = np.maximum(np.abs(plain).max(axis=1), 1e-8) / 127.0
        stored[f"{name}.bytes"] = np.round(plain / scale[:, None]).astype(np.int8)
        stored[f"{name}.scale"] = scale.astype(np.float32)
    file = io.BytesIO()
    np.savez_compressed(file, **stored)
    return file.getvalue()


def _bytes(words: Sequence[str]) -> np.ndarray:
    return np.frombuffer("\n".join(words).encode(), dtype=np.uint8)
