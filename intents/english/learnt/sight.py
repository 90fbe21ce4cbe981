"""A sentence as the learnt fields see it: what each word, each name and the whole may be."""

from functools import lru_cache
from typing import NamedTuple

from intents.english.learnt.background import IDLE
from intents.english.learnt.field import LEARNT, Array, Fields
from intents.english.learnt.looks import Said, looks, said
from intents.english.learnt.roles import Mention, act_looks, mentions
from intents.english.words.names import NameIndex


class Sight(NamedTuple):
    """A sentence as the fields see it.

    Attributes:
        words: The sentence.
        idle: How likely each word is background [0..1], shape (words,).
        acts: How likely it asks for each act [0..1].
        mentions: The names in it.
        roles: For each of them how likely it is each role [0..1].
    """

    words: list[Said]
    idle: Array
    acts: dict[str, float]
    mentions: list[Mention]
    roles: list[dict[str, float]]


def sight(text: str, index: NameIndex, fields: Fields = LEARNT) -> Sight | None:
    """How the fields see a sentence; None if it has no word.

    What the fields of the package see of the last sentences is kept: they are looked at twice.
    """
    return _shipped_sight(text, index) if fields is LEARNT else _sight(text, index, fields)


@lru_cache(maxsize=4)
def _shipped_sight(text: str, index: NameIndex) -> Sight | None:
    return _sight(text, index, LEARNT)


def _sight(text: str, index: NameIndex, fields: Fields) -> Sight | None:
    words = said(text)
    if not words:
        return None
    chain = looks(words, index)
    background, acts, roles = (fields[name] for name in ("background", "acts", "roles"))
    idle = background.marginals(chain)[:, background.labels.index(IDLE)]
    likely = acts.marginals([act_looks(words, chain)])[0]
    by_word = roles.marginals(chain)
    found = mentions(words, index)
    told = [
        dict(zip(roles.labels, by_word[m.start : m.end].min(axis=0).tolist(), strict=True))
        for m in found
    ]
    return Sight(words, idle, dict(zip(acts.labels, likely.tolist(), strict=True)), found, told)
