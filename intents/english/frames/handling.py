"""Taking, putting, bringing and giving."""

import dataclasses
from collections.abc import Callable

from msgspec.structs import replace

from intents.english.frames import homes, motion
from intents.english.frames.slots import Slots, detach_place, need
from intents.english.frames.targets import MOVES, Target, destination, moved_beside, put_at, to_part
from intents.english.phrases.complements import Clause, Complement, connector_end
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import ME, Scope, is_person, to_object, to_person, to_place
from intents.english.trouble import Misfit, NotUnderstood, Unclear
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.lexicon import EVERYONE, words
from intents.english.words.verbs import verbs_at
from intents.goals import (
    OPERATOR,
    Balance,
    Bring,
    Find,
    ForEach,
    Give,
    Goal,
    GoTo,
    ObjectQuery,
    Person,
    Pick,
    Place,
    Tell,
    Wait,
)

_WISHES = ("i need", "i want", "i would like", "we need", "we want", "we would like")
_DISPOSE = ("get rid", "dispose", "discard", "trash", "recycle", "bin")
_ON_THE_WAY = words(
    "schlep hump heft nip zip dash shuttle wheel dispatch hoof trundle relay smuggle sneak walk jog"
)
"""Verbs that take a thing somewhere, and not to who speaks."""
_IT = words("it they that those")
_PUT_AT = words("on onto in into next beside by near")
_TOLD_WHERE = words("that which")
"""With one of these it is told where a thing is: "I want the vase *that* is on the sill"."""
_OVER = words("over up down out back across through round")
_THROW = ("throw", "discard", "dispose", "trash", "bin", "recycle", "dump", "toss")


def pick(clause: Clause, scope: Scope) -> list[Goal]:
    """Pick up the cup; lift the lid off the pot."""
    slots = Slots(clause, scope)
    if _goes_inside(clause, scope) or (homes.collects(clause) and homes.home(clause, scope)):
        return put(clause, scope)
    together = _gathered(clause, slots)
    if together:
        together.count = together.count or "all"
        return put(clause, scope)
    whither = slots.peek("to", "into")
    if whither and whither.phrase.is_spot and clause.sense == "pick":
        return take(dataclasses.replace(clause, sense="take"), scope)  # remove it to the cellar
    if slots.take_person("to", "for", "") is not None:
        raise Misfit("that is to bring something")
    moved = not _then(clause).isdisjoint(("put", "drop", "bring", "give"))
    moved = moved or _is_moved_on(clause)  # take the cups, and put them there
    objects = slots.objects(handled=moved)
    if not objects and scope.object:
        objects = [scope.object]
    duration = slots.measure("time") if clause.verb.startswith("hold") else None
    posed = bool(duration) and isinstance(scope.last, Balance)  # stand on one leg, hold for 3 s
    need(objects or posed, "What shall I pick up?")
    at = slots.loose_place()
    slots.done()
    if "along" in clause.particles() and isinstance(scope.last, GoTo) and scope.last.place:
        there = Target(on=scope.last.place)  # go to the lab and take the cup along
        return [_each(replace(o, at=o.at or at), lambda q: put_at(q, there)) for o in objects]
    if posed:
        return [Wait(duration_s=duration)]
    held = isinstance(scope.last, Pick) and objects == [scope.object]
    picks: list[Goal] = [] if held else [Pick(object=replace(o, at=o.at or at)) for o in objects]
    return [*picks, Wait(duration_s=duration)] if duration else picks


def _goes_inside(clause: Clause, scope: Scope) -> bool:
    """Open the crate and get the pear *inside*: there it is to be put.

    Raises:
        Unclear: Nothing was spoken of that it could go into.
    """
    goes = "inside" in clause.particles()
    need(not goes or scope.device or scope.place, "Inside what shall I put it?")
    return goes


