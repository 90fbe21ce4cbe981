"""How likely a reading is what was meant: the last word on whether to act on it or to ask.

A sentence may be read as it stands, without its background, or in plainer words. What the fields
say of each word, of each name and of the whole agrees with a reading or does not; one more field,
of a single place, weighs that. It learnt from readings of what speakers said that the other fields
had not heard.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import Any, Literal, NamedTuple, cast

from intents.english.faithfulness import CARRYING
from intents.english.learnt.field import LEARNT, Fields, level
from intents.english.learnt.roles import ASK, IDLE, NOTHING, SEVERAL, act_of
from intents.english.learnt.sight import Sight
from intents.english.words import lexicon, limits
from intents.goals import Goal, to_builtins

RIGHT, WRONG = "right", "wrong"
SURE, CERTAIN, NEVER = 0.85, 0.9, 2.0
"""How likely a reading has to be to be acted on: where nothing is lost that may change what is
asked; where something is that seldom does; where something is that mostly does."""
Source = Literal["whole", "rest", "part", "plain"]
"""A sentence as it stands, without its background, without whole clauses, or in plain words."""
_Plain = dict[str, Any]
_HANDLING = frozenset({"bring", "place", "pick", "find"})
"""Acts of which one may stand for another: fetching is finding, taking and bringing."""
_SIDELONG = ("go_to", "say", "pick", "balance", "report", "look_at", "stop", "wait")
"""What is read out of talk beside an order more often than not."""
_KINDS = (
    ("condition", limits.CONDITIONS), ("time", limits.TIMES), ("denial", limits.DENIALS),
    ("choice", limits.CHOICES), ("quantity", limits.QUANTITIES), ("measure", limits.MEASURES),
    ("spot", limits.SPOTS), ("quality", CARRYING),
)  # fmt: skip
"""Kinds of words that would limit an order."""
_ROLE_OF = {"object": "what", "person": "who", "to": "to", "of": "of", "at": "from"}
_ROLE = {"to": "to", "on": "to", "in": "to", "place": "to", "what": "what"}


class Reading(NamedTuple):
    """What a sentence was read as.

    Attributes:
        source: Out of which words.
        goals: What it asks for.
        spans: The characters that were passed over, from where to where.
        left: What does not come back in plain words.
        harms: What may be lost or amiss.
    """

    source: Source
    goals: tuple[Goal, ...]
    spans: tuple[tuple[int, int], ...] = ()
    left: tuple[str, ...] = ()
    harms: frozenset[str] = frozenset()


def trust(
    readings: Sequence[Reading], seen: Sight, trouble: str, fields: Fields = LEARNT
) -> list[float]:
    """How likely each reading of a sentence is what was meant [0..1].

    Args:
        readings: All that the sentence was read as.
        seen: The sentence.
        trouble: Why it is not read as it stands, by the name of the error; empty if it is.
        fields: What was learnt; by default what comes with the package.
    """
    field = fields["trust"]
    right = field.labels.index(RIGHT)
    return [
        float(field.marginals([signs(one, readings, seen, trouble)])[0][right]) for one in readings
    ]  # fmt: skip


def is_known(goals: Iterable[Goal], fields: Fields = LEARNT) -> bool:
    """Whether speakers ask for such acts, so that trust in them says something.

    Competitions ask for others: to answer questions, to tell which thing is the lightest.
    """
    acts = fields["acts"].labels
    told = cast("list[_Plain]", to_builtins(tuple(goals)))
    nameless = any("superlative" in one and "name" not in one for one in _things(told))
    return not nameless and all(act(goal) in acts for goal in told)


def _things(value: object) -> Iterator[_Plain]:
    """Every description in goals."""
    if isinstance(value, dict):
        known = cast("_Plain", value)
        yield known
        yield from chain.from_iterable(map(_things, known.values()))
    elif isinstance(value, list | tuple):
        yield from chain.from_iterable(map(_things, cast("list[object]", value)))


def signs(one: Reading, readings: Iterable[Reading], seen: Sight, trouble: str) -> list[str]:
    """The features of a reading, each also together with the words it was read out of."""
    goals = cast("list[_Plain]", to_builtins(one.goals))
    parts = (
        _of_acts(goals, seen),
        _of_roles(goals, one, seen),
        _of_background(one, seen),
        _of_kept(one, seen),
    )
    found = [f"trouble={trouble}", f"words={min(len(seen.words) // 4, 7)}", *chain(*parts)]
    for other in readings:
        if other is not one:
            same = "as" if other.goals == one.goals else "unlike"
            found.append(f"{same}={other.source}")
    found += [f"left={word}" for word in one.left]
    found += [f"harm={harm}" for harm in one.harms]
    return ["always", *found, one.source, *(f"{sign}|{one.source}" for sign in found)]


def _of_acts(goals: list[_Plain], seen: Sight) -> Iterator[str]:
    """Whether the sentence as a whole asks for what was read."""
    acts = [act(goal) for goal in goals]
    kinds, many = "+".join(sorted(set(acts))), min(len(acts), 4)
    likely = _likely(acts, goals, seen.acts)
    top = max(seen.acts, key=lambda act: seen.acts[act])
    yield f"goals={many}"
    yield f"acts={kinds}"
    yield from (f"act={act}" for act in set(acts))
    yield f"likely={level(likely)}"
    yield f"top={top}"
    yield f"top={top}|{kinds}"
    yield f"ask={level(seen.acts.get(ASK, 0.0))}"
    yield f"idle={level(seen.acts.get(IDLE, 0.0))}"
    yield f"several={level(seen.acts.get(SEVERAL, 0.0))}|{many}"
    if many > 1:
        yield from (f"also={act}" for act in _SIDELONG if act in acts)


def act(goal: _Plain) -> str:
    """What kind of act a goal asks for, as it is learnt."""
    kind: str = goal["goal"]
    if kind == "for_each" and goal.get("goals"):
        return act(goal["goals"][-1])
    return act_of(goal)


def _likely(acts: list[str], goals: list[_Plain], told: dict[str, float]) -> float:
    """How likely a sentence asks for such acts [0..1]."""
    kinds = set(acts)
    somewhere = "place" in kinds or isinstance(goals[-1].get("to"), str)
    if kinds <= _HANDLING | {"go_to"} and kinds & {"bring", "place"}:
        kinds |= {"bring", "place"} if len(kinds) > 1 or somewhere else set()
    alike = len(kinds) == 1 or kinds <= _HANDLING
    several = told.get(SEVERAL, 0.0) if len(acts) > 1 else 0.0
    return min(1.0, several + (sum(told.get(kind, 0.0) for kind in kinds) if alike else 0.0))


def _of_roles(goals: list[_Plain], one: Reading, seen: Sight) -> Iterator[str]:
    """Whether each name stands in the goals as what it most likely is."""
    where: dict[str, set[str]] = {}
    for role, name in _named(goals, ()):
        where.setdefault(name.lower(), set()).add(role)
    worst = 1.0
    for mention, roles in zip(seen.mentions, seen.roles, strict=True):
        if not mention.names:
            continue
        if _is_passed(one, seen, mention.start):
            likely = roles.get(NOTHING, 0.0)
            yield f"passed={level(likely)}"
        else:
            found = set[str]().union(*(where.get(name.lower(), ()) for name in mention.names))
            likely = max(roles.get(role, 0.0) for role in found or {NOTHING})
            top = max(roles, key=lambda role: roles[role])
            yield f"role={'/'.join(sorted(found)) or NOTHING}>{top}"
        worst = min(worst, likely)
    yield f"worst={level(worst)}"
    yield f"worst={level(worst)}|{min(len(goals), 3)}"


def _named(value: object, path: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Every name in goals, with its role."""
    if isinstance(value, dict):
        for key, inner in cast("_Plain", value).items():
            yield from _named(inner, (*path, key))
    elif isinstance(value, list | tuple):
        for inner in cast("list[object]", value):
            yield from _named(inner, path)
    elif isinstance(value, str) and path:
        *above, key = path
        if key in ("name", "category"):
            role = _ROLE_OF.get(above[-1] if above else "")
        elif key == "at":
            role = "where" if "to" in above else "from"
        else:
            role = _ROLE.get(key)
        if role:
            yield role, value


