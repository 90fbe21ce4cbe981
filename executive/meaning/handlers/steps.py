"""Steps that goals of several families are made of."""

from __future__ import annotations

from collections.abc import Callable

from executive.behaviours.run_skill import Bound
from executive.meaning.identify import Scene
from executive.skills.look import LookParams
from executive.skills.navigate import NavigateParams
from executive.skills.parameters import SkillParams
from executive.skills.search import SearchParams
from executive.trees.parts import Each, Errand, OnFail, Part, Series
from intents import goals
from robot.messages import ObjectInfo, Place

LONG_M = 1.2
"""A surface longer than this is looked over from its middle in three looks, not in one."""
PASSED_OVER = (
    "no_path", "path_blocked", "goal_in_collision", "no_stance", "object_not_seen", "timeout",
    "walk_stalled",
)  # fmt: skip
"""Failures of one look after which the next one may still find it."""


def about(
    info: ObjectInfo, name: str, params: SkillParams | Bound, *, carries: bool = False
) -> Errand:
    """A step that is about an object."""
    return Errand(
        name=name, params=params, object_id=info.id, object_name=info.full_name, carries=carries
    )


def search(info: ObjectInfo, query: goals.ObjectQuery, scene: Scene) -> Errand:
    """Look for an object, at the place that was said."""
    places = surfaces(scene.places(query.at)) if query.at else ()
    params = SearchParams(object_id=info.id, place_ids=tuple(place.id for place in places))
    return about(info, f"find {info.full_name}", params)


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


def visit(place: Place) -> Series:
    """Go to a surface and look over it."""
    name = place.name
    long_m = max(place.size_m)
    along = (1, 0) if place.size_m[0] == long_m else (0, 1)
    aside = (-0.33 * long_m, 0.33 * long_m) if long_m > LONG_M else ()
    points = [place.X_WP.apply((m * along[0], m * along[1], 0.0)) for m in aside]
    ends = [LookParams(p_W=(float(x), float(y), float(z))) for x, y, z in points]
    looks = [LookParams(place_id=place.id), *ends]
    parts = (
        Errand(name=f"go to the {name}", params=NavigateParams(place_id=place.id)),
        *(Errand(name=f"look at the {name}", params=params) for params in looks),
    )
    return Series(name=f"inspect the {name}", parts=parts)


def tolerant(part: Series) -> Part:
    """A look that may come to nothing: the next one goes on."""
    nothing = Series(name="go on", parts=())
    handlers = tuple((code, nothing) for code in PASSED_OVER)
    return OnFail(name=part.name, part=part, handlers=handlers)
