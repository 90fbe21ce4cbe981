"""Goals that are done with the eyes: looking, finding, counting."""

from __future__ import annotations

import math

from msgspec.structs import replace

from executive.blackboard import WORLD, Blackboard
from executive.meaning import answers
from executive.meaning.handlers.moving import go_to_person
from executive.meaning.handlers.people import to_their_face
from executive.meaning.handlers.settling import counted, where_words
from executive.meaning.handlers.steps import (
    about,
    inspect,
    many,
    search,
    several,
    to_look_over,
    tolerant,
)
from executive.meaning.identify import Scene, cannot
from executive.skills.inspect import InspectParams
from executive.skills.look import SIDES, LookParams, Side
from executive.skills.motions.likelihood import surfaces_of
from executive.skills.navigate import NavigateParams, Step
from executive.skills.search import SearchParams
from executive.trees.parts import Branch, Errand, Part, Series
from intents import goals
from robot.messages import ObjectInfo

AROUND, BEHIND = "around", "behind"
NAME, LOCATION = "name", "location"
_SIDES: dict[str, Side] = {side: side for side in SIDES}


def look_at(goal: goals.LookAt, scene: Scene) -> Part:
    """Turn the eyes to something; an object is looked for."""
    if goal.place == AROUND:
        return Errand(name="look around", params=LookParams(around=True))
    if goal.object is not None and many(goal.object):
        return several(scene.objects(goal.object), "look at several things", _look_at)
    if goal.object is not None:
        return _look_at(scene.object(goal.object))
    if goal.person is not None:
        found = scene.person(goal.person)
        return Errand(name=f"look at {found.name}", params=LookParams(person_id=found.id))
    if goal.place is None:
        raise cannot("invalid_goal", "look at what?", suggestion="name an object or a place")
    if not scene.knowledge.places(goal.place) and (aside := _aside(goal.place)) is not None:
        return aside
    return _look_at_place(goal.place, scene)


def _look_at_place(name: str, scene: Scene) -> Part:
    """Turn the eyes to a place, from the room that it is in; in a room they go all around.

    "Have a look in the pantry" is not done from the hall: nobody sees through a wall.
    """
    place, knowledge = scene.places(name)[0], scene.knowledge
    room = knowledge.place(place.room)
    is_room = place is room
    params = LookParams(around=True) if is_room else LookParams(place_id=place.id)
    look = Errand(name=f"look {'around' if is_room else 'at'} the {name}", params=params)
    if room is None:
        return look

    def is_there(board: Blackboard) -> bool:
        world = board.read(WORLD)
        return world is not None and knowledge.room_at(world.X_WB.p) == room.name

    go = Errand(name=f"go to the {name}", params=NavigateParams(place_id=place.id))
    near = Branch(
        name=f"in the {room.name}",
        question=is_there,
        then=Series(name="stay", parts=()),
        otherwise=go,
    )
    return Series(name=f"have a look at the {name}", parts=(near, look))


def _aside(where: str) -> Part | None:
    """A look to a side of the robot; no neck turns far enough to see what is behind."""
    if where == BEHIND:
        step = Step(turn_rad=math.pi)
        turn = Errand(name="turn around", params=NavigateParams(by=step))
        ahead = Errand(name="look ahead", params=LookParams(towards="ahead"))
        return Series(name="look behind", parts=(turn, ahead))
    side = _SIDES.get(where)
    return None if side is None else Errand(name=f"look {side}", params=LookParams(towards=side))


def _look_at(info: ObjectInfo) -> Part:
    params = SearchParams(object_id=info.id)  # it ends with the object in sight
    return about(info, f"look at {info.full_name}", params)


def find(goal: goals.Find, scene: Scene) -> Part:
    """Look for an object, or go and see a person."""
    query = goal.object
    if query is not None and many(query):
        found = scene.objects(query)
        return several(found, "find several things", lambda info: search(info, query, scene))
    if query is not None:
        return search(scene.object(query), query, scene)
    if goal.person is None:
        raise cannot("invalid_goal", "find what?", suggestion="name an object")
    found = scene.person(goal.person)
    look = Errand(name=f"look at {found.name}", params=LookParams(person_id=found.id))
    return Series(name=f"find {found.name}", parts=(go_to_person(goal.person, scene), look))


def tell(goal: goals.Tell, scene: Scene) -> Part:
    """Find a thing and say where it is, or look over a place and say what is there.

    To somebody's face if to whom.

    Raises:
        CannotMean: something else is to be found out.
    """
    if goal.object is not None and goal.property == NAME and goal.object.at is not None:
        return _tell_what_is_there(goal.object, goal, scene)
    if goal.object is None or goal.property != LOCATION:
        raise cannot("unsupported", "this robot cannot find that out yet")
    info = scene.object(goal.object)
    where = Errand(
        name=f"say where {info.full_name} is", params=answers.whereabouts(info, scene.knowledge)
    )
    parts = (search(info, goal.object, scene), *to_their_face(goal.to, scene), where)
    return Series(name=f"tell where {info.full_name} is", parts=parts)