def _gathered(clause: Clause, slots: Slots) -> NounPhrase | None:
    """Gather the cups on the table: there they are to be, if nothing else is done with them.

    Of what is collected only where it is all there are, and nothing is done with it: "collect all
    the cups on the table and bring them to me" says where they are.
    """
    bare = slots.peek("")
    if clause.verb not in ("gather", "round up", "collect") or bare is None:
        return None
    phrase, then = bare.phrases[-1], _then(clause)
    all_there_are = phrase.count == "all" and then.isdisjoint(("bring", "give", "drop", "take"))
    if "put" in then or (clause.verb == "collect" and not all_there_are):
        return None
    several = phrase.count or phrase.said != " ".join(map(singular, phrase.said.split()))
    where = phrase.places[-1:] or [Locative(c.how, c.phrase) for c in clause.with_role("at")]
    there = bool(where) and where[0].how in ("on", None) and where[0].of.is_spot
    return phrase if several and there else None


def take(clause: Clause, scope: Scope) -> list[Goal]:
    """Take or get: to bring if there is a receiver, to place if there is a destination."""
    roles = [c.role for c in clause.complements if c.phrases]
    has_receiver = any(
        c.phrases and c.role in ("", "for") and is_person(c.phrase, scope)
        for c in clause.complements
    )
    if not roles and clause.measure("length"):
        return motion.go(clause, scope)
    there = (
        clause.verb == "take"
        and scope.place
        and any(c.phrases and c.phrase.noun == "there" for c in clause.complements)
    )
    if there or "to" in roles or "into" in roles or (has_receiver and len(roles) > 1):
        return [_put_down(goal) for goal in bring(clause, scope)]
    if any(word.startswith("fetch") for word in clause.verb.split()) and not _is_moved_on(clause):
        return bring(clause, scope)
    if _is_mine(clause) and not _is_moved_on(clause):
        return bring(clause, scope)
    return pick(clause, scope)


def _is_mine(clause: Clause) -> bool:
    """Can you get *my* phone: who asks for their own things wants to have them."""
    bare = [c for c in clause.complements if c.phrases and c.role == ""]
    mine = bool(bare) and all(one.determiner == "my" for one in bare[0].phrases)
    return mine and clause.verb.split()[-1] == "get"


def _is_moved_on(clause: Clause) -> bool:
    """Fetch the cup *and put it there*; fetch the cup, *take it to Ada*: it is not for me."""
    text, at = clause.text, clause.end
    while at < len(text) and text.word(at) in (COMMA, FULL_STOP):
        at += 1
    after = connector_end(text, at) or at
    starts = [n for n in range(after + 1, len(text)) if text.word(n + 1) in ("it", "them")]
    acts = {sense for n in (after, *starts) for sense, _ in verbs_at(text.words, n)}
    return not acts.isdisjoint(("put", "drop", "bring", "give", "take", "swap"))


def _put_down(goal: Goal) -> Goal:
    """To take something to a place is to put it there."""
    if isinstance(goal, Bring) and isinstance(goal.to, str):
        return Place(object=goal.object, on=goal.to)
    return goal


def bring(clause: Clause, scope: Scope) -> list[Goal]:
    """Bring me a drink from the cabinet; bring the cup to the desk."""
    slots = Slots(clause, scope)
    if _goes_inside(clause, scope):
        return put(clause, scope)
    if clause.verb in _ON_THE_WAY and slots.peek("") is None:
        raise Misfit("that takes nothing along")  # walk into the table
    beside = moved_beside(clause, slots) or to_part(slots)
    if beside is not None:
        objects = slots.objects(handled=True) or ([scope.object] if scope.object else [])
        need(objects, "What shall I bring?")
        slots.done()
        return [_each(o, lambda q: put_at(q, beside)) for o in objects]
    shared = _to_each(clause, slots)
    if shared:
        return [goal for one in shared for goal in bring(one, scope)]
    into = slots.peek("into")
    inside = into is not None and into.phrase.is_spot and not into.phrase.name("room")
    everyone = [c for c in slots.rest if c.phrases and c.phrase.said in EVERYONE]
    if everyone and clause.verb != "offer":
        raise Unclear("I bring things to one person at a time. To whom shall I bring it?")
    to = _receiver(slots)
    if to is None:
        to = _near_destination(slots)
    if isinstance(to, str):
        slots.take_person("for")  # carry it to the lift for him
    objects = slots.objects(handled=True) or ([scope.object] if scope.object and to else [])
    need(objects, "What shall I bring?")
    at = slots.loose_place()
    if to is None and (clause.vague() or set(clause.directions()) - {"backward", "around"}):
        raise NotUnderstood("I can take things to a place, not move them a little")
    then = _then(clause)
    if to is None and clause.verb in _ON_THE_WAY:
        raise Unclear("Where shall I take it?")
    if to is None and clause.verb.startswith(MOVES) and not then:
        raise Unclear("Where shall I take it?")
    on_the_way = to is None and (clause.verb.startswith(MOVES) or "put" in then)
    if on_the_way or (to == ME and _is_put_somewhere(clause)):
        return [Pick(object=replace(o, at=o.at or at)) for o in objects]
    slots.direction("backward")
    slots.done()
    if inside and isinstance(to, str):  # to bring into a cabinet is to put in it, not on it
        within = Target(in_=to)
        return [_each(replace(o, at=o.at or at), lambda q: put_at(q, within)) for o in objects]
    return [
        _each(replace(o, at=o.at or at), lambda q: Bring(object=q, to=to or ME)) for o in objects
    ]


