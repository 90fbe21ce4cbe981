"""Steps that goals of several families are made of."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from executive.behaviours.run_skill import Bound
from executive.meaning.identify import Scene
from executive.skills.inspect import InspectParams
from executive.skills.motions.likelihood import surfaces_of
from executive.skills.parameters import SkillParams
from executive.skills.search import SearchParams
from executive.trees.parts import Each, Errand, OnFail, Part, Series
from intents import goals
from robot.failures import codes
from robot.messages import ObjectInfo, Place

PASSED_OVER = codes("look")
"""Failures of one look after which the next one may still find it."""


def about(
    info: ObjectInfo, name: str, params: SkillParams | Bound, *, carries: bool = False
) -> Errand:
    """A step that is about an object."""
    return Errand(
        name=name, params=params, object_id=info.id, object_name=info.full_name, carries=carries
    )


def search(info: ObjectInfo, query: goals.ObjectQuery, scene: Scene) -> Errand:
    """Look for an object, first at the place that was said."""
    places = to_look_over(scene.places(query.at), scene) if query.at else ()
    params = SearchParams(object_id=info.id, place_ids=tuple(place.id for place in places))
    return about(info, f"find {info.full_name}", params)


def to_look_over(places: Iterable[Place], scene: Scene) -> tuple[Place, ...]:
    """Every surface that a name means to somebody who looks, each once.

    Of a room all surfaces in it, of a piece of furniture with boards all of them.
    """
    every = surfaces_of(scene.knowledge.map)
    found: dict[str, Place] = {}
    for place in places:
        if place.floor:
            within = [other for other in every if other.room == place.id and place.id == place.room]
        elif place.id == place.of:
            within = [other for other in every if other.of == place.of]
        else:
            within = [place]
        found.update({one.id: one for one in within})
    return tuple(found.values())


def inspect(
    name: str,
    at: str | None,
    scene: Scene,
    *,
    ids: Iterable[str] = (),
    about: Iterable[str] = (),
    least: int | None = None,
) -> tuple[Errand, ...]:
    """Look over the place that was said, or what is in view from here if none was.

    `ids`, `about` and `least` as of `InspectParams`.
    """
    places = to_look_over(scene.places(at), scene) if at else ()
    if at and not places:
        return ()
    params = InspectParams(
        place_ids=tuple(place.id for place in places),
        object_ids=tuple(sorted(ids)),
        about_ids=tuple(sorted(about)),
        least=least,
    )
    return (Errand(name=name, params=params, object_name=f"the {at}" if at else ""),)


def several(found: list[ObjectInfo], name: str, one: Callable[[ObjectInfo], Part]) -> Each:
    """The same with each of several things, whatever becomes of the others."""
    things = tuple(info.full_name for info in found)
    return Each(name=name, parts=tuple(one(info) for info in found), things=things)


def many(query: goals.ObjectQuery) -> bool:
    """Whether a description is of several things: "both cups", "all cups"."""
    return query.count not in (None, 1) and not query.held


def surfaces(places: tuple[Place, ...]) -> tuple[Place, ...]:
    """The places that things stand on; a room says nothing about where in it."""
    return tuple(place for place in places if not place.floor)


def visit(place: Place, *, about: Iterable[str] = ()) -> Errand:
    """Go to a surface and look over it, closer at what may be one of some things."""
    params = InspectParams(place_ids=(place.id,), about_ids=tuple(sorted(about)))
    return Errand(name=f"look over the {place.name}", params=params)


def tolerant(part: Part, reasons: Iterable[str] = PASSED_OVER) -> Part:
    """A look that may come to nothing, for one of these reasons: the next one goes on."""
    nothing = Series(name="go on", parts=())
    handlers = tuple((code, nothing) for code in reasons)
    return OnFail(name=part.name, part=part, handlers=handlers)
