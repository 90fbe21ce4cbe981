"""Going, turning, waiting, looking."""

from math import pi

from msgspec.structs import replace

from intents.english.frames.slots import Slots, need
from intents.english.phrases.complements import Clause, Complement
from intents.english.phrases.phrase import SAID_HOW, NounPhrase
from intents.english.phrases.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.trouble import Misfit, NotUnderstood, Offered, Partly, Unclear
from intents.english.words import lexicon
from intents.english.words.measures import STEP_M
from intents.goals import (
    OPERATOR,
    Bring,
    Displacement,
    Find,
    Goal,
    GoTo,
    How,
    LookAt,
    ObjectQuery,
    Part,
    Place,
    Wait,
)

_FULL_TURN = 2 * pi
_SEARCHED = ("scan", "check", "comb through", "scanning", "checking")
"""Verbs with which it is the place that is named first: scan the shelf for the cup."""
_HOMES = lexicon.words(
    "house building apartment flat home premises place room party area site shop office hotel "
    "store station restaurant hospital school arena scene vicinity here"
)
_BESIDES: tuple[How, ...] = ("behind", "under", "above", "left", "right")
"""Where a robot that walks to a place does not come to stand."""
_HIDES: tuple[How, ...] = ("behind", "under", "left", "right")
"""Where to look would be to walk around or to crouch."""
_THROUGH = (
    ("onto", ["on", "top", "of"]),
    *((way, [said]) for way, said in (
        ("into", "into"), ("into", "in"), ("into", "inside"), ("into", "within"),
        ("onto", "onto"), ("onto", "on"), ("onto", "upon"), ("onto", "atop"),
        ("through", "through"), ("over", "over"), ("across", "across"),
    )),
)  # fmt: skip
"""Ways that lead where only a floor is, with the last words before what is named."""
_ONWARD = ("keep going", "go on", "carry on")
_BY = ("forward", "backward", "left", "right")


def go(clause: Clause, scope: Scope) -> list[Goal]:
    """Go to the kitchen; walk two metres forward; come here."""
    slots = Slots(clause, scope)
    target = slots.take("to", "into", "at", "through") or slots.take("")
    taken = _carried(slots, target)
    if taken:
        return taken
    bare = target is not None and target.role == "" and not target.phrase.is_spot
    bare = bare and not (target and target.phrase.where)
    if bare and clause.verb.split()[0] not in (
        "reach",
        "approach",
        "visit",
        "enter",
        "come",
        "go",
        "off",
    ):
        raise Misfit("that is to move something")
    source = _source(slots, target)
    _pass_over_moment(slots, target)
    distance = slots.measure("length")
    direction = slots.direction(*_BY)
    slots.direction("around", "up", "down")
    second = slots.take("at", "")
    if target and second and clause.text.word(second.phrase.start) == "where":
        person = to_person(second.phrase, scope)
        slots.done()
        return [Find(person=replace(person, at=to_place(target.phrase, scope)))]
    if target and second and target.phrase.noun in ("here", "there"):
        target = second
    elif second and not (target and second.phrase.noun in ("here", "there")):  # to me over here
        raise Misfit(f"“{second.phrase.said}” is one place too many")
    _must_have_side(clause, direction)
    if target is None and not direction:
        _must_not_be_from(source, clause)
    if target is None and (distance is not None or direction or clause.vague()):
        slots.done()
        vague = clause.vague() and clause.verb != "step"
        return [_step(direction or _implied(clause), distance, vague=vague)]
    if target is None and (
        clause.verb.startswith(("come", "return", "get back")) or clause.verb.endswith(" back")
    ):
        slots.done()
        return [GoTo(place=OPERATOR)]
    pushed = target is not None and target.role == "" and clause.verb == "move"
    if pushed and (direction or (target and target.phrase.determiner)):
        raise NotUnderstood("I can carry things, not move furniture")
    if target is None and clause.vague() is False and source is None:
        need(clause.verb in _ONWARD, "Where shall I go?")
    if target is None or source is not None:
        raise Misfit("I need to know where to go to")
    slots.done()
    must_be_to(target, clause)
    for phrase in target.phrases:
        must_be_beside(phrase, clause, scope)
    return [_towards(clause, scope, phrase) for phrase in target.phrases]


