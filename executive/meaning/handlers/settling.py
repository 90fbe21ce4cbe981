"""Descriptions that only looking settles: "the mug behind the wine bottle", "a box on the desk".

Where to look, and what is meant once that was looked at. The looks go where the landmark is, or to
the places that were named; what was not seen by then is not meant.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from msgspec.structs import replace

from executive.blackboard import HELD, WORLD, Blackboard
from executive.meaning.handlers.steps import about, search, to_look_over, tolerant, visit
from executive.meaning.identify import CannotMean, Scene
from executive.meaning.knowledge import Knowledge
from executive.meaning.robot_state import state_of
from executive.meaning.viewpoint import facing
from executive.skills.inspect import InspectParams
from executive.skills.look import LookParams
from executive.skills.motions.look_closer import unclear, unclear_words
from executive.skills.motions.support import stands_on
from executive.skills.navigate import NavigateParams
from executive.trees.parts import Branch, Errand, GiveUp, Part, Series, Settle
from intents import goals, relations
from intents.english.trouble import listing
from intents.grounding import (
    Ambiguous,
    Entity,
    Grounded,
    Unknown,
    describe,
    describe_entity,
    ground,
)
from intents.relations import Viewpoint
from robot.failures import Failure, failure
from robot.messages import ObjectInfo, Place, Unnamed
from robot.se3 import SE3

BESIDE_M = 1.2
"""Things beside a piece of furniture, or at a spot of the floor, stand on what is that near."""
MOST_AWAY = 3
"""So many things that are elsewhere than was said are named."""
CLEARLY_NEARER = 0.7
"""Of two things behind the bottle the one is meant that is nearer to it by so much."""

Continue = Callable[[Scene], tuple[Part, ...]]
"""What is done in a scene in which the description is settled."""


def settle(query: goals.ObjectQuery, scene: Scene, rest: Continue) -> Settle:
    """Look, settle which things are meant, then do the rest with them.

    Args:
        query: the description.
        scene: as it is before; it goes on as it will probably be after the rest.
        rest: what is done then.

    Raises:
        CannotMean: the description has no meaning here, or the rest has none.
    """
    alike = [info.id for info in scene.fitting(query)]
    likely_ids = tuple(alike[: 1 if query.count in (None, "all") else query.count])
    begin = scene.knowing(query, likely_ids)
    after = scene.knowing(query, likely_ids)
    likely = Series(name=describe(query), parts=rest(after))
    scene.follow(after)

    def then(ids: tuple[str, ...]) -> Part:
        try:
            parts = rest(begin.knowing(query, ids))
            if query.count == "all" and query.at:
                parts = (*parts, question.nothing_else())
            return Series(name=describe(query), parts=parts)
        except CannotMean as end:
            name = f"do it with the {describe(query)}"
            return GiveUp(name=name, cause=end.failure.cause, code=end.failure.code)

    question = _Question(query, frozenset(alike), scene)
    alone = query.count in (None, 1) and query.relation is None and query.superlative is None
    return Settle(
        name=f"which {describe(query)}",
        looks=tuple(_looks(query, scene)),
        question=question,
        then=then,
        likely=likely,
        thorough=not alone,
    )


def from_there(info: ObjectInfo, query: goals.ObjectQuery, scene: Scene, take: Part) -> Settle:
    """Take a thing from where it was said to be, and from nowhere else.

    If it is believed elsewhere, the place that was said is looked over first.

    Raises:
        CannotMean: there is no such place.
    """
    places = places_at(query.at or "", scene)
    at = scene.believed_at(info)
    elsewhere = at and at not in {place.name for place in places}
    named = to_look_over(scene.places(query.at or ""), scene) if elsewhere else ()
    only_there = replace(query, relation=None, superlative=None)
    there = _Question(only_there, frozenset({info.id}), scene)
    return Settle(
        name=f"is {info.full_name} {_on(query.at or '', scene.knowledge)}",
        looks=tuple(tolerant(visit(place)) for place in named),
        question=lambda board: (info.id,) if _is_held(info.id, board) else there(board),
        then=lambda _: take,
        likely=take,
    )


def _is_held(object_id: str, board: Blackboard) -> bool:
    """Whether a thing is in a hand."""
    return object_id in board.read(HELD).values()


def counted(
    query: goals.ObjectQuery, scene: Scene
) -> tuple[tuple[Part, ...], Callable[[Blackboard], int]]:
    """Where to look for all that a description means, and how many were seen by then.

    Raises:
        CannotMean: the description has no meaning here.
    """
    every = replace(query, count="all")
    question = _Question(every, frozenset(info.id for info in scene.fitting(query)), scene)

    def number_of(board: Blackboard) -> int:
        found = question(board)
        return 0 if isinstance(found, Failure) else len(found)

    return tuple(_looks(every, scene)), number_of


def where_words(query: goals.ObjectQuery) -> str:
    """Where a description says that things are: "on the desk", "next to the oil bottle"."""
    bare = goals.ObjectQuery(name="thing", at=query.at, relation=query.relation)
    return describe(bare).removeprefix("thing ").replace("at the", "on the", 1)


def nothing_there(query: goals.ObjectQuery, knowledge: Knowledge) -> str:
    """That a place was looked at in vain: "there is nothing on the table but the blue cup"."""
    bare = replace(query, at=None, count=None, except_=None, held=False)
    what = "nothing" if bare == goals.ObjectQuery() else f"no {describe(bare)}"
    but = f" but the {describe(query.except_)}" if query.except_ is not None else ""
    return f"there is {what} {_on(query.at or '', knowledge)}{but}"


def _on(name: str, knowledge: Knowledge) -> str:
    """*On the table*, *in the kitchen*."""
    return f"{'in' if all(place.floor for place in knowledge.places(name)) else 'on'} the {name}"


# --- where to look ------------------------------------------------------------------------------


def _looks(query: goals.ObjectQuery, scene: Scene) -> list[Part]:
    """Looks in their order: at the places named, else at the landmarks, else around.

    Who looks over the table sees what the candle there stands between; a goblet that is elsewhere
    in the house is not looked for.
    """
    looks: list[Part] = []
    if query.at is not None:
        named = to_look_over(places_at(query.at, scene), scene)
        alike = [info.id for info in scene.fitting(query)]
        looks += [tolerant(visit(place, about=alike)) for place in named]
    if query.relation is not None and not looks:
        ends = (query.relation.of, query.relation.other)
        for end in (end for end in ends if end is not None):
            looks += _landmark(end, scene)
    return looks or [Errand(name="look around", params=LookParams(around=True))]


def places_at(name: str, scene: Scene, *, near: bool = True) -> list[Place]:
    """The surfaces that are meant by a place: its own, those of a room, those near a spot.

    A piece of furniture with boards is all of them. Without `near` a spot of the floor has none.

    Raises:
        CannotMean: there is no such place.
    """
    found: list[Place] = []
    every = [place for place in scene.knowledge.map.places if not place.floor]
    for place in scene.places(name):
        if not place.floor:
            boards = [other for other in every if other.of == place.of and place.id == place.of]
            found += [place, *boards]
        elif place.id == place.room:
            found += [other for other in every if other.room == place.room]
        elif near:
            found += _near(place, every)
    return list(dict.fromkeys(found))


def _near(place: Place, every: Sequence[Place]) -> list[Place]:
    away = {other.id: relations.apart_m(place.X_WP.p, other.X_WP.p) for other in every}
    near = [other for other in every if away[other.id] <= BESIDE_M]
    return sorted(near, key=lambda other: away[other.id])


def _landmark(query: goals.ObjectQuery, scene: Scene) -> list[Part]:
    """Find the landmark and stand before it; of several that it may be, one after the other."""
    found = scene.fitting(query)
    if found:
        looks = [_go_and_look(info, query, scene) for info in found]
        return [*looks] if len(looks) == 1 else [tolerant(look) for look in looks]
    places = scene.knowledge.places(query.name or "")
    if not places:
        scene.object(query)  # says that there is no such thing
    every = [place for place in scene.knowledge.map.places if not place.floor]
    around = [other for place in places for other in _near(place, every)]
    return [tolerant(visit(place)) for place in dict.fromkeys(around)]


def _go_and_look(info: ObjectInfo, query: goals.ObjectQuery, scene: Scene) -> Series:
    def there(board: Blackboard) -> NavigateParams | Failure:
        place = surface_of(info.id, board, scene.knowledge)
        if place is None:
            return failure("object_not_seen", f"{info.full_name} stands on nothing known")
        return NavigateParams(place_id=place.id)

    name = info.full_name
    parts = (
        search(info, query, scene),
        about(info, f"go to {name}", there),
        about(info, f"look at {name}", LookParams(object_id=info.id)),
    )
    return Series(name=f"look what is near {name}", parts=parts)


def surface_of(object_id: str, board: Blackboard, knowledge: Knowledge) -> Place | None:
    """The surface that a thing is believed to stand on."""
    X_WO = pose_of(object_id, board)
    return knowledge.surface_under(X_WO) if X_WO is not None else None


def pose_of(object_id: str, board: Blackboard) -> SE3 | None:
    """Where a thing is believed to be; None if that is not known."""
    world = board.read(WORLD)
    tracks = world.tracks if world is not None else ()
    return next((t.X_WO for t in tracks if t.id == object_id and not t.missing), None)


# --- what is meant ------------------------------------------------------------------------------


class _Question:
    """Which things a description means, as far as the world was seen."""

    def __init__(self, query: goals.ObjectQuery, alike: frozenset[str], scene: Scene) -> None:
        self._query, self._alike, self._knowledge = query, alike, scene.knowledge
        self._places = tuple(scene.places(query.at)) if query.at else ()
        self._surfaces = tuple(places_at(query.at, scene)) if query.at else ()

    def __call__(self, board: Blackboard) -> tuple[str, ...] | Failure:
        state = state_of(board, self._knowledge)
        seen = [entity for entity in state.entities if entity.p_WO is not None]
        here = [e for e in seen if e.id not in self._alike or self._is_there(e)]
        query = replace(self._query, at=None, held=False)
        view = self._view(board, state.view)
        found = ground(query, [*here, *self._furniture()], view=view)
        if isinstance(found, Ambiguous):
            found = self._nearest(found, here) or found
        if isinstance(found, Unknown):
            return self._not_seen(seen, board)
        if isinstance(found, Ambiguous):
            many = isinstance(query.count, int) and query.count > len(found.candidates)
            if many:
                text = f"saw only {len(found.candidates)} of {query.count}: {describe(query)}"
                return failure("object_not_seen", text)
            text = f"{describe(self._query)!r} fits {len(found.candidates)} things that are there"
            return failure("ambiguous", text, suggestion=found.question)
        if isinstance(query.count, int) and query.count > len(found.ids):
            return failure("object_not_seen", f"saw only {len(found.ids)} of {query.count}")
        return found.ids

    def nothing_else(self) -> Branch:
        """See to it that nothing is left there that may be meant and has no name."""
        where = _on(self._query.at or "", self._knowledge)
        look = InspectParams(
            place_ids=tuple(place.id for place in self._surfaces),
            about_ids=tuple(sorted(self._alike)),
            least=len(self._alike),
        )
        return Branch(
            name=f"is anything left {where} without a name",
            question=lambda board: bool(self._unclear(board)),
            then=Errand(name=f"look what is left {where}", params=look),
            otherwise=Series(name="go on", parts=()),
        )

    def _unclear(self, board: Blackboard) -> tuple[Unnamed, ...]:
        """What may be meant, and has no name."""
        world = board.read(WORLD)
        places = self._surfaces if self._query.at else ()
        return () if world is None else unclear(world, self._alike, places)

    def _is_there(self, entity: Entity) -> bool:
        """Whether it stands where the description says."""
        assert entity.p_WO is not None
        X_WO = SE3(entity.p_WO)
        if entity.holder:
            return False
        rooms = {place.name for place in self._places if place.id == place.room}
        on = any(stands_on(X_WO, place) for place in self._surfaces)
        return not self._places or on or entity.room in rooms

    def _is_away(self, entity: Entity) -> bool:
        """Whether it is such a thing, known to be elsewhere."""
        known = entity.at or entity.room or entity.holder
        return entity.id in self._alike and bool(known) and not self._is_there(entity)

    def _on(self, entity: Entity) -> str:
        if entity.holder:
            return f"with {entity.holder}"
        return _on(entity.at or entity.room, self._knowledge)

    def _furniture(self) -> list[Entity]:
        """The furniture that a description goes by, as things."""
        relation = self._query.relation
        ends = (relation.of, relation.other) if relation is not None else ()
        names = [end.name for end in ends if end is not None and end.name]
        places = [place for name in names for place in self._knowledge.places(name)]
        return [
            Entity(id=p.id, name=name, p_WO=p.X_WP.p, size_m=(*p.size_m, 2.0 * p.X_WP.p[2]))
            for name in names for p in places
        ]  # fmt: skip

    def _landmark(self, board: Blackboard) -> tuple[SE3, Place] | None:
        relation = self._query.relation
        if relation is None:
            return None
        of = replace(relation.of, at=None)
        for info in self._knowledge.map.objects:
            fits = ground(of, [self._knowledge.entity(info)])
            X_WO = pose_of(info.id, board)
            place = self._knowledge.surface_under(X_WO) if X_WO is not None else None
            if isinstance(fits, Grounded) and X_WO is not None and place is not None:
                return X_WO, place
        return None

    def _view(self, board: Blackboard, view: Viewpoint | None) -> Viewpoint | None:
        """As from before the surface that the landmark stands on."""
        landmark = self._landmark(board)
        if landmark is None or view is None:
            return view
        X_WO, place = landmark
        return facing(place, X_WO.p, view)

    def _nearest(self, found: Ambiguous, here: Sequence[Entity]) -> Grounded | None:
        """Of several that stand so, the one on the landmark's surface that is nearest to it."""
        relation, query = self._query.relation, self._query
        if relation is None or relation.how == "between" or query.count not in (None, 1):
            return None
        marks = [e for e in here if isinstance(ground(relation.of, [e]), Grounded)]
        if len(marks) != 1 or marks[0].p_WO is None:
            return None
        mark, p_WM = marks[0], marks[0].p_WO
        fitting = [e for e in here if e.id in found.candidates and e.p_WO is not None]
        beside = [e for e in fitting if e.at == mark.at] or fitting
        away = sorted((relations.apart_m(e.p_WO or p_WM, p_WM), e.id) for e in beside)
        clear = len(away) == 1 or away[0][0] < CLEARLY_NEARER * away[1][0]
        return Grounded(away[0][1], (away[0][1],)) if clear else None

    def _not_seen(self, seen: Sequence[Entity], board: Blackboard) -> Failure:
        things = self._unclear(board)
        if things:
            words = unclear_words(things, self._knowledge.map)
            what = f"is {describe(replace(self._query, at=None))}" if self._query.name else "is"
            which = "whether" if self._query.name else "what"
            return failure("not_made_out", f"cannot tell {which} {words} {what}")
        if self._query.at and not (self._query.relation or self._query.superlative):
            text = nothing_there(self._query, self._knowledge)
            away = [one for one in seen if self._is_away(one)]
            a_kind = self._query.name or self._query.category  # else all there is would be named
            if not (away and (a_kind or len(self._alike) == 1)):
                return failure("object_not_seen", text)
            named = [f"the {describe_entity(one)} is {self._on(one)}" for one in away]
            text += f"; {listing(named[:MOST_AWAY], 'and')}"
            without = f"say it without “{_on(self._query.at, self._knowledge)}”"
            cure = without if len(self._alike) == 1 else "say which one, and where it is"
            return failure("object_not_seen", text, suggestion=cure)
        alike = [e for e in seen if e.id in self._alike]
        others = [f"the {describe_entity(e)}" + (f" at the {e.at}" if e.at else "") for e in alike]
        hint = f"; saw {', '.join(others)}" if others else ""
        return failure("object_not_seen", f"looked, and saw no {describe(self._query)}{hint}")
