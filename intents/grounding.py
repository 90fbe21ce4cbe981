"""Descriptions to ids: which of the things in the world is meant.

What is there is given as plain :class:`Entity` values; this module knows no world model.
Ambiguous and Unknown are values, with a question or the nearest names.
"""

from collections.abc import Callable, Iterable, Sequence
from itertools import combinations

import msgspec
from msgspec.structs import replace
from rapidfuzz import fuzz, process

from intents import relations
from intents.english.trouble import listing
from intents.english.words.lexer import singular
from intents.goals import (
    Bring,
    Give,
    Goal,
    How,
    LookAt,
    ObjectQuery,
    Pick,
    Place,
    Relation,
    Superlative,
)  # fmt: skip
from intents.relations import Viewpoint


class Entity(msgspec.Struct, frozen=True, kw_only=True):
    """A thing in the world.

    Attributes:
        id: What the executive calls it.
        size_m: Extents in x, y, z [m].
        at: Place it is at, or empty. With neither place, room nor position it may be anywhere.
        of: Piece of furniture that the place is a part of ("shelf" of its boards), or empty.
        room: Room it is in, or empty.
        p_WO: Position in the world [m].
        held: It is in the robot's hand.
        hand: In which one ("left"), if that is known.
        holder: Name of the person whom it was given to and who has it still, or empty.
        came_from: Place that it was taken from last, or empty.
    """

    id: str
    name: str
    category: str = ""
    color: str = ""
    size_m: tuple[float, float, float] | None = None
    mass_kg: float | None = None
    at: str = ""
    of: str = ""
    room: str = ""
    p_WO: tuple[float, float, float] | None = None
    held: bool = False
    hand: str = ""
    holder: str = ""
    came_from: str = ""


class Grounded(msgspec.Struct, frozen=True):
    """Exactly one thing is meant (or, where several were asked for, exactly these)."""

    id: str
    ids: tuple[str, ...] = ()


class Ambiguous(msgspec.Struct, frozen=True):
    """Several things are meant; the question tells them apart.

    Attributes:
        candidates: Their ids.
        labels: What tells each from the others, in the same order.
    """

    candidates: tuple[str, ...]
    labels: tuple[str, ...]
    question: str


class Unknown(msgspec.Struct, frozen=True):
    """Nothing fits.

    Attributes:
        what: The description in words.
        nearest: Descriptions of things that come near.
    """

    what: str
    nearest: tuple[str, ...] = ()

    @property
    def reason(self) -> str:
        """The finding, for people."""
        hint = f"; there is {listing(self.nearest)}" if self.nearest else ""
        return f"there is no {self.what}{hint}"


Grounding = Grounded | Ambiguous | Unknown

_Measure = Callable[[Entity], float | None]


def _volume(e: Entity) -> float | None:
    return e.size_m[0] * e.size_m[1] * e.size_m[2] if e.size_m else None


_RANKS: dict[Superlative, tuple[_Measure, int]] = {
    "largest": (_volume, 1),
    "smallest": (_volume, -1),
    "heaviest": (lambda e: e.mass_kg, 1),
    "lightest": (lambda e: e.mass_kg, -1),
    "thickest": (lambda e: min(e.size_m) if e.size_m else None, 1),
    "thinnest": (lambda e: min(e.size_m) if e.size_m else None, -1),
    "tallest": (lambda e: e.size_m[2] if e.size_m else None, 1),
    "shortest": (lambda e: e.size_m[2] if e.size_m else None, -1),
    "highest": (lambda e: e.p_WO[2] if e.p_WO else None, 1),
    "lowest": (lambda e: e.p_WO[2] if e.p_WO else None, -1),
}
"""Superlatives that need no point of view; the others are given as ``ranks``."""


def ground(
    query: ObjectQuery,
    entities: Iterable[Entity],
    *,
    view: Viewpoint | None = None,
    ranks: dict[Superlative, _Measure] | None = None,
) -> Grounding:
    """Which entity a description means.

    Args:
        query: The description; a count asks for several.
        entities: What is known to be there.
        view: Where the robot stands, for what depends on it: leftmost, nearest, behind the
            bottle. Without it these tell nothing apart.
        ranks: Other ways to measure superlatives; the largest measure wins.
    """
    known = list(entities)
    fitting = _described(known, query) or _of_the_kind(known, query)
    if query.relation and fitting:
        every = _described(known, replace(query, count="all"))
        fitting = _related(fitting, query.relation, known, view) or _related(
            every, query.relation, known, view
        )
    if query.except_:
        left_out = _denied(fitting, query.except_, known, view)
        fitting = [e for e in fitting if e not in left_out]
    if not fitting:
        return Unknown(describe(query), _nearest(query, known))
    if query.superlative:
        fitting = _most(fitting, query.superlative, _views(view) | (ranks or {}))
    if query.size and len(fitting) > 1:
        fitting = _sized(fitting, query.size)
    if query.count == "all" or (query.count and len(fitting) >= query.count):
        chosen = fitting if query.count == "all" else _handiest(fitting, view)[: query.count]
        return Grounded(chosen[0].id, tuple(e.id for e in chosen))
    if len(fitting) == 1:
        return Grounded(fitting[0].id, (fitting[0].id,))
    return _ambiguous(query, fitting)


