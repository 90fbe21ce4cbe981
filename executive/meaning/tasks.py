"""Goals to a task: what they mean here, as steps of skills, and the tree of those steps.

A goal is first turned into a `Part`, a plain value that can be checked and shown before anything
moves (`executive.trees.parts`); `executive.trees.build` makes the tree of it. `HANDLERS` says, goal
by goal, what it takes: `executive.meaning.handlers` has the functions, a file a family of goals;
those that are made of other goals are here.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from typing import Any

import msgspec

from executive.behaviours.conditions import Predicate
from executive.meaning import answers
from executive.meaning.handlers import handling, moving, people, seeing, steps
from executive.meaning.handlers.settling import counted, settle
from executive.meaning.identify import Scene, Unsettled, cannot
from executive.meaning.in_here import without_here
from executive.meaning.knowledge import Knowledge
from executive.meaning.staying import with_an_end
from executive.meaning.stopovers import without_stopovers
from executive.meaning.telling_where import told_where
from executive.skills.pick import PickParams
from executive.trees.parts import Branch, Errand, Kept, Part, Series, errands
from intents import goals
from intents.grounding import describe
from robot.messages import ObjectInfo

MAX_TIMES, MAX_STEPS = 50, 500


def understand(asked: Iterable[goals.Goal], scene: Scene) -> Series:
    """What it takes to do the goals, in their order.

    Raises:
        CannotMean: if one of them has no meaning here, or no skill does it.
    """
    parts = sequence(told_where(with_an_end(without_here(asked))), scene)
    if not parts:
        raise cannot("invalid_goal", "there is nothing to do")
    task = Series(name="task", parts=(*parts, *last_look(parts, scene.knowledge)))
    count = sum(1 for _ in errands(task))
    if count > MAX_STEPS:
        raise cannot("invalid_goal", f"that would be {count} steps, at most {MAX_STEPS}")
    return task


def last_look(parts: tuple[Part, ...], knowledge: Knowledge) -> tuple[Part, ...]:
    """What compares, after parts that take or put down, what was done with what is believed."""
    handles = any(
        errand.carries or isinstance(errand.params, PickParams)
        for errand in errands(Series(name="task", parts=parts))
    )
    return (Kept(name="all is as it was left", gone=answers.gone(knowledge)),) if handles else ()


def sequence(asked: tuple[goals.Goal, ...], scene: Scene) -> tuple[Part, ...]:
    """What it takes to do goals in their order.

    From the first one on of which it has to be seen what it means, they are one part: what is
    settled then holds for all that follow.

    Raises:
        CannotMean: if one of them has no meaning here, or no skill does it.
    """
    parts: list[Part] = []
    asked = without_stopovers(asked, scene.knowledge)
    for number, goal in enumerate(asked):
        held, spoken_of = list(scene.held), scene.spoken_of
        try:
            parts.append(part_of(goal, scene))
        except Unsettled as end:
            scene.held, scene.spoken_of = held, spoken_of
            return (*parts, _settled(end.query, asked[number:], scene))
    return tuple(parts)


def _settled(query: goals.ObjectQuery, rest: tuple[goals.Goal, ...], scene: Scene) -> Part:
    return settle(query, scene, lambda inner: sequence(rest, inner))


def part_of(goal: goals.Goal, scene: Scene) -> Part:
    """What it takes to do one goal.

    Raises:
        Unsettled: if it has to be seen which things it is about.
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


# --- goals made of goals --------------------------------------------------------------------------


def _repeat(goal: goals.Repeat, scene: Scene) -> Part:
    if not 1 <= goal.times <= MAX_TIMES:
        raise cannot("invalid_goal", f"repeat {goal.times} times: 1 to {MAX_TIMES} are possible")
    parts = tuple(
        Series(name=f"round {n + 1}", parts=sequence(goal.goals, scene)) for n in range(goal.times)
    )
    return Series(name=f"{goal.times} times", parts=parts)


def _for_each(goal: goals.ForEach, scene: Scene) -> Part:
    asked = _without_taking(goal.goals)

    def one(info: ObjectInfo) -> Part:
        scene.spoken_of = info.id
        in_turn = tuple(_with_id(child, info) for child in asked)
        return Series(name=f"with {info.full_name}", parts=sequence(in_turn, scene))

    match asked:
        case (goals.Place(on=str(to)) | goals.Place(in_=str(to)) | goals.Bring(to=str(to)),):
            return handling.put_several(goal.object, to, scene, one)
        case _:
            return steps.several(scene.objects(goal.object), "for each", one)


