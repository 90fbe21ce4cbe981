"""Which is what was meant: the grammar's reading, or that of the words a network says instead.

One more field of a single place (:mod:`field`) weighs what tells for and against either: how sure
the network is of its words, whether both come to the same or in what they differ, what either
leaves out, how plainly the sentence is put, and why the grammar stumbled. It learnt from sentences
that the network had not heard, strangers' and plain ones. Without the network it says how likely
the grammar's reading is by itself, so that what is likely enough costs no time.
"""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, Literal, NamedTuple, cast

import msgspec

from intents.english.faithfulness import CARRYING
from intents.english.learnt.differences import differences
from intents.english.learnt.field import LEARNT, Fields, level
from intents.english.learnt.plainness import is_plainly_put, plainness
from intents.english.learnt.trust import RIGHT, act
from intents.english.words import lexicon, limits
from intents.goals import Goal, to_builtins

OWN, OTHER, ALONE = "own", "other", "alone"
Source = Literal["own", "other", "alone"]
"""What the grammar reads in a sentence, and in the words that the network says instead; the first
also by itself, where the network has not been asked."""
Kind = Literal["goals", "question", "refusal", "nothing"]
_LEVELS = (0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 0.95, 0.98, 0.995)
KINDS = (
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
        said: It as it stands in the sentence.
    """

    sort: str
    names: tuple[str, ...]
    is_whole: bool
    said: str = ""


class Side(NamedTuple):
    """What one of the two comes to.

    Attributes:
        kind: Orders, a question, a refusal, or nothing.
        goals: What is asked for, or asked about.
        trouble: Why the grammar could not read it all: the name of the error; empty if it could.
        puzzled: Whether other words might be read better.
        told: What the grammar remarks on it.
        trust: How likely the fields of the sentence make it (:mod:`trust`) [0..1].
    """

    kind: Kind
    goals: tuple[Goal, ...] = ()
    trouble: str = ""
    puzzled: bool = False
    told: str = ""
    trust: float = 0.0


SILENT = Side("nothing")
"""What has nothing to say, or was not asked."""


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


def alone(text: str, names: Sequence[Name], own: Side, fields: Fields = LEARNT) -> float:
    """How likely the own reading is what was meant [0..1], without asking the network."""
    return _likely(Both(text, names, "", 0.0, own, SILENT), ALONE, fields)


def _likely(both: Both, source: Source, fields: Fields) -> float:
    if not _side(both, source).goals:
        return 0.0
    field = fields["choice"]
    return float(field.marginals([signs(both, source)])[0][field.labels.index(RIGHT)])


def _side(both: Both, source: Source) -> Side:
    return both.other if source == OTHER else both.own


def signs(both: Both, source: Source) -> list[str]:
    """What tells for or against one of the two, as features.

    Each of them also together with whether the sentence is put plainly: an order of known words
    that begins with its verb is read otherwise than what strangers say.
    """
    if source == ALONE:
        both = both._replace(plain="", likely=0.0, other=SILENT)
    side = _side(both, source)
    found = [*_of_goals(both, side), *_of_words(both, side, source), *_of_trust(both, side)]
    said = [name.said for name in both.names]
    found += plainness(both.text, said, len(side.goals), both.own.told)
    if source == ALONE:
        found += [both.own.kind, f"trouble={both.own.trouble}", _length(both)]
    else:
        found += _of_both(both)
        if both.own.goals and both.other.goals:
            found += (f"differs {one}" for one in differences(both.own.goals, both.other.goals))
    manner = "plain" if is_plainly_put(both.text, said) else "freely"
    found = ["always", *found, *(f"{manner} put: {sign}" for sign in ("always", *found))]
    return [f"{source}:{sign}" for sign in found]


def _length(both: Both) -> str:
    return f"words={min(len(_WORD.findall(both.text)) // 4, 7)}"


def _of_trust(both: Both, side: Side) -> Iterator[str]:
    """How likely the fields of the sentence make either reading."""
    trust = f"trust={level(side.trust)}"
    yield trust
    yield f"{trust}|{min(len(side.goals), 3)}"
    if both.likely:
        rival = both.own if side is both.other else both.other
        yield f"{trust}|rival={level(rival.trust)}"
        yield f"{trust}|p={sum(both.likely >= one for one in _LEVELS)}"


def _of_both(both: Both) -> Iterator[str]:
    own, relation = both.own, _relation(both.own.goals, both.other.goals)
    sure = f"p={sum(both.likely >= one for one in _LEVELS)}"
    length = _length(both)
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
    if both.likely:
        yield f"p={sum(both.likely >= one for one in _LEVELS)}|lost={min(len(whole), 2)}"
    yield from (f"lost {one.sort}" for one in whole)


def _of_words(both: Both, side: Side, source: Source) -> Iterator[str]:
    words = set(_WORD.findall(both.text.lower().replace("’", "'")))
    plain = set(_WORD.findall(both.plain.lower()))
    for kind, known in KINDS:
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