def _to_each(clause: Clause, slots: Slots) -> list[Clause]:
    """Bring *me the pen* and *the cup to Ada*: a clause for each receiver; else none."""
    receiver, to = slots.peek(""), slots.peek("to")
    things = next((c for c in slots.rest if c.role == "" and len(c.phrases) > 1), None)
    if receiver is None or to is None or things is None or receiver is things:
        return []
    if not (is_person(receiver.phrase, slots.scope) and is_person(to.phrase, slots.scope)):
        return []
    first, last = (
        dataclasses.replace(things, phrases=phrases)
        for phrases in (things.phrases[:-1], things.phrases[-1:])
    )
    rest = [c for c in clause.complements if c not in (receiver, things, to)]
    here = dataclasses.replace(receiver, role="to")
    return [
        dataclasses.replace(clause, complements=[first, *rest, here]),
        dataclasses.replace(clause, complements=[last, *rest, to]),
    ]


def _then(clause: Clause) -> set[str]:
    """The senses of the verb that goes on after "and": take the cup *and put it there*."""
    after = connector_end(clause.text, clause.end)
    return {sense for sense, _ in verbs_at(clause.text.words, after)} if after else set()


def _is_put_somewhere(clause: Clause) -> bool:
    """Get me the cup *and leave it on the desk*: it is for me, but nobody hands it over."""
    text, after = clause.text, connector_end(clause.text, clause.end)
    ends = [end for sense, end in verbs_at(text.words, after) if sense == "put"] if after else []
    return any(text.word(n) in _IT and text.word(n + 1) in _PUT_AT for n in ends)


def _receiver(slots: Slots) -> Person | str | None:
    """Who or where to, without a preposition or with "to"."""
    scope = slots.scope
    goal = slots.take("to", "into") or slots.take_where()
    if goal and goal.phrase.noun == "pronoun" and any(c.role == "to" for c in slots.rest):
        slots.rest.append(Complement(phrases=goal.phrases))
        goal = slots.take("to", "into")
    if goal is None:
        bare = [c for c in slots.rest if c.phrases and c.role == "" and c.phrase.noun != "here"]
        person = slots.take_person("", "for") if len(bare) > 1 else slots.take_person("for")
        here = slots.take_here()
        return person or (ME if here else _there(slots) or _bare_spot(slots))
    if is_person(goal.phrase, scope) or goal.phrase.noun in ("operator", "here"):
        slots.take_person("for")
        return to_person(goal.phrase, scope) if goal.phrase.noun != "here" else ME
    if goal.phrase.noun == "unknown":
        return _unknown_receiver(goal, scope)
    place = to_place(goal.phrase, scope, objects=True)
    return ME if place == OPERATOR else place


def _unknown_receiver(goal: Complement, scope: Scope) -> str:
    if goal.phrase.determiner:
        return to_place(goal.phrase, scope)
    raise NotUnderstood(f"I know no person or place called “{goal.phrase.said}”")