def _without_taking(asked: tuple[goals.Goal, ...]) -> tuple[goals.Goal, ...]:
    """The goals of each round without taking "it" before it is put, brought or given: they do.

    "Collect the books and put them on the shelf" leaves those alone that are there already.
    """
    match asked:
        case (
            goals.Pick(object=goals.ObjectQuery(held=True)),
            goals.Place(object=goals.ObjectQuery(held=True))
            | goals.Bring(object=goals.ObjectQuery(held=True))
            | goals.Give(object=goals.ObjectQuery(held=True)),
            *_,
        ):
            return asked[1:]
        case _:
            return asked


def _with_id(goal: goals.Goal, info: ObjectInfo) -> goals.Goal:
    """The goal with the object of this round in the place of "it"."""
    query = getattr(goal, "object", None)
    if isinstance(query, goals.ObjectQuery) and query.held:
        named = goals.ObjectQuery(name=info.id, at=query.at)
        return msgspec.structs.replace(goal, object=named)
    return goal


def _if(goal: goals.If, scene: Scene) -> Part:
    held, cases = list(scene.held), _cases(goal, scene)
    look = in_turn(look_of(goal.condition, scene))
    branch: Part = Series(name="else", parts=sequence(goal.else_, scene))
    common = list(scene.held)
    for n, case in reversed(list(enumerate(cases))):
        scene.held = list(held)
        question = question_of(case.condition, scene)
        then = Series(name="then", parts=sequence(case.then, scene))
        common = [object_id for object_id in common if object_id in scene.held]
        branch = Branch(
            name="if", question=question, then=then, otherwise=branch, look=None if n else look
        )
    scene.held = common
    return branch


def _cases(goal: goals.If, scene: Scene) -> list[goals.If]:
    """The condition for each thing that "a mug" may turn out to be, what is done being about it.

    Only if what is done is about that thing at all, which cannot be known before it was looked.
    """
    for condition in goals.simple_conditions(goal.condition):
        cases = _cases_of(condition, goal, scene)
        if len(cases) > 1:
            return cases
    return [goal]


def _cases_of(condition: goals.Simple, goal: goals.If, scene: Scene) -> list[goals.If]:
    said = condition.object if isinstance(condition, goals.Present) else None
    if said is None or condition.negated or said.count not in (None, 1):
        return [goal]
    same = (said, msgspec.structs.replace(said, at=None))
    spoken_of = any(getattr(child, "object", None) in same for child in goals.each(goal.then))
    found = scene.fitting(said) if spoken_of else []
    if len(found) < 2:
        return [goal]
    return [
        msgspec.structs.replace(
            goal,
            condition=_in_place(goal.condition, said, info),
            then=tuple(_about(child, same, info) for child in goal.then),
        )
        for info in found
    ]


def _in_place(
    condition: goals.Condition, said: goals.ObjectQuery, info: ObjectInfo
) -> goals.Condition:
    """A condition with one object in the place of its description."""
    if isinstance(condition, goals.AllOf | goals.AnyOf):
        inner = tuple(_in_place(one, said, info) for one in condition.of)
        return msgspec.structs.replace(condition, of=inner)
    if not isinstance(condition, goals.Present) or condition.object is None:
        return condition
    if msgspec.structs.replace(condition.object, at=None) != msgspec.structs.replace(said, at=None):
        return condition
    return msgspec.structs.replace(condition, object=_named(condition.object, info))


def _about(goal: goals.Goal, same: Collection[goals.ObjectQuery], info: ObjectInfo) -> goals.Goal:
    """A goal, and those inside it, with one object in the place of its description."""
    slots: dict[str, object] = {
        slot: tuple(_about(child, same, info) for child in getattr(goal, slot))
        for slot in ("goals", "then", "else_")
        if hasattr(goal, slot)
    }
    query = getattr(goal, "object", None)
    if isinstance(query, goals.ObjectQuery) and query in same:
        slots["object"] = goals.ObjectQuery(name=info.id)  # it was just seen where it is
    return msgspec.structs.replace(goal, **slots)


def _named(query: goals.ObjectQuery, info: ObjectInfo) -> goals.ObjectQuery:
    return goals.ObjectQuery(name=info.id, at=query.at)


