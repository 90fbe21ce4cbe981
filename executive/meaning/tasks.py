"""Goals to a task: what they mean here, as steps of skills, and the tree of those steps.

A goal is first turned into a `Part`, a plain value that can be checked and shown before anything
moves (`executive.trees.parts`); `executive.trees.build` makes the tree of it. `HANDLERS` says, goal
by goal, what it takes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, get_args

import msgspec

from executive.behaviours.conditions import Predicate
from executive.meaning import answers
from executive.meaning.identify import Scene, cannot
from executive.meaning.knowledge import full_name
from executive.skills.parameters import (
    BalanceParams,
    FloorPose,
    FollowParams,
    GestureKind,
    GestureParams,
    GiveParams,
    LookParams,
    NavigateParams,
    PickParams,
    PlaceParams,
    SayParams,
    SearchParams,
    SkillParams,
    Step,
    StopParams,
    WaitParams,
)
from executive.trees.parts import Branch, Errand, Part, Series, errands
from intents import goals
from robot.messages import ObjectInfo, Place

MAX_TIMES, MAX_STEPS = 50, 500
AROUND = "around"


def understand(asked: Iterable[goals.Goal], scene: Scene) -> Series:
    """What it takes to do the goals, in their order.

    Raises:
        CannotMean: if one of them has no meaning here, or no skill does it.
    """
    parts = tuple(part_of(goal, scene) for goal in asked)
    if not parts:
        raise cannot("invalid_goal", "there is nothing to do")
    task = Series(name="task", parts=parts)
    count = sum(1 for _ in errands(task))
    if count > MAX_STEPS:
        raise cannot("invalid_goal", f"that would be {count} steps, at most {MAX_STEPS}")
    return task


def part_of(goal: goals.Goal, scene: Scene) -> Part:
    """What it takes to do one goal.

    Raises:
        CannotMean: if it has no meaning here, or no skill does it.
    """
    handler = HANDLERS.get(type(goal))
    name = type(goal).__name__.lower()
    if handler is None:
        raise cannot("unsupported", _MISSING.get(type(goal), f"this robot cannot {name} yet"))
    try:
        return handler(goal, scene)
    except ValueError as error:  # the parameters check their ranges
        raise cannot("invalid_goal", f"{name}: {error}") from None


# --- moving -------------------------------------------------------------------------------------


def _go_to(goal: goals.GoTo, scene: Scene) -> Part:
    if goal.by is not None:
        by = goal.by
        step = Step(
            forward_m=by.forward_m or 0.0, left_m=by.left_m or 0.0, turn_rad=by.turn_rad or 0.0
        )
        return Errand(name=_walk_words(step), params=NavigateParams(by=step))
    if goal.pose is not None:
        pose = FloorPose(x_m=goal.pose.x_m, y_m=goal.pose.y_m, yaw_rad=goal.pose.yaw_rad)
        name = f"go to ({pose.x_m:.2f}, {pose.y_m:.2f})"
        return Errand(name=name, params=NavigateParams(pose=pose))
    if goal.place is None:
        raise cannot("invalid_goal", "go where?", suggestion="name a place")
    if goal.place == goals.OPERATOR:
        return _go_to_person(goals.Person(who="operator"), scene)
    person = scene.knowledge.person(goal.place)
    if person is not None and not scene.knowledge.places(goal.place):
        return _go_to_person(goals.Person(name=goal.place), scene)
    place = scene.places(goal.place)[0]
    return Errand(name=f"go to the {goal.place}", params=NavigateParams(place_id=place.id))


def _walk_words(step: Step) -> str:
    words = [
        f"{abs(step.forward_m):.2g} m {'forward' if step.forward_m > 0 else 'back'}"
        if step.forward_m else "",
        f"{abs(step.left_m):.2g} m {'left' if step.left_m > 0 else 'right'}" if step.left_m else "",
    ]  # fmt: skip
    walk = " and ".join(word for word in words if word)
    turn = "turn " + ("left" if step.turn_rad > 0 else "right") if step.turn_rad else ""
    return ", ".join(word for word in (turn, f"walk {walk}" if walk else "") if word) or "stay"


def _go_to_person(person: goals.Person, scene: Scene) -> Errand:
    found = scene.person(person)
    return Errand(name=f"go to {found.name}", params=NavigateParams(person_id=found.id))


def _follow(goal: goals.Follow, scene: Scene) -> Part:
    person = scene.person(goal.person)
    place = scene.places(goal.to)[0] if goal.to else None
    params = FollowParams(person_id=person.id, place_id=place.id if place else None)
    return Errand(name=f"follow {person.name}", params=params)


def _gesture(goal: goals.Gesture, scene: Scene) -> Part:
    words = goal.kind.replace("_", " ")
    known = [kind for kind in get_args(GestureKind) if kind == goal.kind]
    if not known:
        can = ", ".join(kind.replace("_", " ") for kind in get_args(GestureKind))
        raise cannot("unsupported", f"this robot cannot {words}", suggestion=f"it can {can}")
    params = GestureParams(kind=known[0], **_towards(goal.at, scene))
    return Errand(name=f"{words} at {goal.at}" if goal.at else words, params=params)


def _towards(name: str | None, scene: Scene) -> dict[str, str]:
    """What a gesture is for: a person, a place or an object, by its name."""
    if name is None:
        return {}
    person = scene.knowledge.person(name)
    if person is not None or name == goals.OPERATOR:
        return {"person_id": (person or scene.person(goals.Person(who="operator"))).id}
    if scene.knowledge.places(name):
        return {"place_id": scene.places(name)[0].id}
    *color, noun = name.split(maxsplit=1)
    query = goals.ObjectQuery(name=noun, color=color[0] if color else None)
    return {"object_id": scene.object(query).id}


def _look_at(goal: goals.LookAt, scene: Scene) -> Part:
    if goal.place == AROUND:
        return Errand(name="look around", params=LookParams(around=True))
    if goal.object is not None:
        info = scene.object(goal.object)
        params = SearchParams(object_id=info.id)  # it ends with the object in sight
        return _about(info, f"look at {full_name(info)}", params)
    if goal.person is not None:
        found = scene.person(goal.person)
        return Errand(name=f"look at {found.name}", params=LookParams(person_id=found.id))
    if goal.place is None:
        raise cannot("invalid_goal", "look at what?", suggestion="name an object or a place")
    place = scene.places(goal.place)[0]
    return Errand(name=f"look at the {goal.place}", params=LookParams(place_id=place.id))


def _balance(goal: goals.Balance, _scene: Scene) -> Part:
    if goal.mode == "sit":
        raise cannot("unsupported", "this robot cannot sit down yet", suggestion="let it squat")
    duration_s = 3.0 if goal.duration_s is None else goal.duration_s
    rises = goal.mode == "stand" and goal.duration_s is None  # "get up", "stand up"
    mode = "get_up" if rises else goal.mode
    params = BalanceParams(mode=mode, side=goal.side, duration_s=duration_s)
    words = {"stand": "stand", "squat": "squat", "one_leg": "stand on one leg", "lean": "lean"}
    return Errand(name=f"{words[goal.mode]} for {duration_s:g} s", params=params)


def _wait(goal: goals.Wait, _scene: Scene) -> Part:
    if goal.duration_s is None:
        raise cannot("invalid_goal", "wait for how long?", suggestion="say 'wait ten seconds'")
    params = WaitParams(duration_s=goal.duration_s)
    return Errand(name=f"wait {goal.duration_s:g} s", params=params)


def _stop(_goal: goals.Goal, _scene: Scene) -> Part:
    return Errand(name="come to a stand", params=StopParams())


# --- objects ------------------------------------------------------------------------------------


def _about(info: ObjectInfo, name: str, params: SkillParams, *, carries: bool = False) -> Errand:
    """A step that is about an object."""
    return Errand(
        name=name, params=params, object_id=info.id, object_name=full_name(info), carries=carries
    )


def _find(goal: goals.Find, scene: Scene) -> Part:
    if goal.object is not None:
        return _search(scene.object(goal.object), goal.object, scene)
    if goal.person is None:
        raise cannot("invalid_goal", "find what?", suggestion="name an object")
    found = scene.person(goal.person)
    look = Errand(name=f"look at {found.name}", params=LookParams(person_id=found.id))
    return Series(name=f"find {found.name}", parts=(_go_to_person(goal.person, scene), look))


def _search(info: ObjectInfo, query: goals.ObjectQuery, scene: Scene) -> Errand:
    """Look for an object, at the place that was said."""
    places = _surfaces(scene.places(query.at)) if query.at else ()
    params = SearchParams(object_id=info.id, place_ids=tuple(place.id for place in places))
    return _about(info, f"find {full_name(info)}", params)


def _surfaces(places: tuple[Place, ...]) -> tuple[Place, ...]:
    """The places that things stand on; a room says nothing about where in it."""
    return tuple(place for place in places if not place.floor)


def _pick(goal: goals.Pick, scene: Scene) -> Part:
    if goal.object.count not in (None, 1):
        found = scene.objects(goal.object)
        parts = tuple(_pick_one(info, goal.object, scene) for info in found)
        return Series(name="pick up several things", parts=parts)
    return _pick_one(scene.object(goal.object), goal.object, scene)


def _pick_one(info: ObjectInfo, query: goals.ObjectQuery, scene: Scene) -> Part:
    scene.take(info.id)
    name = full_name(info)
    pick = _about(info, f"pick up {name}", PickParams(object_id=info.id))
    if query.at is None:  # picking begins with looking for it everywhere
        return pick
    return Series(name=f"take {name}", parts=(_search(info, query, scene), pick))


def _place(goal: goals.Place, scene: Scene) -> Part:
    info = scene.object(goal.object)
    target = goal.on or goal.in_
    if target is None:
        raise cannot("invalid_goal", f"put {full_name(info)} where?", suggestion="name a place")
    return _put(info, goal.object, target, scene)


def _give(goal: goals.Give, scene: Scene) -> Part:
    return _hand_over(goal.object, goal.to, scene)


def _hand_over(query: goals.ObjectQuery, to: goals.Person, scene: Scene) -> Part:
    """Give an object to a person, after fetching it unless it is in the hand by then."""
    info, person = scene.object(query), scene.person(to)
    name, in_hand = full_name(info), info.id in scene.held
    fetch = None if in_hand else _pick_one(info, query, scene)
    scene.put_down(info.id)
    params = GiveParams(object_id=info.id, person_id=person.id)
    give = _about(info, f"give {name} to {person.name}", params, carries=True)
    if fetch is None:
        return give
    return Series(name=f"bring {name} to {person.name}", parts=(fetch, give))


def _bring(goal: goals.Bring, scene: Scene) -> Part:
    if isinstance(goal.to, goals.Person):
        return _hand_over(goal.object, goal.to, scene)
    if goal.object.count not in (None, 1):
        found = scene.objects(goal.object)
        parts = [_put(info, goal.object, goal.to, scene) for info in found]
        return Series(name=f"bring several things to the {goal.to}", parts=tuple(parts))
    return _put(scene.object(goal.object), goal.object, goal.to, scene)


def _put(info: ObjectInfo, query: goals.ObjectQuery, target: str, scene: Scene) -> Part:
    """Put an object on a place, after fetching it unless it is in the hand by then."""
    place = _best_surface(info, target, scene)
    name = full_name(info)
    params = PlaceParams(object_id=info.id, place_id=place.id)
    put = _about(info, f"put {name} on the {place.name}", params, carries=True)
    if info.id in scene.held:
        scene.put_down(info.id)
        return put
    fetch = _pick_one(info, query, scene)
    scene.put_down(info.id)
    return Series(name=f"bring {name} to the {target}", parts=(fetch, put))


COMFORTABLE_HEIGHT_M = 0.8


def _best_surface(info: ObjectInfo, target: str, scene: Scene) -> Place:
    """Of the surfaces of that name the one that is easiest to reach and high enough."""
    surfaces = _surfaces(scene.places(target))
    if not surfaces:
        text = f"nothing can be put down in the {target}"
        raise cannot("invalid_goal", text, suggestion="name a table or a shelf")
    height_m = info.shape.size_m[2]
    free = [place for place in surfaces if place.clearance_m > height_m + 0.03]
    if not free:
        text = f"{full_name(info)} is {height_m:.2f} m high and does not fit there"
        raise cannot("no_free_spot", text, clearance_m=surfaces[0].clearance_m)
    return min(free, key=lambda place: abs(place.X_WP.p[2] - COMFORTABLE_HEIGHT_M))


# --- words --------------------------------------------------------------------------------------


def _say(goal: goals.Say, _scene: Scene) -> Part:
    return Errand(name=f"say {goal.what!r}", params=SayParams(text=goal.what))


def _greet(goal: goals.Greet, scene: Scene) -> Part:
    if goal.person == goals.Person():
        return Errand(name="say hello", params=SayParams(text="Hello."))
    found = scene.person(goal.person)
    parts = (
        Errand(name=f"look at {found.name}", params=LookParams(person_id=found.id)),
        Errand(name="say hello", params=SayParams(text=f"Hello, {found.name}.")),
    )
    return Series(name=f"greet {found.name}", parts=parts)


def _meet(goal: goals.Meet, scene: Scene) -> Part:
    approach = _go_to_person(goal.person, scene)
    greet = _greet(goals.Greet(person=goal.person), scene)
    return Series(name="meet somebody", parts=(approach, greet))


def _count(goal: goals.Count, scene: Scene) -> Part:
    if goal.object is None:
        raise cannot("unsupported", "this robot cannot count people yet")
    ids = frozenset(info.id for info in scene.fitting(goal.object))
    query = goal.object
    places = _surfaces(scene.places(query.at)) if query.at else ()
    looks = tuple(_visit(place) for place in places)
    noun = query.name or query.category or "object"
    tell = Errand(name="say how many", params=answers.count(ids, places, noun=noun))
    return Series(name=f"count the {noun}s", parts=(*looks, tell))


def _visit(place: Place) -> Series:
    parts = (
        Errand(name=f"go to the {place.name}", params=NavigateParams(place_id=place.id)),
        Errand(name=f"look at the {place.name}", params=LookParams(place_id=place.id)),
    )
    return Series(name=f"inspect the {place.name}", parts=parts)


def _report(goal: goals.Report, scene: Scene) -> Part:
    return Errand(name=f"report {goal.topic}", params=answers.report(goal.topic, scene.knowledge))


# --- structure ----------------------------------------------------------------------------------


def _repeat(goal: goals.Repeat, scene: Scene) -> Part:
    if not 1 <= goal.times <= MAX_TIMES:
        raise cannot("invalid_goal", f"repeat {goal.times} times: 1 to {MAX_TIMES} are possible")
    parts = tuple(
        Series(name=f"round {n + 1}", parts=tuple(part_of(child, scene) for child in goal.goals))
        for n in range(goal.times)
    )
    return Series(name=f"{goal.times} times", parts=parts)


def _for_each(goal: goals.ForEach, scene: Scene) -> Part:
    found = scene.objects(goal.object)
    rounds: list[Part] = []
    for info in found:
        scene.spoken_of = info.id
        parts = tuple(part_of(_with_id(child, info), scene) for child in goal.goals)
        rounds.append(Series(name=f"with {full_name(info)}", parts=parts))
    return Series(name="for each", parts=tuple(rounds))


def _with_id(goal: goals.Goal, info: ObjectInfo) -> goals.Goal:
    """The goal with the object of this round in the place of "it"."""
    query = getattr(goal, "object", None)
    if isinstance(query, goals.ObjectQuery) and query.held:
        named = goals.ObjectQuery(name=info.id, at=query.at)
        return msgspec.structs.replace(goal, object=named)
    return goal


def _if(goal: goals.If, scene: Scene) -> Part:
    question = question_of(goal.condition, scene)
    held = list(scene.held)
    then = Series(name="then", parts=tuple(part_of(child, scene) for child in goal.then))
    after = list(scene.held)
    scene.held = held
    otherwise = Series(name="else", parts=tuple(part_of(child, scene) for child in goal.else_))
    scene.held = [object_id for object_id in after if object_id in scene.held]
    return Branch(name="if", question=question, then=then, otherwise=otherwise)


def question_of(condition: goals.Condition, scene: Scene) -> Predicate:
    """The question to ask for a condition when its turn comes.

    Raises:
        CannotMean: if it has no meaning here, or this robot cannot find that out.
    """
    if isinstance(condition, goals.State) or condition.object is None:
        raise cannot("unsupported", "this robot cannot find that out yet",
                     suggestion="ask whether an object is there, or held")  # fmt: skip
    ids = frozenset(info.id for info in scene.fitting(condition.object))
    at = condition.object.at
    places = _surfaces(scene.places(at)) if at else ()
    holding = isinstance(condition, goals.Holding)
    known = answers.is_held(ids) if holding else answers.is_there(ids, places)
    return (lambda board: not known(board)) if condition.negated else known


Handler = Callable[[Any, Scene], Part]

HANDLERS: dict[type[Any], Handler] = {
    goals.GoTo: _go_to,
    goals.Find: _find,
    goals.Pick: _pick,
    goals.Place: _place,
    goals.Bring: _bring,
    goals.Give: _give,
    goals.Follow: _follow,
    goals.Gesture: _gesture,
    goals.Greet: _greet,
    goals.Meet: _meet,
    goals.Say: _say,
    goals.Count: _count,
    goals.LookAt: _look_at,
    goals.Balance: _balance,
    goals.Wait: _wait,
    goals.Stop: _stop,
    goals.Cancel: _stop,
    goals.Report: _report,
    goals.Repeat: _repeat,
    goals.ForEach: _for_each,
    goals.If: _if,
}
"""What each kind of goal takes. One that is not here is refused as unsupported."""

_MISSING: dict[type[Any], str] = {
    goals.Guide: "this robot cannot guide people yet",
    goals.Open: "this robot cannot open things yet",
    goals.Close: "this robot cannot close things yet",
    goals.Switch: "this robot cannot switch things yet",
    goals.Answer: "this robot cannot answer questions yet",
    goals.Tell: "this robot cannot find that out yet",
    goals.Pause: "there is nothing to pause before it has begun",
    goals.Resume: "there is nothing to go on with",
}
