"""Whether a reading says what was said: a second witness, who did not make it.

The network that says sentences in plain words (:mod:`intents.english.paraphrase`) also tells how
likely it finds the plain words of a reading that the grammar made: where an order is left out, a
word is read otherwise, or nothing was to be done, some of them surprise it. One more field of a
single place (:mod:`field`) weighs that, with what the network says itself, how likely the reading
is by itself (:mod:`choice`), and how plainly the sentence is put. It learnt from readings of
sentences that the network had not heard. What it doubts is asked about; it makes nothing be done.
"""

import re
from collections.abc import Iterator, Sequence
from typing import Any, Literal, NamedTuple, cast

import msgspec

from intents.english.learnt.choice import KINDS, Name
from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.plainness import is_plainly_put, plainness
from intents.english.learnt.trust import RIGHT
from intents.goals import Goal, to_builtins

Witness = Literal["agree", "differ", "unread", "ask", "nothing"]
"""What the network's own words come to: the same goals, others, none that the grammar can read, or
that the sentence has to be asked about, or asks for nothing."""
_SURPRISE = (-20, -14, -10, -8, -6, -5, -4, -3, -2.5, -2, -1.5, -1, -0.7, -0.5, -0.3, -0.2, -0.1,
             -0.05)  # fmt: skip
"""Levels of a logarithm of a probability."""
_ALONE = (0.3, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.93, 0.95, 0.97, 0.98)
_SURE = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95)
_PEOPLE = {"wearing", "gesture", "posture", "gender"}
_ASKED = re.compile(r"(?:what|how|where|who|which|the time|the day|something|a joke)\b", re.I)
_WORD = re.compile(r"[\w']+")


class Said(NamedTuple):
    """A sentence, what the grammar makes of it, and what the network thinks of that.

    Attributes:
        text: The sentence.
        names: The names in it.
        goals: What it is read as.
        told: What the grammar remarks on it.
        alone: How likely the reading is by itself [0..1].
        found: For each plain word of the reading how likely the network finds it, and the word
            that it would have written there, as logarithms; None if it cannot say them.
        witness: What the network's own words come to.
        likely: How sure it is of those [0..1].
    """

    text: str
    names: Sequence[Name]
    goals: tuple[Goal, ...]
    told: str
    alone: float
    found: Sequence[tuple[float, float]] | None
    witness: Witness
    likely: float


def check(said: Said, fields: Fields = LEARNT) -> float:
    """How likely a reading is what was meant [0..1]."""
    field = fields["check"]
    return float(field.marginals([signs(said)])[0][field.labels.index(RIGHT)])


def is_unfamiliar(goals: Sequence[Goal]) -> bool:
    """Whether goals are of kinds of which the network has hardly heard: its surprise says nothing.

    Whom one tells by their clothes or gestures, what is to be answered, what is told on a question.
    """
    return any(_is_strange(key, value) for key, value in _slots(to_builtins(tuple(goals))))


def _is_strange(key: str, value: object) -> bool:
    if key in _PEOPLE or (key, value) == ("goal", "answer"):
        return True
    if key == "property":
        return value not in ("name", "location")
    return key == "what" and isinstance(value, str) and _ASKED.match(value) is not None


def _slots(value: object) -> Iterator[tuple[str, object]]:
    if isinstance(value, dict):
        for key, inner in cast("dict[str, Any]", value).items():
            yield key, inner
            yield from _slots(inner)
    elif isinstance(value, list):
        for inner in cast("list[object]", value):
            yield from _slots(inner)


def signs(said: Said) -> list[str]:
    """What tells for or against a reading, as features.

    What weighs most stands there once more for sentences that are plainly put.
    """
    names = [name.said for name in said.names]
    most = [*_above("alone", said.alone, _ALONE), *_of_network(said)]
    plain = is_plainly_put(said.text, names)
    found = ["always", "plain" if plain else "freely", *most, *_of_goals(said), *_of_words(said)]
    found += plainness(said.text, names, len(said.goals), said.told)
    return found + [f"plain|{sign}" for sign in most if plain]


def _above(name: str, value: float, levels: Sequence[float]) -> Iterator[str]:
    return (f"{name}>={level}" for level in levels if value >= level)


def _of_network(said: Said) -> Iterator[str]:
    if is_unfamiliar(said.goals):
        yield "unfamiliar"
        return
    yield said.witness
    yield from _above(f"{said.witness}|p", said.likely, _SURE)
    if said.found is None:
        yield "unsayable"
        return
    yield from _above("all", sum(own for own, _ in said.found), _SURPRISE)
    yield from _above("least", min(own for own, _ in said.found), _SURPRISE[::2])
    yield from _above("behind", sum(own - most for own, most in said.found), _SURPRISE[::2])


def _of_goals(said: Said) -> Iterator[str]:
    plain = to_builtins(said.goals)
    acts = sorted({str(goal["goal"]) for goal in plain})
    yield from (f"act={act}" for act in acts)
    yield f"acts={'+'.join(acts)}"
    yield f"goals={min(len(plain), 4)}"
    told = msgspec.json.encode(plain).decode().lower()
    whole = [one for one in said.names if one.is_whole]
    gone = [one for one in whole if not any(name.lower() in told for name in one.names)]
    yield f"names={min(len(said.names), 5)}"
    yield f"lost={min(len(gone), 3)}"
    yield from (f"lost {one.sort}" for one in gone)


def _of_words(said: Said) -> Iterator[str]:
    words = set(_WORD.findall(said.text.lower().replace("’", "'")))
    yield from (f"has {kind}" for kind, known in KINDS if words & known)
    yield f"words={min(len(words) // 4, 7)}"
    yield f"commas={min(said.text.count(','), 4)}"
    last = said.text.rstrip()[-1:]
    yield f"ends={last if last in '?!.' else ''}"