def _described(known: list[Entity], query: ObjectQuery) -> list[Entity]:
    """Those that are as described: of several, and where none is called so, those of that category.

    "All the cups" are the coffee cup too, although something else is just called cup; "the cup" is
    what is called so.
    """
    called = [e for e in known if _fits(e, query)]
    several = query.count not in (None, 1) or query.superlative is not None
    if query.name is None or query.category is not None or (called and not several):
        return called
    kind = replace(query, name=None, category=query.name)
    return [e for e in known if e in called or _fits(e, kind)]


def _of_the_kind(known: list[Entity], query: ObjectQuery) -> list[Entity]:
    """Those that fit but for the first words of their names: the strawberry jam as "the jam".

    What names end with is a category where nobody gave one: "count the jams".
    """
    kind = (query.name or query.category or "").lower()
    if not kind or any(_alike(kind, said) for e in known for said in (e.name, e.category)):
        return []
    named = [e for e in known if _alike(e.name.rpartition(" ")[2], kind)]
    return [e for e in named if _fits(e, replace(query, name=None, category=None))]


def by_where(query: ObjectQuery) -> bool:
    """Whether a description tells things apart by where they are."""
    placed = query.at is not None or query.relation is not None
    denied = query.except_ is not None and by_where(query.except_)
    return placed or denied or query.superlative in _BY_PLACE


_BY_PLACE = frozenset({"leftmost", "rightmost", "nearest", "farthest", "highest", "lowest"})


def _fits(entity: Entity, query: ObjectQuery) -> bool:
    """Whether an entity is as described, leaving aside comparisons with others."""
    unplaced = not (entity.at or entity.room or entity.holder or entity.p_WO)
    near = (
        query.at is None
        or unplaced
        or query.at in (entity.at, entity.of, entity.room)
        or entity.held
    )
    return (
        (query.name is None or _alike(entity.name, query.name) or entity.id == query.name)
        and (query.category is None or _alike(entity.category, query.category))
        and (query.color is None or entity.color == query.color)
        and near
        and (not query.held or entity.held or query.name is not None)
    )


def _denied(
    entities: list[Entity], query: ObjectQuery, known: list[Entity], view: Viewpoint | None
) -> list[Entity]:
    """Those that are surely as described: "not on the table" keeps what nobody has seen."""
    placed = query.at is not None or query.relation is not None
    sure = [e for e in entities if not placed or e.at or e.room or e.p_WO]
    found = [e for e in sure if _fits(e, query) and not (query.at and e.held)]
    if query.relation:
        found = _related(found, query.relation, known, view)
    if query.superlative and found:
        found = _most(found, query.superlative, _views(view))
    return _sized(found, query.size) if query.size and found else found


def _related(
    entities: list[Entity], relation: Relation, known: list[Entity], view: Viewpoint | None
) -> list[Entity]:
    """Those that stand so to the other thing; those of which it is not known may do so, too."""
    wanted = [replace(q, held=False) for q in (relation.of, relation.other) if q is not None]
    described = [e for q in wanted for e in _described(known, q)]
    others = [e for e in known if e in described]
    if relation.of.relation:
        others = _related(others, relation.of.relation, known, view)
    return [e for e in entities if _stands_so(e, relation, others, view)]


def _stands_so(
    entity: Entity, relation: Relation, others: list[Entity], view: Viewpoint | None
) -> bool:
    name = relation.of.name or ""
    if relation.how in ("on", "in", "near") and (
        _alike(entity.at, name) or _alike(entity.of, name)
    ):
        return True
    body = _body(entity)
    placed = [b for o in others if o.id != entity.id and (b := _body(o))]
    if body is None or not placed:
        return [o.id for o in others] != [entity.id]
    if relation.how == "between":
        pairs = combinations(placed, 2)
        return len(placed) < 2 or any(relations.between(body, pair) for pair in pairs)
    return any(relations.holds(relation.how, body, other, view) is not False for other in placed)


def _body(entity: Entity) -> relations.Body | None:
    if entity.p_WO is None:
        return None
    return relations.Body(entity.p_WO, entity.size_m or (0.0, 0.0, 0.0))


def _views(view: Viewpoint | None) -> dict[Superlative, _Measure]:
    """The superlatives that depend on where the robot stands."""

    def measured(superlative: Superlative, seen_from: Viewpoint) -> _Measure:
        return lambda e: relations.rank(superlative, e.p_WO, seen_from) if e.p_WO else None

    names: tuple[Superlative, ...] = ("leftmost", "rightmost", "nearest", "farthest")
    return {name: measured(name, view) for name in names} if view else {}


def _alike(one: str, other: str) -> bool:
    return singular(one.lower()) == singular(other.lower())


