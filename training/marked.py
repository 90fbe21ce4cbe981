"""Sentences in which what asks for nothing is wrapped in ⟦ ⟧."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from intents.vocabulary import Names, Vocabulary
from robot.files import plain_data

SENTENCES = Path(__file__).with_name("sentences")
_OPEN, _CLOSE = "⟦", "⟧"


class Marked(NamedTuple):
    """A sentence.

    Attributes:
        text: What is said, without marks.
        idle: For each character whether it asks for nothing.
        vocabulary: The names of its world.
        speaker: Who says it.
        kind: What kind of sentence it is.
        gold: The goals that are meant, "ask" or "refuse".
        also: Further readings that will do.
    """

    text: str
    idle: tuple[bool, ...]
    vocabulary: Vocabulary
    speaker: str
    kind: str
    gold: Any
    also: tuple[Any, ...]

    @property
    def asked(self) -> str:
        """What is left without the background."""
        return "".join(c for c, idle in zip(self.text, self.idle, strict=True) if not idle)


def unmarked(text: str) -> tuple[str, tuple[bool, ...]]:
    """A text without its marks, and for each character whether it stood between them.

    Raises:
        ValueError: The marks do not match.
    """
    plain: list[str] = []
    idle: list[bool] = []
    inside = False
    for c in text:
        if c in (_OPEN, _CLOSE):
            if inside == (c == _OPEN):
                raise ValueError(f"the marks do not match in {text!r}")
            inside = c == _OPEN
            continue
        plain.append(c)
        idle.append(inside)
    if inside:
        raise ValueError(f"the marks do not match in {text!r}")
    return "".join(plain), tuple(idle)


def sentences(folder: Path = SENTENCES) -> Iterator[Marked]:
    """All sentences of a folder: `X.vocab.json` and the `X*.jsonl` that belong to it."""
    for world in sorted(folder.glob("*.vocab.json")):
        named = plain_data.from_json(world.read_text(encoding="utf-8"))
        vocabulary = plain_data.fitted(named, Names, world).vocabulary()
        for file in sorted(folder.glob(f"{world.name.removesuffix('.vocab.json')}*.jsonl")):
            for line in file.read_text(encoding="utf-8").splitlines():
                record = json.loads(line)
                text, idle = unmarked(record["text"])
                yield Marked(
                    text, idle, vocabulary, record["persona"], record["kind"], record["gold"],
                    tuple(record.get("ok", [])),
                )  # fmt: skip