def _tell_what_is_there(query: goals.ObjectQuery, goal: goals.Tell, scene: Scene) -> Part:
    """Look over a place, then say what of that kind, or at all, is there."""
    if query.relation is not None:
        raise cannot("unsupported", "this robot cannot find that out yet",
                     suggestion="ask what is on a piece of furniture, or in a room")  # fmt: skip
    places = to_look_over(scene.places(query.at or ""), scene)
    fitting = scene.fitting(replace(query, count="all"))
    ids = [info.id for info in fitting]
    looks = inspect(f"look over the {query.at}", query.at, scene, about=ids)
    if len(places) > 1:  # what is higher than the eyes hides nothing of the rest
        looks = tuple(tolerant(look, ["place_not_seen"]) for look in looks)
    where = _where(query, scene)
    said = answers.things(fitting, places, where=f" {where}", of=scene.knowledge.map)
    told = to_their_face(goal.to, scene)
    name = f"tell what is {where}"
    return Series(name=name, parts=(*looks, *told, Errand(name="say what is there", params=said)))


def count(goal: goals.Count, scene: Scene) -> Part:
    """Look wherever it was said, then say how many there are, to somebody's face if to whom."""
    query = goal.object
    if query is None:
        raise cannot("unsupported", "this robot cannot count people yet")
    noun = scene.knowledge.noun(query.name or query.category or "object")
    name = f"count the {noun.many}"
    if query.relation is not None:
        looks, number_of = counted(query, scene)
        tell = answers.say_count(number_of, noun=noun, where=f" {where_words(query)}")
    elif query.at is None:
        ids = frozenset(info.id for info in scene.fitting(replace(query, count="all")))
        everywhere = query.count == "all"  # all there are: in the whole house
        looks = _looks_all_over(scene) if everywhere else _looks_around(ids, scene)
        tell = answers.count_everywhere(ids, scene.knowledge.map, noun=noun)
    else:
        ids = frozenset(info.id for info in scene.fitting(replace(query, count="all")))
        places = to_look_over(scene.places(query.at), scene)
        looks = inspect(f"look over the {query.at}", query.at, scene, about=ids)
        if len(places) > 1:  # what is higher than the eyes hides nothing of the rest
            looks = tuple(tolerant(look, ["place_not_seen"]) for look in looks)
        tell = answers.count(
            ids, places, noun=noun, where=f" {_where(query, scene)}", of=scene.knowledge.map
        )
    told = to_their_face(goal.to, scene)
    return Series(name=name, parts=(*looks, *told, Errand(name="say how many", params=tell)))


def _looks_all_over(scene: Scene) -> tuple[Part, ...]:
    """A look over every surface of the home."""
    every = tuple(place.id for place in surfaces_of(scene.knowledge.map))
    if not every:
        return (tolerant(_look_over_the_room(scene)),)
    look = Errand(name="look over every room", params=InspectParams(place_ids=every))
    return (tolerant(look),)


def _looks_around(ids: frozenset[str], scene: Scene) -> tuple[Part, ...]:
    """A look over the room that the robot is in, and over those around if none is seen there.

    In a room where nothing can stand, a corridor say, nobody asks about that room.
    """
    here = tolerant(_look_over_the_room(scene))
    beside = scene.knowledge.rooms_beside(scene.room)
    around = tuple(place.id for place in to_look_over(beside, scene))
    if not around:
        return (here,)
    look = Errand(name="look over the rooms around", params=InspectParams(place_ids=around))
    further = tolerant(look)
    if not to_look_over(scene.knowledge.rooms(scene.room), scene):
        return (here, further)
    seen = Branch(
        name="seen here",
        question=answers.is_there(ids, ()),
        then=Series(name="go on", parts=()),
        otherwise=further,
    )
    return (here, seen)


def _look_over_the_room(scene: Scene) -> Part:
    """A look over every surface of the room that the robot is in; from here if that is unknown."""
    world_map = scene.knowledge.map
    rooms = {place.room for place in surfaces_of(world_map)}
    room = scene.room
    found = to_look_over(scene.knowledge.rooms(room), scene)
    if not found and len(rooms) <= 1:
        found = tuple(surfaces_of(world_map))
    name = f"look over the {room}" if room and found else "look around"
    return Errand(name=name, params=InspectParams(place_ids=tuple(place.id for place in found)))


def _where(query: goals.ObjectQuery, scene: Scene) -> str:
    """Where a description says that things are: "on the desk", "in the kitchen"."""
    said = where_words(query)
    floors = query.at is not None and all(place.floor for place in scene.places(query.at))
    return said.replace("on the", "in the", 1) if floors else said
