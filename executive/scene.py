"""What the words of a goal mean here: descriptions to ids, before anything moves.

The scene also follows what the goals so far will have put into the hands, so that "it" has a
meaning, and two things are not taken with one hand.
"""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from executive.knowledge import Knowledge, full_name, plain_name, volume
from intents import goals
from robot.config import nearest
from robot.errors import Failure, failure
from robot.messages import ObjectInfo, PersonInfo, Place

HANDS = 2


class Choice(msgspec.Struct, frozen=True, kw_only=True):
    """A question to a person: which of these is meant."""

    question: str
    options: tuple[tuple[str, str], ...]
    """Id and words of each."""

    def answer(self, text: str) -> str | None:
        """The id of the one option that an answer fits, None if it fits none or several."""
        words = set(text.casefold().replace(",", " ").split()) - {"the", "one", "please"}
        fits = [key for key, name in self.options if words and words <= set(name.split())]
        exact = [key for key, _ in self.options if text.strip().casefold() == key.casefold()]
        found = exact or fits
        return found[0] if len(found) == 1 else None


Ask = Callable[[Choice], str | None]
"""Puts a question to a person; the id chosen, None if there is no answer."""


class CannotMean(Exception):
    """A goal has no meaning here; carries the failure. Never leaves the planning of a task."""

    def __init__(self, reason: Failure) -> None:
        """Carry the failure."""
        self.failure = reason
        super().__init__(reason.cause)


def cannot(code: str, cause: str, *, suggestion: str = "", **evidence: float | str) -> CannotMean:
    """The exception to raise for a failure of the catalogue."""
    return CannotMean(failure(code, cause, suggestion=suggestion, **evidence))


class Scene:
    """The meaning of names in one world, in the course of one sequence of goals."""

    def __init__(
        self, knowledge: Knowledge, *, held: tuple[str, ...] = (), ask: Ask | None = None
    ) -> None:
        """Begin with what is held now; without `ask` an open question is a failure."""
        self.knowledge = knowledge
        self.held: list[str] = list(held)
        self.spoken_of: str | None = held[-1] if held else None
        self._ask = ask
        self._answers: dict[goals.ObjectQuery, str] = {}

    # --- objects ---

    def object(self, query: goals.ObjectQuery) -> ObjectInfo:
        """The one object that is meant."""
        found = self._referent(query) or self._chosen(query)
        self.spoken_of = found.id
        return found

    def objects(self, query: goals.ObjectQuery) -> list[ObjectInfo]:
        """Every object that is meant: of "all cups", of "two cups"."""
        fits = self.fitting(query)
        if not fits:
            raise self._unknown_object(query)
        count = query.count
        if count is None or count == "all":
            return fits
        if not 1 <= count <= len(fits):
            text = f"there are {len(fits)} such objects, not {count}"
            raise cannot("unknown_object", text)
        return fits[:count]

    def fitting(self, query: goals.ObjectQuery) -> list[ObjectInfo]:
        """The objects that a description fits, whatever place it says they are at.

        A size is looked at where sizes differ.
        """
        fits = [info for info in self.knowledge.map.objects if _fits(info, query)]
        of_size = [info for info in fits if self.knowledge.size_word(info) == query.size]
        fits = of_size or fits
        if query.superlative is None or len(fits) < 2:
            return fits
        measure = _MEASURES.get(query.superlative)
        if measure is None:
            text = f"which one is {query.superlative} cannot be told before looking"
            raise cannot("unsupported", text, suggestion="say its colour or name")
        return [max(fits, key=measure)]

    def take(self, object_id: str) -> None:
        """The goals so far have put this object into a hand."""
        if object_id in self.held:
            return
        if len(self.held) >= HANDS:
            names = " and ".join(self.name_of(held) for held in self.held)
            raise cannot("hands_full", f"both hands are full by then, with {names}")
        self.held.append(object_id)

    def put_down(self, object_id: str) -> None:
        """The goals so far have put it down."""
        if object_id in self.held:
            self.held.remove(object_id)

    def name_of(self, object_id: str) -> str:
        """What an object is called on screen."""
        info = self.knowledge.object(object_id)
        return full_name(info) if info else object_id

    def _referent(self, query: goals.ObjectQuery) -> ObjectInfo | None:
        """What "it" is; None if the query describes an object of its own."""
        if not query.held:
            return None
        candidates = [*reversed(self.held), *([self.spoken_of] if self.spoken_of else [])]
        for object_id in candidates:
            info = self.knowledge.object(object_id)
            if info is not None and _fits(info, query):
                return info
        if query.name or query.category or query.color:
            return None
        raise cannot("not_holding", "nothing is held, and nothing was spoken of before")

    def _chosen(self, query: goals.ObjectQuery) -> ObjectInfo:
        fits = self.fitting(query)
        if not fits:
            raise self._unknown_object(query)
        if len(fits) == 1:
            return fits[0]
        if query not in self._answers:
            self._answers[query] = self._which(fits)
        return next(info for info in fits if info.id == self._answers[query])

    def _which(self, fits: list[ObjectInfo]) -> str:
        """Ask which of several is meant."""
        choice = choice_of(fits)
        answer = self._ask(choice) if self._ask else None
        if answer is None:
            names = ", ".join(full_name(info) for info in fits)
            raise cannot("ambiguous", f"that may be {names}", suggestion=choice.question)
        return answer

    def _unknown_object(self, query: goals.ObjectQuery) -> CannotMean:
        said = describe(query)
        known = self.knowledge.map.objects
        names = sorted({full_name(info).removeprefix("the ") for info in known})
        suggestion = nearest(said, names) if names else "there is nothing to handle in this world"
        return cannot("unknown_object", f"there is no {said} in this world", suggestion=suggestion)

    # --- places and people ---

    def places(self, name: str) -> tuple[Place, ...]:
        """Every place that a name can mean (a shelf has several boards)."""
        found = self.knowledge.places(name)
        if not found:
            names = sorted({place.name for place in self.knowledge.map.places})
            text = f"there is no place called {name!r} in this world"
            raise cannot("unknown_place", text, suggestion=nearest(name, names))
        return found

    def person(self, person: goals.Person) -> PersonInfo:
        """The person that is meant."""
        found = self.knowledge.person(None if person.who == "operator" else person.name)
        if found is None or (person.name is None and person.who is None):
            who = person.name or person.who or "a person of that description"
            names = [known.name for known in self.knowledge.map.people]
            raise cannot(
                "unknown_place",
                f"the robot does not know where {who} is",
                suggestion=f"people in this world: {', '.join(names)}" if names else
                "nobody is in this world; name a place instead",
            )  # fmt: skip
        return found