def _most(
    entities: list[Entity], superlative: Superlative, ranks: dict[Superlative, _Measure]
) -> list[Entity]:
    """Those that are most so; all of them if that cannot be measured."""
    measure, sign = (ranks[superlative], 1) if superlative in ranks else _RANKS.get(
        superlative, (lambda _: None, 1)
    )  # fmt: skip
    measured = [(sign * value, e) for e in entities if (value := measure(e)) is not None]
    if not measured:
        return entities
    best = max(value for value, _ in measured)
    return [e for value, e in measured if value == best]


def _sized(entities: list[Entity], size: str) -> list[Entity]:
    """Of several, the big one is the largest and the small one the smallest."""
    wanted: dict[str, Superlative] = {
        "big": "largest", "small": "smallest", "tall": "tallest", "heavy": "heaviest",
        "light": "lightest", "thin": "thinnest", "thick": "thickest", "short": "shortest",
    }  # fmt: skip
    return _most(entities, wanted[size], {}) if size in wanted else entities


def _handiest(entities: list[Entity], view: Viewpoint | None) -> list[Entity]:
    """Any will do: what is in the hand first, then what was seen, the nearest first."""

    def key(entity: Entity) -> tuple[bool, bool, float]:
        near_m = view.distance_m(entity.p_WO) if view and entity.p_WO else 0.0
        return (not entity.held, entity.p_WO is None, near_m)

    return sorted(entities, key=key)


def _ambiguous(query: ObjectQuery, entities: Sequence[Entity]) -> Ambiguous:
    """Tell them apart by the first of colour, name, place and size that does."""
    labels = _labels(entities)
    noun = query.name or query.category or "thing"
    question = f"Which {noun}, {listing(labels)}?"
    return Ambiguous(tuple(e.id for e in entities), tuple(labels), question)


def _labels(entities: Sequence[Entity]) -> list[str]:
    ways: tuple[Callable[[Entity], str], ...] = (
        lambda e: f"the {e.color} one" if e.color else "",
        lambda e: f"the {e.name}",
        lambda e: f"the one at the {e.at}" if e.at else "",
        lambda e: f"the {e.color} {e.name}" if e.color else "",
        lambda e: f"the {e.color} one at the {e.at}" if e.color and e.at else "",
        lambda e: f"the {e.color} {e.name} at the {e.at}" if e.color and e.at else "",
    )
    for way in ways:
        labels = [way(e) for e in entities]
        if all(labels) and len(set(labels)) == len(labels):
            return labels
    return [f"the {describe_entity(e)} ({e.id})" for e in entities]


HOW_WORDS: dict[How, str] = {
    "on": "on", "under": "under", "above": "above", "in": "in", "behind": "behind",
    "in_front": "in front of", "left": "left of", "right": "right of", "near": "next to",
    "between": "between",
}  # fmt: skip
"""How a relation is said."""


def narrowed(query: ObjectQuery, entity: Entity) -> ObjectQuery:
    """The description with what tells this entity from others."""
    return replace(
        query,
        name=entity.name,
        category=None,
        color=entity.color or query.color,
        at=entity.at or query.at,
    )


def describe(query: ObjectQuery) -> str:
    """A description in words: "red cup at the table"."""
    noun = query.name or query.category or "object"
    words = [query.superlative, query.size, query.color, noun]
    place = f" at the {query.at}" if query.at else ""
    if query.relation:
        ends = [q for q in (query.relation.of, query.relation.other) if q is not None]
        place += f" {HOW_WORDS[query.relation.how]} the {' and the '.join(map(describe, ends))}"
    if query.except_:
        other = describe(query.except_)
        bare = other.startswith("object ")  # told by where it is, and by nothing else
        place += f" that is not {other.removeprefix('object ') if bare else f'the {other}'}"
    return " ".join(w for w in words if w) + place


def describe_entity(entity: Entity) -> str:
    """An entity in words: "red cup"."""
    return " ".join(w for w in (entity.color, entity.name) if w)


def _nearest(query: ObjectQuery, entities: Sequence[Entity]) -> tuple[str, ...]:
    """Things of the same name elsewhere or of other colour, else the nearest names."""
    loose = replace(
        query, color=None, at=None, size=None, superlative=None, relation=None, held=False
    )
    same = [e for e in entities if _fits(e, loose)] if query.name or query.category else []
    if same:
        return tuple(dict.fromkeys(
            f"a {describe_entity(e)}" + (f" at the {e.at}" if e.at else "") for e in same
        ))[:3]  # fmt: skip
    wanted = query.name or query.category or ""
    names = sorted({describe_entity(e) for e in entities})
    found = process.extract(wanted, names, scorer=fuzz.WRatio, limit=3)
    return tuple(f"a {name}" for name, _, _ in found)


def queries(goals: Iterable[Goal]) -> list[ObjectQuery]:
    """The objects that goals want to get hold of, in order, each as it is first described."""
    found: list[ObjectQuery] = []
    for goal in goals:
        if not isinstance(goal, Pick | Bring | Place | Give | LookAt):
            continue
        query = goal.object
        moved = (replace(one, at=None) for one in found)  # what is moved is not there any more
        if query is not None and not query.held and query not in (*found, *moved):
            found.append(query)
    return found