def _source(slots: Slots, target: Complement | None) -> Complement | None:
    """From where it is walked, if not from where the robot is by then.

    To the hall, and *from there* to the lab; three metres *from here*.
    """
    source = slots.take("from")
    noun = source.phrase.noun if source else ""
    return None if noun == "there" or (noun == "here" and target is None) else source


def _must_not_be_from(source: Complement | None, clause: Clause) -> None:
    """Refuse to walk a metre *from the table*, which is no metre forward.

    Raises:
        NotUnderstood: That was said.
    """
    if source is not None and not _backs(clause):
        apart = "I can walk forward, back, to the left or right, and not away from something"
        raise NotUnderstood(apart)


def _pass_over_moment(slots: Slots, target: Complement | None) -> None:
    """Come here *a minute*: it says how long that is wanted, and no goal does."""
    here = target is not None and target.phrase.noun in ("here", "operator")
    if here and slots.clause.verb.startswith("come"):
        slots.measure("time")


def _must_have_side(clause: Clause, direction: str | None) -> None:
    """Ask to which side, where only "sideways" was said."""
    aside = "sideways" in clause.text.words[clause.first : clause.end]
    if aside and not clause.with_role("to", "into", "at") and direction not in ("left", "right"):
        raise Unclear("To the left or to the right?")


def _carried(slots: Slots, target: Complement | None) -> list[Goal]:
    """Come to the door *with the cup*; take the cup and go to the door *with it*.

    What has just been taken stays in the hand: nobody said to put it down there.
    """
    scope, carried = slots.scope, slots.peek("with")
    if carried is None or target is None or target.role not in ("to", "into"):
        return []
    it = carried.phrase.noun == "pronoun" and scope.object and not is_person(carried.phrase, scope)
    if not it and not carried.phrase.name("object"):
        return []
    slots.take("with")
    query = to_object(carried.phrase, scope)
    source = slots.source()
    slots.done()
    query = replace(query, at=query.at or source)
    in_hand = it and any(one.name == query.name for one in scope.group)
    if it and is_person(target.phrase, scope):
        return [Bring(object=query, to=to_person(target.phrase, scope))]
    if in_hand:
        return [_towards(slots.clause, scope, target.phrase)]
    return [Place(object=query, on=to_place(target.phrase, scope))]


def must_be_to(target: Complement, clause: Clause) -> None:
    """Refuse to walk around, behind or under what is named: the robot walks to a place.

    Raises:
        NotUnderstood: That was said.
    """
    said = clause.text.words[clause.first : target.phrase.start]
    way = next((w for w in ("around", "round", "along", "past", "between") if w in said), None)
    if way is None and target.how in _BESIDES:
        way = SAID_HOW.get(target.how, target.how)
    if way:
        places = "two" if way == "between" else "one"
        raise NotUnderstood(f"I can walk to a place, not {way} {places}")


def must_be_beside(phrase: NounPhrase, clause: Clause, scope: Scope) -> None:
    """Refuse to walk into, onto or through what is no room: furniture, and things.

    Raises:
        NotUnderstood: That was said.
    """
    before = [*clause.verb.split()[1:], *clause.text.words[clause.first : phrase.start]]
    way = next((way for way, said in _THROUGH if before[-len(said) :] == said), "")
    way = way or ("into" if clause.verb == "enter" else "")
    name = phrase.name("room", "place", "object")
    if way and name and (phrase.name("object") == name or name in scope.index.furniture):
        raise NotUnderstood(f"I can walk to the {name}, not {way} it")


def _towards(clause: Clause, scope: Scope, phrase: NounPhrase) -> Goal:
    if phrase.noun == "operator" or (clause.verb.startswith("come") and phrase.noun == "here"):
        return GoTo(place=OPERATOR)
    if is_person(phrase, scope):
        return Find(person=to_person(phrase, scope))
    if phrase.where:
        return Find(object=to_object(phrase, scope))
    if phrase.said == "home" and not phrase.names:
        return GoTo(place="home")  # where the robot stays; the world says whether it has one
    if phrase.name("object") and not phrase.name("place", "room"):
        query = to_object(phrase, scope)
        if query != ObjectQuery(name=query.name, at=query.at):
            return Find(object=query)
    return GoTo(place=to_place(phrase, scope, objects=True), part=_part(phrase))


