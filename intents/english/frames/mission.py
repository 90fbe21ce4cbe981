"""Stopping, pausing and reporting: about the mission and the robot, not about the world."""

from intents.english.frames.slots import Slots
from intents.english.phrases.complements import Clause, Complement, first_with
from intents.english.phrases.referents import ME, Scope, to_place
from intents.english.trouble import Misfit
from intents.english.words.lexicon import words
from intents.goals import (
    Bring,
    Cancel,
    Goal,
    GoTo,
    Pause,
    Pick,
    Place,
    Report,
    ReportTopic,
    Resume,
    Stop,
    Wait,
)


def stop(clause: Clause, scope: Scope) -> list[Goal]:
    """Stop, with whatever is said after it; on the way somewhere, stop at the table."""
    if not is_stopover(clause.complements, scope):
        return [Stop()]
    slots = Slots(clause, scope)
    there = slots.take("at")
    slots.done()
    return [GoTo(place=to_place(there.phrase, scope))] if there else [Stop()]


def is_stopover(complements: list[Complement], scope: Scope) -> bool:
    """Whether to stop is to go somewhere in between: "go to the hall, and stop at the bar"."""
    there = first_with(complements, "at")
    spot = there is not None and there.phrase.is_spot and there.how in (None, "near")
    return spot and isinstance(scope.last, GoTo | Place | Bring | Pick)


def pause(clause: Clause, scope: Scope) -> list[Goal]:
    """Pause; with a duration it is to wait."""
    slots = Slots(clause, scope)
    duration = slots.measure("time")
    slots.done()
    return [Pause() if duration is None else Wait(duration_s=duration)]


def resume(clause: Clause, scope: Scope) -> list[Goal]:
    """Go on."""
    if clause.complements:
        raise Misfit("I can only go on with what I was doing")
    del scope
    return [Resume()]


_TASKS = words("task tasks mission job order command plan plans everything errand action goal")


def cancel(clause: Clause, scope: Scope) -> list[Goal]:
    """Give up the mission."""
    others = [c.phrase for c in clause.complements if c.phrases and c.phrase.noun != "pronoun"]
    if any(phrase.said.split()[-1] not in _TASKS for phrase in others):
        raise Misfit("I can only cancel what I am doing")
    del scope
    return [Cancel()]


_TOPICS: tuple[tuple[str, ReportTopic], ...] = (
    ("see", "seeing"), ("surroundings", "seeing"), ("holding", "holding"), ("health", "health"),
    ("battery", "health"), ("check", "health"), ("location", "location"),
    ("position", "location"), ("where", "location"),
)  # fmt: skip


def report(clause: Clause, scope: Scope) -> list[Goal]:
    """Report your status, your health, what you see."""
    slots = Slots(clause, scope)
    said = " ".join([clause.verb, *(c.phrase.said for c in slots.rest if c.phrases)])
    about = ("status", "health", "position", "location", "state", "battery")
    slots.rest = [c for c in slots.rest if not (c.phrases and c.phrase.said in about)]
    if (slots.take_person("to", "") or ME) != ME:
        raise Misfit("that is to tell somebody something")
    slots.done()
    topic: ReportTopic = "status"
    for word, named in reversed(_TOPICS):
        topic = named if word in said else topic
    return [Report(topic=topic)]
