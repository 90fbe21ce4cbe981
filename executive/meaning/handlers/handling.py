"""Goals that go through the hands: taking, putting, bringing, giving."""

from __future__ import annotations

from collections.abc import Callable

from executive.behaviours.run_skill import Bound
from executive.meaning import answers
from executive.meaning.handlers.putting import beside, next_to_furniture, part_of_place
from executive.meaning.handlers.settling import from_there, places_at
from executive.meaning.handlers.steps import about, many, search, several, surfaces
from executive.meaning.identify import Scene, cannot
from executive.skills.give import GiveParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.say import SayParams
from executive.trees.parts import Branch, Errand, Part, Series
from intents import goals
from intents.grounding import HOW_WORDS
from robot.messages import ObjectInfo, Place
from robot.se3 import SE3

COMFORTABLE_HEIGHT_M = 0.8
COVERED_M = 1.0
"""A surface with less free height above it lies in its piece of furniture; tops are open."""


def pick(goal: goals.Pick, scene: Scene) -> Part:
    """Take one thing, or several one after the other."""
    query = goal.object
    if many(query):
        found = scene.objects(query)
        return several(found, "pick up several things", lambda info: _pick_one(info, query, scene))
    return _pick_one(scene.object(query), query, scene)


def _pick_one(
    info: ObjectInfo, query: goals.ObjectQuery, scene: Scene, *, to: Place | None = None
) -> Part:
    """Take one thing; `to` is where it will be put. Raises CannotMean if somebody has it."""
    name = info.full_name
    if holder := scene.holder_of(info):
        cure = f"ask {holder} to put it down"
        raise cannot("out_of_reach", f"{holder} has {name}", suggestion=cure)
    scene.take(info.id)
    params = PickParams(object_id=info.id, for_place_id=to and to.id)
    pick = about(info, f"pick up {name}", params)
    if query.at is None:  # picking begins with looking for it everywhere
        return pick
    if not many(query) and not scene.is_settled(query):
        pick = from_there(info, query, scene, pick)
    return Series(name=f"take {name}", parts=(search(info, query, scene), pick))


def place(goal: goals.Place, scene: Scene) -> Part:
    """Put things somewhere, after fetching them."""
    query = goal.object
    target = goal.in_ or goal.on
    inside = goal.in_ is not None

    def one(info: ObjectInfo) -> Part:
        if goal.relation is not None:
            return _put_beside(info, query, goal.relation, scene)
        if target is None:
            raise cannot("invalid_goal", f"put {info.full_name} where?", suggestion="name a place")
        return _put(info, query, target, scene, inside=inside, part=goal.part)

    if not many(query):
        info = scene.object(query)
        if target is None or goal.relation is not None or goal.part is not None:
            return one(info)
        return _unless_there(info, target, scene, one)
    if target is None or goal.part is not None:
        return several(scene.objects(query), "put several things", one)
    return put_several(query, target, scene, one)


def _unless_there(
    info: ObjectInfo, target: str, scene: Scene, one: Callable[[ObjectInfo], Part]
) -> Part:
    """Put a thing on a place, unless it is there: that is asked again when its turn comes."""
    there = places_at(target, scene, near=False)
    at = scene.believed_at(info)
    maybe = info.id not in scene.held and at in {place.name for place in there}
    work = one(info)
    if not maybe:
        return work
    name = info.full_name
    text = f"{name[:1].upper()}{name[1:]} is on the {at} already."
    tell = Errand(name=f"say that {name} is there", params=SayParams(text=text))
    return Branch(
        name=f"is {name} there already",
        question=answers.is_there(frozenset({info.id}), there),
        then=tell,
        otherwise=work,
    )


def put_several(
    query: goals.ObjectQuery, target: str, scene: Scene, one: Callable[[ObjectInfo], Part]
) -> Part:
    """Put several things on a place; what is there already stays as it is.

    Raises:
        Unsettled: which things are meant has to be seen.
        CannotMean: there are no such things, or there is no such place.
    """
    found = scene.objects(query)
    there = places_at(target, scene)

    def unless_there(info: ObjectInfo) -> Part:
        in_hand, work = info.id in scene.held, one(info)
        if in_hand or not there:
            return work
        is_there = answers.is_there(frozenset({info.id}), there)
        stays = Series(name=f"{info.full_name} is there", parts=())
        asked = f"is {info.full_name} there already"
        seen = Branch(name=asked, question=is_there, then=stays, otherwise=work)
        look = _unless_known(info, search(info, query, scene))
        fetch = Series(name=work.name, parts=(look, seen))
        return Branch(name=asked, question=is_there, then=stays, otherwise=fetch)

    return several(found, f"bring several things to the {target}", unless_there)


def _unless_known(info: ObjectInfo, look: Part) -> Part:
    """A search for a thing, unless it was seen somewhere: who takes it looks there anyway."""
    known = answers.is_there(frozenset({info.id}), ())
    nothing = Series(name="go on", parts=())
    name = f"was {info.full_name} seen"
    return Branch(name=name, question=known, then=nothing, otherwise=look)


def give(goal: goals.Give, scene: Scene) -> Part:
    """Hand things to a person, after fetching them."""
    return _hand_over(goal.object, goal.to, scene)


def _hand_over(query: goals.ObjectQuery, to: goals.Person, scene: Scene) -> Part:
    """Give things to a person one after the other."""
    if many(query):
        found = scene.objects(query)
        name = f"bring several things to {scene.person(to).name}"
        return several(found, name, lambda info: _hand_one_over(info, query, to, scene))
    return _hand_one_over(scene.object(query), query, to, scene)