def _part(phrase: NounPhrase) -> Part | None:
    """The part of a room to walk to; at the edge of a table is at the table."""
    return phrase.part if phrase.name("room") and phrase.part != "edge" else None


def _implied(clause: Clause) -> str:
    return "backward" if _backs(clause) else "forward"


def _backs(clause: Clause) -> bool:
    """Whether it is walked backward, and so away from what is in front."""
    return clause.verb.startswith(("back", "return", "go back", "reverse", "retreat"))


def _step(direction: str, distance: float | None, *, vague: bool) -> GoTo:
    """A walk of some distance; a step where none was said, less for "a bit"."""
    length = distance if distance is not None else STEP_M / 2 if vague else STEP_M
    signed = round(-length if direction in ("backward", "right") else length, 4)
    if direction in ("left", "right"):
        return GoTo(by=Displacement(left_m=signed))
    return GoTo(by=Displacement(forward_m=signed))


def leave(clause: Clause, scope: Scope) -> list[Goal]:
    """Leave the apartment: go to the exit."""
    slots = Slots(clause, scope)
    words = clause.text.words[clause.first :]
    if clause.verb == "leave" and "out" in words and "of" not in words:
        raise Misfit("I cannot tell what is to be left out: name what was asked for")
    target = slots.take("", "from", "through")
    exit_to = slots.take("to")
    slots.done()
    if target and target.phrase.noun == "operator" and {"alone", "be"} & set(words):
        raise NotUnderstood("All right, I leave you alone")
    noun = target.phrase.noun if target else ""
    text_before = clause.text.word(clause.first - 2) if clause.verb == "leave" else ""
    stays = target is None and text_before == "you"
    furniture = (
        target is not None and target.phrase.name("place") and not target.phrase.name("room")
    )
    if stays or (furniture and clause.verb == "leave"):
        raise Misfit("that is to put something down")
    if noun == "pronoun" or (noun == "unknown" and target and not _is_home(target.phrase)):
        raise Misfit("that is to put something down")
    if exit_to:
        return [GoTo(place=to_place(exit_to.phrase, scope))]
    if target and (target.phrase.name("object") or is_person(target.phrase, scope)):
        raise Misfit("that is to put something down")
    if target and "exit" not in clause.verb and target.phrase.places:
        raise Misfit("that is to put something down")
    if clause.verb == "leave" and clause.text.word(clause.first) == "off":
        raise Misfit("that is to give something up")
    way_out = next((n for w in ("exit", "door", "entrance") for n in scope.index.exact(w)), None)
    if target and target.phrase.said == "way":
        raise Misfit("that is to step aside")
    out = GoTo(place=way_out.name if way_out else "exit")
    if clause.verb == "exit" and len(clause.text) == 1:
        raise Offered("“Exit”", (out,))  # who types it may want to leave the programme
    return [out]


def _is_home(phrase: NounPhrase) -> bool:
    """Whether it is a building as a whole, or where one is: not *the iron*, which nobody knows."""
    return phrase.said.split()[-1] in _HOMES


def turn(clause: Clause, scope: Scope) -> list[Goal]:
    """Turn left; turn ninety degrees to the right; turn around; face the table."""
    slots = Slots(clause, scope)
    if clause.particles() & {"on", "off", "out"} or set(clause.directions()) & {"up", "down"}:
        raise Misfit("that is to switch something")
    plain = slots.measure("plain")
    unit = _FULL_TURN if plain is not None and plain < 1.0 else pi / 180  # a quarter; ninety
    angle = slots.measure("angle") if plain is None else plain * unit
    direction = slots.direction("left", "right", "around", "backward", "cw", "ccw")
    second = slots.direction("left", "right", "cw", "ccw")
    target = slots.take("to", "at") or slots.take("")
    slots.done()
    spot = target is not None and target.role == "at" and target.phrase.is_spot
    if target and not (spot and direction in ("left", "right")):
        return [_look(target.phrase, scope)]
    if clause.verb.endswith(("around", "round")):
        direction = direction or "around"
    if not direction and angle is None and clause.verb == "face":
        raise Misfit("face what?")
    if not direction and angle is None and clause.verb in ("turn", "rotate"):
        raise Unclear("Which way shall I turn?")
    if angle is None:
        half = direction in ("around", "backward")
        whole = clause.verb.startswith("spin") or not direction
        angle = _FULL_TURN if whole else pi if half else pi / 2
    sign = -1.0 if "right" in (direction, second) or "cw" in (direction, second) else 1.0
    turned = GoTo(by=Displacement(turn_rad=round(sign * angle, 6)))
    if target is None:
        return [turned]
    there = GoTo(place=to_place(target.phrase, scope))  # turn left at the sofa
    raise Partly("I do one thing after the other", (there, turned))