def describe(query: goals.ObjectQuery) -> str:
    """A description in words: "big red cup"."""
    noun = query.name or query.category or "object"
    return " ".join(word for word in (query.superlative, query.size, query.color, noun) if word)


def choice_of(fits: list[ObjectInfo]) -> Choice:
    """The question which of some objects is meant: by colour where that tells them apart."""
    colors = [info.color for info in fits]
    by_color = len(set(colors)) == len(colors) and all(colors)
    short = colors if by_color else [full_name(info).removeprefix("the ") for info in fits]
    if not by_color and len(set(short)) < len(short):
        short = [info.id for info in fits]
    listed = ", ".join(f"the {name}" for name in short[:-1]) + f" or the {short[-1]}"
    words = [f"{info.color} {plain_name(info)} {info.id}".casefold() for info in fits]
    options = tuple((info.id, word) for info, word in zip(fits, words, strict=True))
    return Choice(question=f"which one, {listed}?", options=options)


def _fits(info: ObjectInfo, query: goals.ObjectQuery) -> bool:
    """Whether a description fits an object; size words and places are not looked at."""
    names = {name.casefold() for name in (info.name, plain_name(info), info.id, *info.synonyms)}
    if query.name is not None and query.name.casefold() not in names:
        return False
    if query.category is not None and query.category.casefold() != info.category.casefold():
        return False
    return query.color is None or query.color.casefold() == info.color.casefold()


def _height_m(info: ObjectInfo) -> float:
    return info.shape.size_m[2]


def _width_m(info: ObjectInfo) -> float:
    return min(info.shape.size_m[:2])


def _mass_kg(info: ObjectInfo) -> float:
    return info.mass_kg


def _less(measure: Callable[[ObjectInfo], float]) -> Callable[[ObjectInfo], float]:
    return lambda info: -measure(info)


_MEASURES: dict[str, Callable[[ObjectInfo], float]] = {
    "largest": volume,
    "smallest": _less(volume),
    "heaviest": _mass_kg,
    "lightest": _less(_mass_kg),
    "thickest": _width_m,
    "thinnest": _less(_width_m),
    "tallest": _height_m,
    "shortest": _less(_height_m),
}
