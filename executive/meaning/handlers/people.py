"""Goals that are between the robot and people: signs, looks, words."""

from __future__ import annotations

from typing import get_args

from executive.meaning import answers, questions
from executive.meaning.handlers.moving import go_to_person
from executive.meaning.identify import Scene, cannot
from executive.skills.ask import AskParams
from executive.skills.gesture import GestureKind, GestureParams
from executive.skills.look import LookParams
from executive.skills.say import SayParams
from executive.trees.parts import Errand, Part, Series
from intents import goals
from robot.messages import Side


def gesture(goal: goals.Gesture, scene: Scene) -> Part:
    """Make a sign, at somebody or something if that was said."""
    words = goal.kind.replace("_", " ")
    known = [kind for kind in get_args(GestureKind) if kind == goal.kind]
    if not known:
        can = ", ".join(kind.replace("_", " ") for kind in get_args(GestureKind))
        raise cannot("unsupported", f"this robot cannot {words}", suggestion=f"it can {can}")
    side = _hand(goal.side)
    params = GestureParams(kind=known[0], side=side, **_towards(goal.at, scene))
    words += f" with the {side} hand" if side else ""
    return Errand(name=f"{words} at {goal.at}" if goal.at else words, params=params)


def _hand(said: goals.Side | None) -> Side | None:
    """The hand that is meant by a side; none by "forward"."""
    match said:
        case "left" | "right":
            return said
        case _:
            return None


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


def say(goal: goals.Say, scene: Scene) -> Part:
    """Say a text; to somebody who is known by name it is said to their face."""
    words = Errand(name=f"say {goal.what!r}", params=SayParams(text=goal.what))
    before = to_their_face(goal.to, scene)
    if goal.to is None or not before:
        return words
    return Series(name=f"tell {scene.person(goal.to).name}", parts=(*before, words))


def to_their_face(person: goals.Person | None, scene: Scene) -> tuple[Part, ...]:
    """Going up to somebody who is known by name, and looking at them, before they are told."""
    if person is None or person.name is None:
        return ()
    found = scene.person(person)
    look = Errand(name=f"look at {found.name}", params=LookParams(person_id=found.id))
    return (go_to_person(person, scene), look)


def ask(goal: goals.Ask, scene: Scene) -> Part:
    """Go to somebody, ask them, wait for the answer; and tell it to somebody else if to whom."""
    person = scene.person(goal.person)
    question = Errand(
        name=f"ask {person.name}",
        params=AskParams(text=questions.spoken(goal.what), person_id=person.id),
    )
    before = (
        go_to_person(goal.person, scene),
        Errand(name=f"look at {person.name}", params=LookParams(person_id=person.id)),
    )
    if goal.to is None:
        return Series(name=f"ask {person.name}", parts=(*before, question))
    back = to_their_face(goal.to, scene) or (go_to_person(goal.to, scene),)
    tell = Errand(name="say the answer", params=answers.answered(person, goal.what))
    parts = (*before, question, *back, tell)
    return Series(name=f"ask {person.name} and tell the answer", parts=parts)


def greet(goal: goals.Greet, scene: Scene) -> Part:
    """Say hello, to somebody's face if it was said to whom."""
    if goal.person == goals.Person():
        return Errand(name="say hello", params=SayParams(text="Hello."))
    found = scene.person(goal.person)
    way = (go_to_person(goal.person, scene),) if goal.person.name is not None else ()
    parts = (
        *way,
        Errand(name=f"look at {found.name}", params=LookParams(person_id=found.id)),
        Errand(name="say hello", params=SayParams(text=f"Hello, {found.name}.")),
    )
    return Series(name=f"greet {found.name}", parts=parts)


def meet(goal: goals.Meet, scene: Scene) -> Part:
    """Walk up to somebody and say hello."""
    hello = greet(goals.Greet(person=goal.person), scene)
    if goal.person.name is not None:  # greeting them goes there
        return hello
    return Series(name="meet somebody", parts=(go_to_person(goal.person, scene), hello))