def _there(slots: Slots) -> str | None:
    """Bring the cup *there*, to the place spoken of."""
    there = next(
        (c for c in slots.rest if c.phrases and c.phrase.noun == "there" and c.role != "from"), None
    )
    attached = any(
        locative.of.noun == "there"
        for c in slots.rest if c.phrases and c.role == "" for locative in c.phrase.places
    )  # fmt: skip
    pointed = _points_over_there(slots.clause)
    if slots.scope.place is None and (there is not None or attached or pointed):
        raise Unclear("Where is that?")  # pointed at: to who speaks it would be "here"
    if there is not None:
        slots.rest.remove(there)
    return slots.scope.place if there is not None or pointed else None


def _points_over_there(clause: Clause) -> bool:
    """Bring it *over there*, which no complement carries."""
    words = clause.text.words
    return any(words[at : at + 2] == ["over", "there"] for at in range(clause.first, clause.end))


def _bare_spot(slots: Slots) -> str | None:
    """Bring it *kitchen*: the place to which it is to be, behind what is brought."""
    bare = [c for c in slots.rest if c.phrases and c.role == ""]
    spot = bare[-1] if len(bare) > 1 and bare[-1].phrase.name("place", "room") else None
    if spot is None or not spot.phrase.is_spot or len(spot.phrases) > 1:
        return None
    slots.rest.remove(spot)
    return to_place(spot.phrase, slots.scope)


def _near_destination(slots: Slots) -> str | None:
    """Bring the vase near the piano."""
    bare = slots.peek("")
    if bare and bare.phrase.places and bare.phrase.places[-1].how == "near":
        place = detach_place(bare.phrase)
        return to_place(place.of, slots.scope, objects=True) if place else None
    return None


def give(clause: Clause, scope: Scope) -> list[Goal]:
    """Give it to Ada; give me a plum off the tree (which is to bring)."""
    slots = Slots(clause, scope)
    _provided(slots)
    wished = scope.last.to if isinstance(scope.last, Bring) and not slots.rest else None
    to = _receiver(slots) or wished or ME  # she wants the ball. You give.
    if isinstance(to, str):
        return [_put_down(goal) for goal in bring(clause, scope)]
    bare = slots.peek("")
    seen = scope.object is not None and (scope.object.at or scope.object.relation)
    known = bool(seen) and scope.last is None
    held = bare is None or (bare.phrase.noun == "pronoun" and not known)
    objects = slots.objects(handled=True) or [scope.object or ObjectQuery(held=True)]
    at = slots.loose_place()
    slots.done()
    if held:
        return [Give(object=replace(o, at=None), to=to) for o in objects]
    return [_each(replace(o, at=o.at or at), lambda q: Bring(object=q, to=to)) for o in objects]


def _provided(slots: Slots) -> None:
    """Provide Ada *with a pencil*: she is the receiver, the pencil is what is given."""
    bare = slots.peek("")
    thing = slots.peek("with")
    if bare and thing and is_person(bare.phrase, slots.scope) and not thing.phrase.is_person:
        bare.role, thing.role = "to", ""


def _is_to_stand(clause: Clause, slots: Slots) -> bool:
    """I need the vase on the sideboard: there it is to be; "can I have" asks for it here."""
    bare = slots.peek("")
    where = bare.phrases[-1].places[-1:] if bare else []
    wishes = clause.verb.startswith(_WISHES) and not clause.with_role("for", "from")
    on = bool(where) and where[0].how in ("on", "in") and where[0].of.is_spot
    told = bare and _TOLD_WHERE.intersection(clause.text.words[bare.phrase.start : clause.end])
    if where and where[0].how is None and where[0].of.name("place"):
        return wishes and not told  # I need a screwdriver at the workbench
    definite = (
        bare is not None
        and not told
        and all(
            one.determiner == "the" or (one.count and not one.determiner) for one in bare.phrases
        )
    )
    room = on and where[0].of.name("room")
    if wishes and room and bare and bare.phrase.count == "all":
        raise Unclear(f"Shall I take them to the {room}, or bring them to you from there?")
    return wishes and on and definite and not room


