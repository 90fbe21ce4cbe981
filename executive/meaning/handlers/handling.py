"""Goals that go through the hands: taking, putting, bringing, giving."""

from __future__ import annotations

from executive.meaning.handlers.steps import about, search, surfaces
from executive.meaning.identify import Scene, cannot
from executive.skills.give import GiveParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.trees.parts import Part, Series
from intents import goals
from robot.messages import ObjectInfo, Place

COMFORTABLE_HEIGHT_M = 0.8
COVERED_M = 1.0
"""A surface with less free height above it lies in its piece of furniture; tops are open."""


def pick(goal: goals.Pick, scene: Scene) -> Part:
    """Take one thing, or several one after the other."""
    if goal.object.count not in (None, 1):
        found = scene.objects(goal.object)
        parts = tuple(_pick_one(info, goal.object, scene) for info in found)
        return Series(name="pick up several things", parts=parts)
    return _pick_one(scene.object(goal.object), goal.object, scene)


def _pick_one(info: ObjectInfo, query: goals.ObjectQuery, scene: Scene) -> Part:
    scene.take(info.id)
    name = info.full_name
    pick = about(info, f"pick up {name}", PickParams(object_id=info.id))
    if query.at is None:  # picking begins with looking for it everywhere
        return pick
    return Series(name=f"take {name}", parts=(search(info, query, scene), pick))


def place(goal: goals.Place, scene: Scene) -> Part:
    """Put one thing somewhere, after fetching it."""
    info = scene.object(goal.object)
    if goal.in_ is not None:
        return _put(info, goal.object, goal.in_, scene, inside=True)
    if goal.on is None:
        raise cannot("invalid_goal", f"put {info.full_name} where?", suggestion="name a place")
    return _put(info, goal.object, goal.on, scene)


def give(goal: goals.Give, scene: Scene) -> Part:
    """Hand something to a person, after fetching it."""
    return _hand_over(goal.object, goal.to, scene)


def _hand_over(query: goals.ObjectQuery, to: goals.Person, scene: Scene) -> Part:
    """Give an object to a person, after fetching it unless it is in the hand by then."""
    info, person = scene.object(query), scene.person(to)
    name, in_hand = info.full_name, info.id in scene.held
    fetch = None if in_hand else _pick_one(info, query, scene)
    scene.put_down(info.id)
    params = GiveParams(object_id=info.id, person_id=person.id)
    give = about(info, f"give {name} to {person.name}", params, carries=True)
    if fetch is None:
        return give
    return Series(name=f"bring {name} to {person.name}", parts=(fetch, give))


def bring(goal: goals.Bring, scene: Scene) -> Part:
    """Bring things to a person or to a place."""
    if isinstance(goal.to, goals.Person):
        return _hand_over(goal.object, goal.to, scene)
    if goal.object.count not in (None, 1):
        found = scene.objects(goal.object)
        parts = [_put(info, goal.object, goal.to, scene) for info in found]
        return Series(name=f"bring several things to the {goal.to}", parts=tuple(parts))
    return _put(scene.object(goal.object), goal.object, goal.to, scene)


def _put(
    info: ObjectInfo,
    query: goals.ObjectQuery,
    target: str,
    scene: Scene,
    *,
    inside: bool = False,
) -> Part:
    """Put an object on (or in) a place, after fetching it unless it is in the hand by then."""
    if inside:
        _check_inside(target, scene)
    place = _best_surface(info, target, scene)
    name = info.full_name
    params = PlaceParams(object_id=info.id, place_id=place.id)
    put = about(info, f"put {name} on the {place.name}", params, carries=True)
    if info.id in scene.held:
        scene.put_down(info.id)
        return put
    fetch = _pick_one(info, query, scene)
    scene.put_down(info.id)
    return Series(name=f"bring {name} to the {target}", parts=(fetch, put))


def _check_inside(target: str, scene: Scene) -> None:
    """Refuse to put something in what has no inside: what stands on it would not be in it.

    An inside is made of surfaces with something above them, as the boards of a shelf are.
    """
    wanted = surfaces(scene.places(target))
    of = {place.of for place in wanted}
    covered = any(p.of in of and p.clearance_m < COVERED_M for p in scene.knowledge.map.places)
    if wanted and not covered:
        name = wanted[0].name
        raise cannot(
            "invalid_goal",
            f"the {name} has no inside that this robot can reach",
            suggestion=f"if on top of it will do, say: put it on the {name}",
        )


def _best_surface(info: ObjectInfo, target: str, scene: Scene) -> Place:
    """Of the surfaces of that name the one that is easiest to reach and high enough."""
    boards = surfaces(scene.places(target))
    if not boards:
        text = f"nothing can be put down in the {target}"
        raise cannot("invalid_goal", text, suggestion="name a table or a shelf")
    height_m = info.shape.size_m[2]
    free = [place for place in boards if place.clearance_m > height_m + 0.03]
    if not free:
        text = f"{info.full_name} is {height_m:.2f} m high and does not fit there"
        raise cannot("no_free_spot", text, clearance_m=boards[0].clearance_m)
    return min(free, key=lambda place: abs(place.X_WP.p[2] - COMFORTABLE_HEIGHT_M))
