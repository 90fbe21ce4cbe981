"""What the words of a goal mean here: descriptions to ids, before anything moves.

The scene also follows what the goals so far will have put into the hands, so that "it" has a
meaning, and no third thing is taken with two hands.
"""

from __future__ import annotations

from msgspec.structs import replace

from executive.meaning.knowledge import Knowledge
from intents import goals
from intents.english.trouble import listing
from intents.grounding import (
    Ambiguous,
    Entity,
    Grounded,
    Grounding,
    Unknown,
    by_where,
    describe,
    describe_entity,
    ground,
)
from intents.relations import Viewpoint
from robot.failures import Failure, failure
from robot.files.config import nearest
from robot.messages import ObjectInfo, PersonInfo, Place

HANDS = 2


class CannotMean(Exception):
    """A goal has no meaning here; carries the failure. Never leaves the planning of a task."""

    def __init__(self, reason: Failure) -> None:
        """Carry the failure."""
        self.failure = reason
        super().__init__(reason.cause)


class Unsettled(CannotMean):
    """Which things a description means has to be seen: where they are is part of it."""

    def __init__(self, query: goals.ObjectQuery, reason: Failure) -> None:
        """Carry the description; `reason` holds where nobody can go and look."""
        super().__init__(reason)
        self.query = query


def cannot(code: str, cause: str, *, suggestion: str = "", **evidence: float | str) -> CannotMean:
    """The exception to raise for a failure of the catalogue."""
    return CannotMean(failure(code, cause, suggestion=suggestion, **evidence))