def _wanted_away(clause: Clause, slots: Slots) -> str | None:
    """We need the ladder *over in the barn*: where it is to be, for one is there."""
    bare = slots.peek("")
    where = bare.phrases[-1].places[-1:] if bare and clause.verb.startswith(_WISHES) else []
    spot = where[0].of if where and where[0].how in ("on", "in", None) else None
    if bare is None or spot is None or not spot.name("room", "place"):
        return None
    said = clause.text.words[bare.phrases[-1].start : spot.start]
    links = [word for word in said[-4:] if word in _OVER]
    if not links or _TOLD_WHERE.intersection(said):
        return None
    bare.phrases[-1].places.pop()
    return to_place(spot, slots.scope)


def want(clause: Clause, scope: Scope) -> list[Goal]:
    """I want the leftmost object; can I have a drink."""
    slots = Slots(clause, scope)
    if _is_to_stand(clause, slots):
        return put(clause, scope)
    away = _wanted_away(clause, slots)
    objects = slots.objects(handled=True)
    need(objects, "What shall I bring?")
    if not away:
        slots.take_person("for")
    slots.done()
    return [_each(o, lambda q: Bring(object=q, to=away or ME)) for o in objects]


def put(clause: Clause, scope: Scope) -> list[Goal]:
    """Put the cup on the shelf; put the cup on the shelf and the plate on the table."""
    slots = Slots(clause, scope)
    bare = slots.peek("")
    if bare and len(bare.phrases) > 1 and all(p.places for p in bare.phrases):
        return _each_there(clause, bare, scope)
    if bare and len(bare.phrases) > 1 and not any(p.places for p in bare.phrases[1:]):
        bare.phrases[-1].places += bare.phrases[0].places[-1:]
        del bare.phrases[0].places[-1:]
    kept, to = _is_kept_by_somebody(clause, slots), slots.peek("to")
    if kept or (to and is_person(to.phrase, scope) and clause.sense == "put"):
        verb = "bring" if kept else clause.verb
        return bring(dataclasses.replace(clause, verb=verb), scope)
    if bare and clause.verb == "tidy" and bare.phrase.is_spot:
        raise NotUnderstood("I cannot tidy up by myself; tell me what is to go where")
    spot = _whither(clause, slots)
    if spot and spot.relation and bare and len(bare.phrases[-1].places) > 0:
        surface = bare.phrases[-1].places[-1]  # on the shelf next to the vase: the vase says where
        if surface.how in ("on", None) and surface.of.is_spot and not surface.of.name("room"):
            bare.phrases[-1].places.pop()
    objects = slots.objects(handled=True)
    if not objects and clause.sense == "drop":
        objects = [scope.object or ObjectQuery(held=True)]
    if not objects and isinstance(scope.last, Pick) and scope.object:
        objects = [scope.object]  # take the hammer from the bench and put in the box
    if not objects:
        raise Misfit("put what?")
    spot = spot or _told_otherwise(clause, scope)
    down = clause.sense == "drop" or "down" in clause.particles()
    if spot is None and clause.verb == "leave":
        return _left_there(slots, scope)
    if spot is None and not down:
        raise Unclear("Where shall I put it?" if len(objects) == 1 else "Where shall I put them?")
    if spot:
        slots.take_person("for")  # on the bar for Olga: that is on the bar
    slots.done()
    return [_each(o, lambda q: put_at(q, spot)) for o in objects]


def _left_there(slots: Slots, scope: Scope) -> list[Goal]:
    """Find the cup, *but leave it there*: nothing more; alone it is nothing at all.

    Raises:
        NotUnderstood: Nothing else was asked for.
    """
    if not isinstance(scope.last, Find | Tell):
        raise NotUnderstood("All right, I leave it as it is")
    slots.done()
    return []


def _told_otherwise(clause: Clause, scope: Scope) -> Target | None:
    """Where to, by the verb ("throw it away") or behind the order."""
    return Target(in_=_trash(scope)) if _throws(clause) else homes.home(clause, scope)


def _whither(clause: Clause, slots: Slots) -> Target | None:
    """Where something is to be put, as it is told behind an order that only says "away", or in it.

    "Get rid of the cups on the bar" tells where they are.
    """
    home = homes.home(clause, slots.scope) if homes.tidies_away(clause) else None
    if home is not None or (_disposes(clause) and not clause.with_role("to", "into")):
        return home
    return destination(slots)