def question_of(condition: goals.Condition, scene: Scene) -> Predicate:
    """The question to ask for a condition when its turn comes.

    Raises:
        CannotMean: if it has no meaning here, or this robot cannot find that out.
    """
    if isinstance(condition, goals.AllOf | goals.AnyOf):
        join = all if isinstance(condition, goals.AllOf) else any
        each = [question_of(one, scene) for one in condition.of]
        return lambda board: join(question(board) for question in each)
    if isinstance(condition, goals.State) or condition.object is None:
        raise cannot("unsupported", "this robot cannot find that out yet",
                     suggestion="ask whether an object is there, or held")  # fmt: skip
    if condition.object.superlative is not None:
        raise cannot("unsupported", f"which is the {describe(condition.object)} is not known yet",
                     suggestion="name it by its colour")  # fmt: skip
    ids = frozenset(info.id for info in scene.fitting(condition.object))
    at = condition.object.at
    places = steps.to_look_over(scene.places(at), scene) if at else ()
    holding = isinstance(condition, goals.Holding)
    least = len(ids) if condition.object.count == "all" else condition.object.count or 1
    if condition.object.relation is not None and not holding:
        _, number_of = counted(condition.object, scene)
        return lambda board: (number_of(board) >= least) != condition.negated
    known = (
        answers.is_held(ids, least=least) if holding else answers.is_there(ids, places, least=least)
    )
    return (lambda board: not known(board)) if condition.negated else known


def look_of(condition: goals.Condition, scene: Scene) -> tuple[Part, ...]:
    """What has to be looked at to decide a condition, if anything has.

    That nothing was seen where nobody looked is no reason for the other branch.
    """
    if isinstance(condition, goals.AllOf | goals.AnyOf):
        return tuple(look for one in condition.of for look in look_of(one, scene))
    if not isinstance(condition, goals.Present) or condition.object is None:
        return ()
    at, ids = condition.object.at, [info.id for info in scene.fitting(condition.object)]
    name = f"look over the {at}" if at else "look around"
    if condition.object.relation is not None:
        looks, _ = counted(condition.object, scene)
        return looks
    if steps.many(condition.object):  # the first that is seen decides nothing
        least = len(ids) if condition.object.count == "all" else condition.object.count
        return steps.inspect(name, at, scene, about=ids, least=least)
    return steps.inspect(name, at, scene, ids=ids) if ids else ()


def in_turn(looks: tuple[Part, ...]) -> Part | None:
    """Looks one after the other; None if there are none."""
    if len(looks) < 2:
        return looks[0] if looks else None
    return Series(name="look", parts=looks)


def _report(goal: goals.Report, scene: Scene) -> Part:
    """Say something of the robot itself; `SKILLS` is what it can do."""
    says = answers.report(goal.topic, scene.knowledge, skills=SKILLS)
    return Errand(name=f"report {goal.topic}", params=says)


Handler = Callable[[Any, Scene], Part]

HANDLERS: dict[type[Any], Handler] = {
    goals.GoTo: moving.go_to,
    goals.Find: seeing.find,
    goals.Pick: handling.pick,
    goals.Place: handling.place,
    goals.Bring: handling.bring,
    goals.Give: handling.give,
    goals.Follow: moving.follow,
    goals.Gesture: people.gesture,
    goals.Greet: people.greet,
    goals.Ask: people.ask,
    goals.Meet: people.meet,
    goals.Say: people.say,
    goals.Count: seeing.count,
    goals.Tell: seeing.tell,
    goals.LookAt: seeing.look_at,
    goals.Balance: moving.balance,
    goals.Wait: moving.wait,
    goals.Stop: moving.stop,
    goals.Cancel: moving.stop,
    goals.Report: _report,
    goals.Repeat: _repeat,
    goals.ForEach: _for_each,
    goals.If: _if,
}
"""What each kind of goal takes. One that is not here is refused as unsupported."""

SKILLS: frozenset[str] = frozenset(kind.__struct_config__.tag for kind in HANDLERS)
"""The types of goals that there are handlers for."""

_MISSING: dict[type[Any], str] = {
    goals.Guide: "this robot cannot guide people yet",
    goals.Open: "this robot cannot open things yet",
    goals.Close: "this robot cannot close things yet",
    goals.Switch: "this robot cannot switch things yet",
    goals.Answer: "this robot cannot answer questions yet",
    goals.Pause: "there is nothing to pause before it has begun",
    goals.Resume: "there is nothing to go on with",
}
