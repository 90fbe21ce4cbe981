"""Steps that goals of several families are made of."""

from __future__ import annotations

from collections.abc import Iterable

from executive.meaning.identify import Scene
from executive.skills.inspect import InspectParams
from executive.skills.motions.likelihood import surfaces_of
from executive.skills.parameters import SkillParams
from executive.skills.search import SearchParams
from executive.trees.parts import Errand
from intents import goals
from robot.messages import ObjectInfo, Place


def about(info: ObjectInfo, name: str, params: SkillParams, *, carries: bool = False) -> Errand:
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
    name: str, at: str | None, scene: Scene, *, ids: Iterable[str] = ()
) -> tuple[Errand, ...]:
    """Look over the place that was said, or what is in view from here if none was."""
    places = to_look_over(scene.places(at), scene) if at else ()
    if at and not places:
        return ()
    params = InspectParams(
        place_ids=tuple(place.id for place in places), object_ids=tuple(sorted(ids))
    )
    return (Errand(name=name, params=params, object_name=f"the {at}" if at else ""),)


def surfaces(places: tuple[Place, ...]) -> tuple[Place, ...]:
    """The places that things stand on; a room says nothing about where in it."""
    return tuple(place for place in places if not place.floor)
