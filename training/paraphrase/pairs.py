"""Sentences with plain words beside them: `X.vocab.json`, and `X.tsv` (who, sentence, plain words).

The plain words are those of `plain_words`, with some freedom; "NO" asks for nothing, "ASK"
has to be asked about.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from intents.context import Context
from intents.english.paraphrase.paraphrasing import ASK, NOTHING
from intents.outcomes import Goals
from intents.parser import first_look
from intents.plain_words import plainly
from intents.vocabulary import Names, Vocabulary
from robot.files import plain_data
from training.marked import Marked

PAIRS = Path(__file__).with_name("pairs")
_SPOKEN = {"NO": NOTHING, "ASK": ASK}
_QUOTED = re.compile(r'"([^"]*)"')


def pairs(worlds: str = "*") -> Iterator[tuple[Marked, str]]:
    """The sentences said in worlds that are called so, each with its plain words."""
    for world in sorted(PAIRS.glob(f"{worlds}.vocab.json")):
        named = plain_data.from_json(world.read_text(encoding="utf-8"))
        vocabulary = plain_data.fitted(named, Names, world).vocabulary()
        name = world.name.removesuffix(".vocab.json")
        for line in world.with_name(f"{name}.tsv").read_text(encoding="utf-8").splitlines():
            who, said, plain = line.split("\t")
            told = _SPOKEN.get(plain) or _usual(plain, vocabulary)
            silent = (False,) * len(said)
            yield Marked(said, silent, vocabulary, f"{name} {who}", "pair", told, ()), told


def _usual(plain: str, vocabulary: Vocabulary) -> str:
    """Plain words as the goals that they ask for are always put; else as they are."""
    told = _QUOTED.sub(r"“\1”", plain.strip().rstrip("."))
    told = re.sub(r"\s*;\s*", " ; ", told).replace(" otherwise:", " otherwise")
    read = first_look(told, vocabulary, Context()).outcome
    if not isinstance(read, Goals):
        return told
    usual = plainly(read.goals)
    again = first_look(usual, vocabulary, Context()).outcome
    same = isinstance(again, Goals) and again.goals == read.goals
    return usual if same or usual.count(";") == told.count(";") else told