class Scene:
    """The meaning of names in one world, in the course of one sequence of goals."""

    def __init__(
        self,
        knowledge: Knowledge,
        *,
        held: tuple[str, ...] = (),
        entities: tuple[Entity, ...] = (),
        view: Viewpoint | None = None,
        moves: bool = False,
    ) -> None:
        """Begin with what is held now.

        Args:
            knowledge: of the world.
            held: ids of what is in the hands.
            entities: every object with where it is believed to be (default: it is not known).
            view: where the robot stands, for "the leftmost"; None if that is not known.
            moves: whether things may be elsewhere by the time the goals are done.
        """
        self.knowledge = knowledge
        self._entities = list(entities or knowledge.entities())
        self._view = view
        self._settled: dict[goals.ObjectQuery, tuple[str, ...]] = {}
        self._moves = moves
        self.held: list[str] = list(held)
        self.spoken_of: str | None = held[-1] if held else None

    def knowing(self, query: goals.ObjectQuery, ids: tuple[str, ...]) -> Scene:
        """The same scene, where it is settled which things a description means."""
        scene = Scene(
            self.knowledge, held=tuple(self.held), entities=tuple(self._entities),
            view=self._view, moves=self._moves,
        )  # fmt: skip
        gone = replace(query, at=None)  # as it is spoken of once it was taken from there
        scene._settled = {**self._settled, _bare(query): ids, _bare(gone): ids}
        scene.spoken_of = ids[0]
        return scene

    def is_settled(self, query: goals.ObjectQuery) -> bool:
        """Whether it was looked which things a description means."""
        return _bare(query) in self._settled

    def follow(self, other: Scene) -> None:
        """Go on from what another one has come to."""
        self.held, self.spoken_of = list(other.held), other.spoken_of
        self._moves = self._moves or other._moves

    @property
    def room(self) -> str:
        """The name of the room that the robot is in; empty if that is not known."""
        view = self._view
        return "" if view is None else self.knowledge.room_at((view.x_m, view.y_m, 0.0))

    # --- objects ---

    def object(self, query: goals.ObjectQuery) -> ObjectInfo:
        """The one object that is meant.

        Raises:
            Unsettled: which one has to be seen.
            CannotMean: none fits, or several do.
        """
        found = self._referent(query) or self._all(query)[0]
        self.spoken_of = found.id
        return found

    def objects(self, query: goals.ObjectQuery) -> list[ObjectInfo]:
        """Every object that is meant: of "all cups", of "two cups".

        Raises:
            Unsettled: which ones has to be seen.
            CannotMean: none fits, or fewer than asked for.
        """
        found = self._all(replace(query, count=query.count or "all"))
        if isinstance(query.count, int) and query.count != len(found):
            there = f"is only {len(found)}" if len(found) == 1 else f"are {len(found)}"
            text = f"there {there} of them, not {query.count}"
            raise cannot("unknown_object", text)
        return found

    def fitting(self, query: goals.ObjectQuery) -> list[ObjectInfo]:
        """Every object that a description may mean; there may be none."""
        one = self.knowledge.object(query.name or "") if query.count is None else None
        try:
            return [one] if one else self._all(replace(_anywhere(query), held=query.held))
        except CannotMean:
            return []

    def believed_at(self, info: ObjectInfo) -> str:
        """The name of the surface that a thing is believed to be on; empty if on none."""
        return self._entity(info).at

    def holder_of(self, info: ObjectInfo) -> str:
        """Who has a thing, as far as is known and nothing is done before; empty: nobody."""
        return "" if self._moves else self._entity(info).holder

    def _entity(self, info: ObjectInfo) -> Entity:
        """What is believed of a thing; of one that nothing is believed of, what it is."""
        found = (entity for entity in self._entities if entity.id == info.id)
        return next(found, self.knowledge.entity(info))

    def take(self, object_id: str) -> None:
        """The goals so far have put this object into a hand.

        Raises:
            CannotMean: both hands are full by then.
        """
        if object_id in self.held:
            return
        self._moves = True
        if len(self.held) >= HANDS:
            infos = [self.knowledge.object(held) for held in self.held]
            names = " and ".join(info.full_name for info in infos if info is not None)
            raise cannot("hands_full", f"both hands are full by then, with {names}")
        self.held.append(object_id)

    def put_down(self, object_id: str) -> None:
        """The goals so far have put it down."""
        self._moves = True
        if object_id in self.held:
            self.held.remove(object_id)

    def _referent(self, query: goals.ObjectQuery) -> ObjectInfo | None:
        """What "it" is; None if the query describes an object of its own."""
        if not query.held:
            return None
        candidates = [*reversed(self.held), *([self.spoken_of] if self.spoken_of else [])]
        for object_id in candidates:
            info = self.knowledge.object(object_id)
            described = replace(query, held=False, at=None, count=None)
            if info is not None and not isinstance(
                ground(described, [self.knowledge.entity(info)]), Unknown
            ):
                return info
        if query.name or query.category:
            return None
        raise cannot("not_holding", "nothing is held, and nothing was spoken of before")

    def _all(self, query: goals.ObjectQuery) -> list[ObjectInfo]:
        """The objects that a description means; where only one can be, wherever it is."""
        by_id = {info.id: info for info in self.knowledge.map.objects}
        if query.name in by_id and query.count in (None, 1):  # "all the candles" are not this one
            return [by_id[query.name]]
        settled = self._settled.get(_bare(query)) or self._settled_and_held(query)
        if settled is not None:
            return [by_id[object_id] for object_id in settled]
        entities = self._entities
        found = ground(replace(query, at=None, held=False), entities, view=self._view)
        if by_where(query):
            found = self._by_where(query, found)
        if isinstance(found, Unknown):
            said, names = describe(query), sorted({e.name for e in entities})
            hint = f"there is {', '.join(found.nearest)}" if found.nearest else nearest(said, names)
            raise cannot("unknown_object", f"there is no {said} in this world", suggestion=hint)
        if isinstance(found, Ambiguous):
            text = f"{describe(query)!r} fits {len(found.candidates)} things"
            raise cannot("ambiguous", text, suggestion=found.question)
        return [by_id[object_id] for object_id in found.ids]

    def _settled_and_held(self, query: goals.ObjectQuery) -> tuple[str, ...] | None:
        """What a hand has by then, of the same description but for where it is.

        "Take the mug beside the clock and put it in the kitchen on the worktop" says where it goes.
        """
        ids = self._settled.get(_bare(replace(query, at=None)))
        return ids if ids and set(ids) <= set(self.held) else None

    def _by_where(self, query: goals.ObjectQuery, found: Grounding) -> Grounding:
        """Which of those that look as described stand where the description says.

        Raises:
            Unsettled: it is not known of all of them where they are, or nothing is believed to be
                there, or something is moved before it is asked.
        """
        alike = ground(_anywhere(query), self._entities)
        if not isinstance(alike, Grounded):
            return found
        if len(alike.ids) == 1 and query.count in (None, 1):
            return alike
        known = {entity.id: entity for entity in self._entities}
        fitting = [known[object_id] for object_id in alike.ids]
        known_now = all(entity.p_WO or entity.held or entity.holder for entity in fitting)
        many = query.count not in (None, 1)
        if known_now and not (query.at and many and self._moves):
            there = ground(replace(query, held=False), self._entities, view=self._view)
            if not (query.at and isinstance(there, Unknown)):
                return there
        text = f"{describe(query)!r} fits {len(fitting)} things as long as nobody looks"
        question = f"Which one, {listing([f'the {describe_entity(e)}' for e in fitting])}?"
        raise Unsettled(query, failure("ambiguous", text, suggestion=question))

    # --- places and people ---

    def places(self, name: str) -> tuple[Place, ...]:
        """Every place that a name can mean; there is at least one.

        Raises:
            CannotMean: there is none.
        """
        found = self.knowledge.places(name)
        if not found:
            names = sorted({place.name for place in self.knowledge.map.places})
            text = f"there is no place called {name!r} in this world"
            raise cannot("unknown_place", text, suggestion=nearest(name, names))
        return found

    def person(self, person: goals.Person) -> PersonInfo:
        """The person that is meant.

        Raises:
            CannotMean: nobody here is known by that name or description.
        """
        named = person.name is not None or person.who is not None
        found = self.knowledge.person(person.name) if named else None
        if found is not None:
            return found
        who = "you are" if person.who else f"{person.name or 'a person of that description'} is"
        names = ", ".join(known.name for known in self.knowledge.map.people)
        hint = f"people in this world: {names}" if names else "nobody is in this world"
        raise cannot("unknown_place", f"the robot does not know where {who}", suggestion=hint)


def _anywhere(query: goals.ObjectQuery) -> goals.ObjectQuery:
    """All that look as described, wherever they are."""
    other = query.except_
    return replace(
        query, count="all", at=None, relation=None, superlative=None, held=False,
        except_=None if other is not None and by_where(other) else other,
    )  # fmt: skip


def _bare(query: goals.ObjectQuery) -> goals.ObjectQuery:
    """What a description says of a thing, without how many are meant."""
    return replace(query, count=None, held=False)