def look(clause: Clause, scope: Scope) -> list[Goal]:
    """Look at the table; inspect the sink; look left."""
    slots = Slots(clause, scope)
    target = slots.take("", "at", "to", "into", "through")
    duration = slots.measure("time")
    while_: list[Goal] = [Wait(duration_s=duration)] if duration is not None else []
    direction = slots.direction("left", "right", "up", "down", "forward", "backward", "around")
    if target is None:
        need(direction, "What shall I look at?")
        slots.done()
        ahead = {"forward": "ahead", "backward": "behind"}.get(direction, direction)
        return [LookAt(place=ahead), *while_]
    slots.done()
    if target.how in _HIDES:
        where = SAID_HOW.get(target.how, target.how)
        seen = tuple(_look(phrase, scope) for phrase in target.phrases)
        raise Partly(f"I can look at a thing or a place, not {where} one", seen)
    return [*(_look(phrase, scope) for phrase in target.phrases), *while_]


def _look(phrase: NounPhrase, scope: Scope) -> LookAt:
    if is_person(phrase, scope) or phrase.noun == "operator":
        return LookAt(person=to_person(phrase, scope))
    if phrase.name("place", "room") and not phrase.name("object"):
        return LookAt(place=to_place(phrase, scope))
    place_is_meant = phrase.noun == "pronoun" and scope.object is None and scope.place
    if phrase.noun in ("here", "there") or place_is_meant:
        return LookAt(place=to_place(phrase, scope))
    return LookAt(object=to_object(phrase, scope, spots=True))


def find(clause: Clause, scope: Scope) -> list[Goal]:
    """Find the cup; look for Julia in the kitchen; search the bedroom for my phone."""
    slots = Slots(clause, scope)
    slots.rest = [c for c in slots.rest if not _for_operator(c)]
    where = slots.take_where() if len(slots.clause.with_role("")) > 1 else None
    if where:
        where.role, slots.rest = "for", [*slots.rest, where]
    sought = slots.take("for")
    searched = slots.take("") if sought else None
    if sought is None:
        sought = slots.take("", "through")
    need(sought, "What shall I look for?")
    if sought is None:
        return []
    if searched is None and clause.verb in _SEARCHED:
        raise Misfit("that is to look at something")
    area = searched or slots.take("at", "from", "into")
    at = to_place(area.phrase, scope) if area else None
    slots.take_person("for")
    slots.done()
    if area and len(area.phrases) > 1:
        places = [to_place(phrase, scope) for phrase in area.phrases]
        finds = tuple(_find(phrase, scope, spot) for phrase in sought.phrases for spot in places)
        raise Partly("I look in one place after the other", finds)
    return [_find(phrase, scope, at) for phrase in sought.phrases]


def _for_operator(said: Complement) -> bool:
    return said.role == "for" and bool(said.phrases) and said.phrase.noun == "operator"


def _find(phrase: NounPhrase, scope: Scope, at: str | None) -> Goal:
    if is_person(phrase, scope):
        person = to_person(phrase, scope)
        return Find(person=replace(person, at=person.at or at))
    if phrase.name("room") and phrase.is_spot:
        return GoTo(place=to_place(phrase, scope))
    query = to_object(phrase, scope, spots=True)
    return Find(object=replace(query, at=query.at or at))


def wait(clause: Clause, scope: Scope) -> list[Goal]:
    """Wait five seconds; wait here; stay at the door for a minute."""
    slots = Slots(clause, scope)
    duration = slots.measure("time")
    if clause.verb.endswith(" by") and slots.take(""):
        raise Misfit("that is to stand beside something")
    place = slots.take("at", "")
    slots.done()
    pause: list[Goal] = [Wait(duration_s=duration)]
    if "outside" in clause.particles():
        raise Partly("I cannot tell where outside is", tuple(pause))
    if place is None or place.phrase.noun in ("here", "there"):
        return pause
    return [GoTo(place=to_place(place.phrase, scope)), *pause]