def _hand_one_over(
    info: ObjectInfo, query: goals.ObjectQuery, to: goals.Person, scene: Scene
) -> Part:
    """Give an object to a person, after fetching it unless it is in the hand by then."""
    person = scene.person(to)
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
    return place(goals.Place(object=goal.object, on=goal.to), scene)


def _put(
    info: ObjectInfo,
    query: goals.ObjectQuery,
    target: str,
    scene: Scene,
    *,
    inside: bool = False,
    part: goals.Part | None = None,
) -> Part:
    """Put an object on (or in) a place, after fetching it unless it is in the hand by then."""
    if inside:
        _check_inside(target, scene)
    if not places_at(target, scene, near=False):
        return _carry_to(info, query, target, scene)
    place, *others = _surfaces_for(info, target, scene)
    name = info.full_name
    params: PlaceParams | Bound = PlaceParams(
        object_id=info.id, place_id=place.id, or_place_ids=tuple(one.id for one in others)
    )
    if part is not None:
        params = part_of_place(info, place, part)
    put = about(info, f"put {name} on the {place.name}", params, carries=True)
    return _fetched(info, query, scene, (put,), name=f"bring {name} to the {target}", to=place)


def _fetched(
    info: ObjectInfo,
    query: goals.ObjectQuery,
    scene: Scene,
    then: tuple[Part, ...],
    *,
    name: str,
    keeps: bool = False,
    to: Place | None = None,
) -> Part:
    """Fetch an object unless it is in the hand by then, and do something with it."""
    fetch = () if info.id in scene.held else (_pick_one(info, query, scene, to=to),)
    if not keeps:
        scene.put_down(info.id)
    parts = (*fetch, *then)
    return parts[0] if len(parts) == 1 else Series(name=name, parts=parts)


def _carry_to(info: ObjectInfo, query: goals.ObjectQuery, target: str, scene: Scene) -> Part:
    """Be at a spot of the floor with a thing in the hand: there is nothing to put it on."""
    name, spot = info.full_name, scene.places(target)[0]
    go = about(
        info, f"carry {name} to the {target}", NavigateParams(place_id=spot.id), carries=True
    )
    text = f"I am at the {target}, with {name} in my hand."
    tell = Errand(name="say where it is", params=SayParams(text=text))
    said = f"bring {name} to the {target}"
    return _fetched(info, query, scene, (go, tell), name=said, keeps=True)


def _put_beside(
    info: ObjectInfo, query: goals.ObjectQuery, relation: goals.Relation, scene: Scene
) -> Part:
    """Put an object next to another one, which is found first, or next to furniture."""
    called = scene.knowledge.places(relation.of.name or "")
    furniture = tuple(one for one in called if relation.of.at in (None, one.room)) or called
    if furniture and relation.other is None and not scene.fitting(relation.of):
        return _put_next_to(info, query, furniture, scene)
    ends = [end for end in (relation.of, relation.other) if end is not None]
    marks = [scene.object(end) for end in ends]
    if info in marks:
        raise cannot("invalid_goal", f"{info.full_name} cannot be put beside itself")
    finds = tuple(search(mark, end, scene) for mark, end in zip(marks, ends, strict=True))
    how = HOW_WORDS[relation.how]
    name = f"put {info.full_name} {how} {' and '.join(mark.full_name for mark in marks)}"
    put = about(info, name, beside(info, relation.how, marks, scene.knowledge), carries=True)
    scene.spoken_of = info.id
    return _fetched(info, query, scene, (*finds, put), name=name)


def _put_next_to(
    info: ObjectInfo, query: goals.ObjectQuery, furniture: tuple[Place, ...], scene: Scene
) -> Part:
    """Put an object next to a piece of furniture: on the surface that is nearest to it."""
    landmark = furniture[0].name
    found = next_to_furniture(furniture, scene.knowledge)
    if found is None:
        raise cannot(
            "no_free_spot",
            f"there is nothing next to the {landmark} that things can be put on",
            suggestion="name a place to put it on",
        )
    surface, wanted = found
    name = f"put {info.full_name} on the {surface.name}, next to the {landmark}"
    params = PlaceParams(object_id=info.id, place_id=surface.id, spots=wanted)
    scene.spoken_of = info.id
    return _fetched(info, query, scene, (about(info, name, params, carries=True),), name=name)


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


def _surfaces_for(info: ObjectInfo, target: str, scene: Scene) -> tuple[Place, ...]:
    """The surfaces of that name that are high enough, the one that is easiest to reach first.

    The others are those of the same piece of furniture: for when it is full.
    """
    boards = places_at(target, scene, near=False)
    height_m = info.shape.size_m[2]
    free = [place for place in boards if place.clearance_m > height_m + 0.03]
    if not free:
        text = f"{info.full_name} is {height_m:.2f} m high and does not fit there"
        raise cannot("no_free_spot", text, clearance_m=boards[0].clearance_m)
    free.sort(key=lambda place: abs(place.X_WP.p[2] - COMFORTABLE_HEIGHT_M))
    chosen: dict[SE3, Place] = {}
    for one in free:
        if one is free[0] or one.of in (free[0].of, free[0].id):
            chosen.setdefault(one.X_WP, one)  # a shelf is one of its boards, too
    return tuple(chosen.values())
