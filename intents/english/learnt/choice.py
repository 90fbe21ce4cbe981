"""Which is what was meant: the grammar's reading, or that of the words a network says instead.

One more field of a single place (:mod:`field`) weighs what tells for and against either: how sure
the network is of its words, whether both come to the same, what either leaves out, and why the
grammar stumbled. It learnt from sentences that the network had not heard.
"""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, Literal, NamedTuple, cast

import msgspec

from intents.english.faithfulness import CARRYING
from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.trust import RIGHT, act
from intents.english.words import lexicon, limits
from intents.goals import Goal, to_builtins

OWN, OTHER = "own", "other"
Source = Literal["own", "other"]
"""What the grammar reads in a sentence, and in the words that the network says instead."""
Kind = Literal["goals", "question", "refusal", "nothing"]
_LEVELS = (0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 0.95, 0.98, 0.995)
_KINDS = (
    ("condition", limits.CONDITIONS), ("time", limits.TIMES), ("denial", limits.DENIALS),
    ("choice", limits.CHOICES), ("quantity", limits.QUANTITIES), ("measure", limits.MEASURES),
    ("spot", limits.SPOTS), ("quality", CARRYING),
    ("exception", lexicon.words("except exept xept cept excepting bar but save besides apart")),
)  # fmt: skip
"""Kinds of words that would limit an order."""
_WORD, _END = re.compile(r"[\w']+"), re.compile(r"[.!?…](?:\s|$)")


class Name(NamedTuple):
    """A name of the world in a sentence.

    Attributes:
        sort: What it is a name of.
        names: Those that it can stand for.
        is_whole: Whether all of the name is said.
    """

    sort: str
    names: tuple[str, ...]
    is_whole: bool


class Side(NamedTuple):
    """What one of the two comes to.

    Attributes:
        kind: Orders, a question, a refusal, or nothing.
        goals: What is asked for, or asked about.
        trouble: Why the grammar could not read it all: the name of the error; empty if it could.
        puzzled: Whether other words might be read better.
    """

    kind: Kind
    goals: tuple[Goal, ...] = ()
    trouble: str = ""
    puzzled: bool = False


class Both(NamedTuple):
    """A sentence and what the two make of it.

    Attributes:
        text: The sentence.
        names: The names in it.
        plain: What the network says instead.
        likely: How sure it is of that [0..1].
        own: The sentence as the grammar reads it.
        other: The plain words as the grammar reads them.
    """

    text: str
    names: Sequence[Name]
    plain: str
    likely: float
    own: Side
    other: Side


def choice(both: Both, fields: Fields = LEARNT) -> tuple[float, float]:
    """How likely the own reading and the other are what was meant [0..1]; 0 where there is none."""
    return _likely(both, OWN, fields), _likely(both, OTHER, fields)


def _likely(both: Both, source: Source, fields: Fields) -> float:
    if not (both.own if source == OWN else both.other).goals:
        return 0.0
    field = fields["choice"]
    return float(field.marginals([signs(both, source)])[0][field.labels.index(RIGHT)])


def signs(both: Both, source: Source) -> list[str]:
    """What tells for or against one of the two, as features."""
    side = both.own if source == OWN else both.other
    found = [*_of_both(both), *_of_goals(both, side), *_of_words(both, side, source)]
    return [f"{source}:{sign}" for sign in ("always", *found)]


def _of_both(both: Both) -> Iterator[str]:
    own, relation = both.own, _relation(both.own.goals, both.other.goals)
    sure = f"p={sum(both.likely >= one for one in _LEVELS)}"
    length = f"words={min(len(_WORD.findall(both.text)) // 4, 7)}"
    yield from (
        own.kind,
        f"trouble={own.trouble}",
        f"puzzled={own.puzzled}",
        relation,
        sure,
        length,
    )
    yield f"other={both.other.kind}"
    yield f"{sure}|{relation}"
    yield f"{sure}|{own.trouble}"
    yield f"{relation}|{own.kind}"
    yield f"{length}|{own.kind}"
    yield f"{sure}|{relation}|{own.kind}"


def _relation(own: Sequence[Goal], other: Sequence[Goal]) -> str:
    """How two lists of goals stand to one another."""
    if not own or not other:
        return f"{bool(own)}/{bool(other)}"
    one, two = (Counter(_written((goal,)) for goal in goals) for goals in (own, other))
    if one == two:
        return "same"
    if not one - two:
        return "less"
    if not two - one:
        return "more"
    acts = [sorted(map(_act, goals)) for goals in (own, other)]
    return "other slots" if acts[0] == acts[1] else "unlike"


def lost(both: Both) -> list[Name]:
    """The names that are said whole and do not come back in what the network makes of it."""
    return [one for one in _lost(both, both.other) if one.is_whole]


def _lost(both: Both, side: Side) -> list[Name]:
    told = _written(side.goals)
    return [one for one in both.names if not any(name.lower() in told for name in one.names)]


def _of_goals(both: Both, side: Side) -> Iterator[str]:
    acts = sorted(map(_act, side.goals))
    yield f"goals={min(len(acts), 4)}"
    yield f"acts={'+'.join(dict.fromkeys(acts))}"
    yield from (f"act={one}" for one in dict.fromkeys(acts))
    gone = _lost(both, side)
    whole = [one for one in gone if one.is_whole]
    yield f"names={min(sum(one.is_whole for one in both.names), 5)}"
    yield f"lost={min(len(whole), 3)}"
    yield f"lost parts={min(len(gone) - len(whole), 3)}"
    yield f"p={sum(both.likely >= one for one in _LEVELS)}|lost={min(len(whole), 2)}"
    yield from (f"lost {one.sort}" for one in whole)


def _of_words(both: Both, side: Side, source: Source) -> Iterator[str]:
    words = set(_WORD.findall(both.text.lower().replace("’", "'")))
    plain = set(_WORD.findall(both.plain.lower()))
    for kind, known in _KINDS:
        if words & known:
            yield f"has {kind}"
            if source == OTHER:
                yield f"has {kind}: {'kept' if plain & known else 'lost'}"
    if any(word[0].isdigit() for word in words):
        yield "figure"
    if "if" in words:
        yield f"if: {'kept' if any(_act(goal) == 'if' for goal in side.goals) else 'lost'}"
    yield f"sentences={min(len(_END.findall(both.text)), 4)}"
    yield f"commas={min(both.text.count(','), 4)}"


def _act(goal: Goal) -> str:
    return act(cast("dict[str, Any]", to_builtins((goal,))[0]))


def _written(goals: Sequence[Goal]) -> str:
    """Goals as a text in which names can be looked for."""
    return msgspec.json.encode(to_builtins(goals)).decode().lower()
