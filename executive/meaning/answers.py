"""What the robot says of itself and of what it knows, put into words when its turn comes."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping

from executive.behaviours.conditions import Predicate
from executive.behaviours.run_skill import Bound
from executive.blackboard import GIVEN, HEARD, HELD, WORLD, Blackboard
from executive.meaning.knowledge import Knowledge
from executive.meaning.robot_state import state_of
from executive.skills.motions.likelihood import surfaces_of
from executive.skills.motions.look_closer import unclear, unclear_words
from executive.skills.motions.support import stands_on
from executive.skills.motions.survey import ENOUGH, Prospect, Survey
from executive.skills.say import SayParams
from intents import replies
from intents.english.trouble import listing
from intents.english.words.lexer import singular
from intents.goals import ReportTopic
from intents.numbers import Noun
from robot.messages import ObjectInfo, PersonInfo, Place, Track, WorldMap


def is_held(ids: frozenset[str], *, least: int = 1) -> Predicate:
    """Whether so many of the objects at least are in a hand."""
    return lambda board: len(ids & set(board.read(HELD).values())) >= least


def is_there(ids: frozenset[str], places: Iterable[Place], *, least: int = 1) -> Predicate:
    """Whether so many of the objects at least are believed to be there (on a place, if any)."""
    surfaces = tuple(places)
    return lambda board: len(_seen(board, ids, surfaces)) >= least


def gone(
    knowledge: Knowledge,
) -> Callable[[Blackboard, Mapping[str, str], Collection[str]], list[str]]:
    """Names the things that were put somewhere, or taken, and are not there by what is believed.

    What is not tracked may well stand where it was put.
    """

    def names(board: Blackboard, put_down: Mapping[str, str], taken: Collection[str]) -> list[str]:
        world = board.read(WORLD)
        tracks = {track.id: track for track in world.tracks} if world is not None else {}
        held = board.read(HELD).values()
        lost = [knowledge.object(object_id) for object_id in taken if object_id not in held]
        found = [f"{info.full_name} in the hand" for info in lost if info is not None]
        for object_id, place_id in put_down.items():
            info, place = knowledge.object(object_id), knowledge.place(place_id)
            track = tracks.get(object_id)
            if info is None or place is None or track is None or track.X_WO is None:
                continue
            if track.missing or track.held_by is not None or not stands_on(track.X_WO, place):
                found.append(f"{info.full_name} on the {place.name}")
        return found

    return names


def count(
    ids: frozenset[str], places: Iterable[Place], *, noun: Noun, where: str, of: WorldMap
) -> Bound:
    """Says how many of the objects have been seen on some places of a map, and what was not seen.

    Who was to look at one place, and saw little of it, has failed before it comes to that.
    """
    surfaces = tuple(places)

    def words(board: Blackboard) -> SayParams:
        told = _counted(len(_seen(board, ids, surfaces)), noun, where)
        missed = not_looked_over(board, of, surfaces) if len(surfaces) > 1 else ""
        more = f" I have not seen all of {missed}." if missed else ""
        return SayParams(text=f"{told}{more}{_without_name(board, ids, surfaces, of)}")

    return words


def things(
    infos: Iterable[ObjectInfo], places: Iterable[Place], *, where: str, of: WorldMap
) -> Bound:
    """Says which of the objects have been seen on some places of a map, and what was not seen."""
    surfaces, names = tuple(places), {info.id: info.full_name for info in infos}

    def words(board: Blackboard) -> SayParams:
        seen = {track.id for track in _seen(board, frozenset(names), surfaces)}
        told = listing([name for id, name in names.items() if id in seen], "and") or "nothing"
        missed = not_looked_over(board, of, surfaces) if len(surfaces) > 1 else ""
        more = f" I have not seen all of {missed}." if missed else ""
        more += _without_name(board, frozenset(names), surfaces, of)
        return SayParams(text=f"I see {told}{where}.{more}")

    return words


def count_everywhere(ids: frozenset[str], world_map: WorldMap, *, noun: Noun) -> Bound:
    """Says how many of the objects have been seen at all, and where nobody has looked."""

    def words(board: Blackboard) -> SayParams:
        told = _counted(len(_seen(board, ids, ())), noun)
        missed = not_looked_over(board, world_map)
        more = f" I have not looked at {missed}." if missed else ""
        return SayParams(text=f"{told}{more}{_without_name(board, ids, (), world_map)}")

    return words


def _without_name(
    board: Blackboard, ids: frozenset[str], places: tuple[Place, ...], world_map: WorldMap
) -> str:
    """That something there may be one more of the objects, in a sentence; "" if nothing."""
    world = board.read(WORLD)
    things = unclear(world, ids, places) if world is not None else ()
    return f" I cannot tell what {unclear_words(things, world_map)} is." if things else ""


def not_looked_over(
    board: Blackboard, world_map: WorldMap, surfaces: Iterable[Place] | None = None
) -> str:
    """Those surfaces, or of all, of which not enough has been in view, or nothing.

    Where they are in several rooms the rooms are told.
    """
    world = board.read(WORLD)
    every = surfaces_of(world_map) if surfaces is None else surfaces
    survey = Survey(Prospect(place=place) for place in every)
    survey.take(world.looked if world is not None else ())
    missed = [place for place in survey.places if survey.seen_share(place) < ENOUGH]
    rooms = {place.id: place for place in world_map.places if place.floor}
    several = len({place.room for place in survey.places}) > 1
    names: dict[str, None] = {}
    for place in missed:
        room = rooms.get(place.room)
        if room is None or not several:
            names[f"the {place.name}"] = None
            continue
        whole = all(other in missed for other in survey.places if other.room == place.room)
        names[f"the {room.name}" if whole else f"parts of the {room.name}"] = None
    return listing(list(names), "and")


def say_count(number_of: Callable[[Blackboard], int], *, noun: Noun, where: str = "") -> Bound:
    """Says how many there are: "I see 2 boxes on the desk."."""
    return lambda board: SayParams(text=_counted(number_of(board), noun, where))


def _counted(number: int, noun: Noun, where: str = "") -> str:
    """How many there are, in words."""
    return f"I see {number} {noun.of(number)}{where}."


def whereabouts(info: ObjectInfo, knowledge: Knowledge) -> Bound:
    """Says where a thing is believed to be: "The red cup is on the desk in the study."."""

    def words(board: Blackboard) -> SayParams:
        name = f"{info.full_name[:1].upper()}{info.full_name[1:]}"
        world = board.read(WORLD)
        tracks = () if world is None else world.tracks
        track = next((one for one in tracks if one.id == info.id), None)
        if info.id in board.read(HELD).values():
            return SayParams(text=f"{name} is in my hand.")
        if track is None or track.X_WO is None or track.missing:
            return SayParams(text=f"I do not know where {info.full_name} is.")
        surface, room = knowledge.surface_under(track.X_WO), knowledge.room_at(track.X_WO.p)
        places = [f" on the {surface.name}"] if surface is not None else []
        places += [f" in the {room}"] if room else []
        last = info.plain_name.rpartition(" ")[2]
        be = "are" if singular(last) != last else "is"
        text = f"{name} {be}{''.join(places)}." if places else f"I see {info.full_name}."
        return SayParams(text=text)

    return words


def answered(person: PersonInfo, what: str) -> Bound:
    """Says what somebody has said to whom a question was put: "I asked Ines if ...: Yes."."""

    def words(board: Blackboard) -> SayParams:
        said = board.read(HEARD).get(person.id, "")
        asked = f"I asked {person.name} {what}"
        if not said:  # another executive asked, and died
            return SayParams(text=f"{asked}, and do not know the answer.")
        return SayParams(text=f"{asked}. The answer is: {said}")

    return words


def report(topic: ReportTopic, knowledge: Knowledge, *, skills: frozenset[str]) -> Bound:
    """Says something about the robot itself; `skills` as for `state_of`."""

    def words(board: Blackboard) -> SayParams:
        return SayParams(text=replies.report(topic, state_of(board, knowledge, skills=skills)))

    return words


def _seen(board: Blackboard, ids: frozenset[str], places: tuple[Place, ...]) -> list[Track]:
    world = board.read(WORLD)
    if world is None:
        return []
    seen = [t for t in world.tracks if t.id in ids and t.X_WO is not None and not t.missing]
    if not places:
        return seen
    away = {*board.read(HELD).values(), *board.read(GIVEN)}
    here = [t for t in seen if t.held_by is None and t.id not in away]  # a hand is no place
    return [t for t in here if t.X_WO and any(stands_on(t.X_WO, place) for place in places)]
