"""What is said and what it says in plain words, as a network learns it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Any, NamedTuple, cast

import msgspec

from intents.context import Context
from intents.english.paraphrase.paraphrasing import ASK, NOTHING
from intents.english.paraphrase.pointing import pointing
from intents.english.paraphrase.source import Unit, units, words_of
from intents.english.words.names import index_of
from intents.goals import Goal
from intents.outcomes import Goals
from intents.parser import first_look
from intents.plain_words import plainly
from intents.vocabulary import Vocabulary
from training.marked import Marked
from training.trusting import is_meant


class Pair(NamedTuple):
    """A sentence and its plain words.

    Attributes:
        words: The words and signs of the sentence.
        units: What can be pointed at in it.
        plain: Its plain words, each as a word or as the number of the unit that it comes from.
        speaker: Who says it.
        source: The sentence that it comes from.
    """

    words: tuple[str, ...]
    units: tuple[Unit, ...]
    plain: tuple[str | int, ...]
    speaker: str
    source: Marked


def in_plain_words(sentence: Marked) -> str | None:
    """A marked sentence in plain words that the grammar reads as its goals; None without any."""
    if isinstance(sentence.gold, str):
        return ASK if sentence.gold == "ask" else NOTHING
    try:
        goals = msgspec.convert(_usual(sentence.gold), tuple[Goal, ...])
    except msgspec.ValidationError:
        return None
    plain = plainly(goals)
    read = first_look(plain, sentence.vocabulary, Context()).outcome
    return plain if isinstance(read, Goals) and is_meant(sentence, read.goals) else None


def _usual(gold: Any) -> Any:
    """Goals with what was written otherwise put as the goals have it."""
    if isinstance(gold, list):
        return [_usual(one) for one in cast("list[Any]", gold)]
    if not isinstance(gold, dict):
        return gold
    plain = {key: _usual(value) for key, value in cast("dict[str, Any]", gold).items()}
    if plain.get("goal") == "tell" and isinstance(of := plain.pop("of", None), dict):
        human = {"posture", "gesture", "gender", "wearing", "who"} & set(cast("Any", of))
        plain["person" if human else "object"] = of
    at = plain.get("at")
    if plain.get("goal") == "gesture" and isinstance(at, dict):
        known = cast("dict[str, str]", at)
        plain["at"] = known.get("name") or known.get("who") or known.get("at")
    return plain


def common_words(told: Iterable[tuple[str, Vocabulary]], least: int = 6) -> list[str]:
    """The plain words that are written, not pointed at, the most frequent first."""
    count: Counter[str] = Counter()
    for plain, vocabulary in told:
        for unit in units(words_of(plain), index_of(vocabulary)):
            if not unit.names:
                count[unit.said] += 1
    return [word for word, n in count.most_common() if n >= least]


def pair(sentence: Marked, plain: str, known: frozenset[str]) -> Pair | None:
    """A sentence with what points in its plain words; None if a name or word is nowhere in it."""
    index = index_of(sentence.vocabulary)
    words = words_of(sentence.text)
    said = units(words, index)
    told = pointing(plain, said, index, known)
    if told is None:
        return None
    return Pair(tuple(w.raw for w in words), tuple(said), tuple(told), sentence.speaker, sentence)