def _of_background(one: Reading, seen: Sight) -> Iterator[str]:
    """What was passed over, and how likely that asks for nothing."""
    gone = [n for n, word in enumerate(seen.words)
            if not word.is_sign and _is_passed(one, seen, n)]  # fmt: skip
    if not gone:
        return
    words = {seen.words[n].raw.lower() for n in gone}
    names = sum(bool(m.names) and _is_passed(one, seen, m.start) for m in seen.mentions)
    yield f"gone={min(len(gone), 12) // 3}"
    yield f"least={level(float(min(seen.idle[n] for n in gone)))}"
    yield f"gone.names={min(names, 3)}"
    yield from (f"gone.{kind}" for kind, known in _KINDS if words & known)
    if any(word[0].isdigit() for word in words):
        yield "gone.figure"
    yield from (
        f"gone={word}"
        for word in sorted(words)
        if word in lexicon.FUNCTION_WORDS or word in lexicon.LISTED
    )
    for start, end in one.spans:
        span = [w.raw.lower() for w in seen.words if start <= w.start < end and not w.is_sign]
        if span:
            yield f"first={span[0]}"
            yield f"first={' '.join(span[:2])}"
            yield f"last={span[-1]}"
            yield f"length={min(len(span), 8)}"


def _of_kept(one: Reading, seen: Sight) -> Iterator[str]:
    """What was read, and how likely that is background all the same."""
    kept = [n for n, word in enumerate(seen.words)
            if not word.is_sign and not _is_passed(one, seen, n)]  # fmt: skip
    for word in sorted({seen.words[n].raw.lower() for n in kept}):
        if word in lexicon.FUNCTION_WORDS:
            yield f"kept={word}"
    if kept and one.source != "plain":
        idle = [float(seen.idle[n]) for n in kept]
        yield f"most={level(max(idle))}"
        yield f"mean={level(sum(idle) / len(idle))}"
        yield f"share={level(sum(p > 0.5 for p in idle) / len(idle))}"


def _is_passed(one: Reading, seen: Sight, at: int) -> bool:
    return any(start <= seen.words[at].start < end for start, end in one.spans)