def _is_kept_by_somebody(clause: Clause, slots: Slots) -> bool:
    """Leave it *with Ada*: to bring it to her; put it *for the shelf* is to put it there."""
    whither = None if slots.peek("to", "into", "at") else slots.peek("for")
    if whither and whither.phrase.is_spot and clause.sense == "put":
        whither.role = "to"
    keeper = slots.peek("with") if clause.verb in ("leave", "drop", "drop off") else None
    if keeper is None or not is_person(keeper.phrase, slots.scope):
        return False
    keeper.role = "to"
    return True


def _each_there(clause: Clause, bare: Complement, scope: Scope) -> list[Goal]:
    """One cup on the shelf and the other on the table: one after the other."""
    goals: list[Goal] = []
    for phrase in bare.phrases:
        goals += put(_alone(clause, bare, phrase), scope)
        scope.mention_goal(goals[-1])
    return goals


def swap(clause: Clause, scope: Scope) -> list[Goal]:
    """Swap the cups: no goal says that.

    Raises:
        NotUnderstood: Always; it says what can be done instead.
    """
    del clause, scope
    raise NotUnderstood("I cannot swap things in one go; tell me where to put each of them")


def clear(clause: Clause, scope: Scope) -> list[Goal]:
    """Clear the table; empty the shelf onto the counter; clear up the cups, they go on the bar."""
    slots = Slots(clause, scope)
    bare = slots.peek("")
    if bare is None or len(bare.phrases) > 1:
        raise Misfit("clear what?")
    if bare.phrase.is_spot and (of := slots.take("of")):
        return _cleared_of(slots, bare, of)
    home = None if bare.phrase.is_spot else homes.home(clause, scope)
    spot = home or destination(slots)
    if bare.phrase.is_spot:
        slots.rest.remove(bare)
        objects = [ObjectQuery(count="all", at=to_place(bare.phrase, scope))]
    else:
        objects = slots.objects(handled=True)
    if home is None and any(query.at is None for query in objects):
        raise Misfit("clear what?")
    slots.done()
    if spot is None:
        if not _then(clause):
            raise Unclear("Where shall I put what is there?")
        return [Pick(object=replace(query, count="all")) for query in objects]
    return [_each(o, lambda q: put_at(q, spot)) for o in objects]


def _cleared_of(slots: Slots, bare: Complement, of: Complement) -> list[Goal]:
    """Rid the counter *of that bottle*; clear the table *of cups*, and put them in the sink."""
    slots.rest.remove(bare)
    at = to_place(bare.phrase, slots.scope)
    queries = [to_object(phrase, slots.scope) for phrase in of.phrases]
    several = [singular(p.said.split()[-1]) != p.said.split()[-1] for p in of.phrases]
    slots.done()
    return [
        Pick(object=replace(q, at=at, count=q.count or ("all" if many else None)))
        for q, many in zip(queries, several, strict=True)
    ]


def _alone(clause: Clause, bare: Complement, phrase: NounPhrase) -> Clause:
    """The clause with one of its coordinated noun phrases."""
    one = dataclasses.replace(bare, phrases=[phrase])
    return dataclasses.replace(
        clause, complements=[one if c is bare else c for c in clause.complements]
    )


def _throws(clause: Clause) -> bool:
    return clause.verb.startswith(_THROW) or "rid" in clause.verb


def _disposes(clause: Clause) -> bool:
    """Get rid of the cups *on the table*: that is where they are."""
    bare = clause.with_role("")
    places = bare[0].phrase.places if bare else []
    return clause.verb.startswith(_DISPOSE) and not any(place.how == "in" for place in places)


def _trash(scope: Scope) -> str:
    known = scope.index.exact("trash can") or scope.index.exact("trash")
    if not known:
        raise Unclear("Where shall I throw it?")
    return known[0].name


def _each(query: ObjectQuery, goal_of: Callable[[ObjectQuery], Goal]) -> Goal:
    """The goal with an object, or once with each of all objects."""
    if query.count != "all" or query.held:
        return goal_of(query)
    one = replace(query, count=None)
    return ForEach(object=one, goals=(goal_of(ObjectQuery(held=True)),))
