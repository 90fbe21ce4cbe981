"""Steps that goals of several families are made of."""

from __future__ import annotations

from executive.meaning.identify import Scene
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
    """Look for an object, at the place that was said."""
    places = surfaces(scene.places(query.at)) if query.at else ()
    params = SearchParams(object_id=info.id, place_ids=tuple(place.id for place in places))
    return about(info, f"find {info.full_name}", params)


def surfaces(places: tuple[Place, ...]) -> tuple[Place, ...]:
    """The places that things stand on; a room says nothing about where in it."""
    return tuple(place for place in places if not place.floor)
