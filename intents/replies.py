"""Answers to questions about the robot and what it knows, from its state alone."""

import math
from collections.abc import Callable

from msgspec.structs import replace

from intents.english.trouble import listing
from intents.english.words.lexer import tokenize
from intents.goals import ObjectQuery, ReportTopic, Tell
from intents.grounding import Entity, Grounded, describe, describe_entity, ground
from intents.state import RobotState
from intents.wording import sentence_case

_SKILLS = (
    ("go_to", "go somewhere", "go to the kitchen"),
    ("pick", "pick things up", "pick up the red cup"),
    ("place", "put things down", "put it on the shelf"),
    ("bring", "bring things", "bring me the bottle"),
    ("find", "look for things and people", "look for the bottle"),
    ("look_at", "look at something", "look at the table"),
    ("count", "count things", "count the cups on the table"),
    ("follow", "follow people", "follow me"),
    ("guide", "guide people", "guide Ada to the door"),
    ("gesture", "make gestures", "wave"),
    ("balance", "hold postures", "stand on one leg for five seconds"),
    ("say", "speak", "say hello"),
    ("open", "open doors and drawers", "open the drawer"),
    ("switch", "switch devices", "switch on the lamp"),
)


def report(topic: ReportTopic, state: RobotState) -> str:
    """The answer to a question about the robot itself."""
    return _REPORTS[topic](state)


def courtesy(text: str) -> str | None:
    """The answer to words that only are polite; None if there is more in them."""
    said = " ".join(t.text for t in tokenize(text) if t.text.isalpha())
    return _COURTESIES.get(said.removesuffix(" robot"))


def told(goal: Tell, state: RobotState) -> str | None:
    """What is known of the things asked about; None if that is not known."""
    query = goal.object
    if query is None or (goal.to is not None and goal.to.who is None):
        return None
    known = [e for e in state.entities if query.at is None or (_spot(e) and not e.held)]
    found = ground(replace(query, count="all"), known, view=state.view) if known else None
    if found is None:
        return None
    if not isinstance(found, Grounded):
        kind = describe(replace(query, at=None)) if query.name or query.category else ""
        sought = f"no {kind}" if kind else "nothing"
        return f"I have seen {sought} at the {query.at}." if query.at else None
    things = [e for e in known if e.id in found.ids]
    if goal.property == "name":
        return f"{sentence_case(listing([_name(e) for e in things], 'and'))}."
    says = _PROPERTIES.get(goal.property)
    parts = [f"{_name(e)} {said}" for e in things if says and (said := says(e))]
    return f"{sentence_case(listing(parts, 'and'))}." if len(parts) == len(things) else None


def _extent(entity: Entity) -> str:
    x, y, z = (f"{100 * metres:.0f}" for metres in entity.size_m or ())
    return f"is {x} by {y} by {z} cm"


_PROPERTIES: dict[str, Callable[[Entity], str]] = {
    "color": lambda e: f"is {e.color}" if e.color else "",
    "weight": lambda e: f"weighs {1000 * e.mass_kg:.0f} g" if e.mass_kg else "",
    "size": lambda e: _extent(e) if e.size_m else "",
    "height": lambda e: f"is {100 * e.size_m[2]:.0f} cm high" if e.size_m else "",
    "location": lambda e: f"is {_spot(e)}" if _spot(e) else "",
}
"""What can be said of a thing, as the rest of a sentence; empty where it is not known."""
_COURTESIES = {
    said: answer
    for answer, texts in (
        ("You are welcome.", "thanks,thank you,thank you very much,many thanks,thanks a lot"),
        ("Thank you.", "well done,good job,great,nice,very good,good robot,great job,nice work,"
                       "that was great,excellent,perfect,good,wonderful,thanks that was great"),
        ("Goodbye.", "bye,goodbye,good bye,bye bye,see you,see you later,good night"),
    )
    for said in texts.split(",")
}  # fmt: skip


def where(query: ObjectQuery, state: RobotState) -> str | None:
    """Where something is; None if that is not known, or nothing of the kind."""
    found = _where(query, state)
    elsewhere = _where(replace(query, at=None), state) if query.at and not found else None
    return found or (f"No: {elsewhere[0].lower()}{elsewhere[1:]}" if elsewhere else None)


def _where(query: ObjectQuery, state: RobotState) -> str | None:
    everywhere = ground(_placeless(query), state.entities, view=state.view)
    ids = everywhere.ids if isinstance(everywhere, Grounded) else getattr(
        everywhere, "candidates", ()
    )  # fmt: skip
    known = [e for e in state.entities if e.id in ids]
    told = [said for e in known if (said := _whereabouts(e))]
    return f"{sentence_case(listing(told, 'and'))}." if told else None


def _placeless(query: ObjectQuery) -> ObjectQuery:
    return ObjectQuery(
        name=query.name, category=query.category, color=query.color, size=query.size,
        superlative=query.superlative, held=query.held, relation=query.relation, at=query.at,
    )  # fmt: skip


def unknown_place(query: ObjectQuery) -> str:
    """The question to put where it is not known where something is."""
    return f"I do not know where the {describe(query)} is. Shall I look for it?"


def _whereabouts(entity: Entity) -> str:
    """That somebody has it, or where it is; empty if that is not known."""
    if entity.holder:
        return f"{entity.holder} has {_name(entity)}"
    spot = _spot(entity)
    return f"{_name(entity)} is {spot}" if spot else ""


def _spot(entity: Entity) -> str:
    if entity.holder:
        return f"with {entity.holder}"
    if entity.held:
        return f"in my {entity.hand} hand" if entity.hand else "in my hand"
    if entity.at and entity.room and entity.at != entity.room:
        return f"at the {entity.at} in the {entity.room}"
    return f"at the {entity.at or entity.room}" if entity.at or entity.room else ""


def _name(entity: Entity) -> str:
    return f"the {describe_entity(entity)}"


def _holding(state: RobotState) -> str:
    held = [f"{_name(e)}{f' in my {e.hand} hand' if e.hand else ''}" for e in state.held]
    return f"I am holding {listing(held, 'and')}." if held else "I am not holding anything."


def _seeing(state: RobotState) -> str:
    seen = [_name(e) for e in state.entities if e.id in state.seen]
    return f"I see {listing(seen, 'and')}." if seen else "I see nothing that I know."


def _location(state: RobotState) -> str:
    spots = ([f"at the {state.place}"] if state.place and state.place != state.room else []) + (
        [f"in the {state.room}"] if state.room else []
    )
    view = state.view
    if view:
        heading_deg = math.degrees(view.yaw_rad)
        spots.append(
            f"at x {view.x_m:.1f} m, y {view.y_m:.1f} m, heading {heading_deg:.0f} degrees"
        )
    return f"I am {' '.join(spots)}." if spots else "I do not know where I am."


def _status(state: RobotState) -> str:
    if not state.doing:
        rest = "I have paused." if state.mode == "paused" else "I am doing nothing right now."
        return f"{rest} {state.last}".strip()
    step = f", now: {state.step}" if state.step else ""
    begun = "I have paused" if state.mode == "paused" else "I am at"
    waiting = f" {len(state.waiting)} more to do after that." if state.waiting else ""
    return f"{begun} “{state.doing}”{step}.{waiting}"


def _remaining(state: RobotState) -> str:
    if not state.doing or state.worked_s is None:
        return _status(state)
    begun = f"“{state.doing}” began {state.worked_s:.0f} s ago"
    waiting = f" {len(state.waiting)} more to do after that." if state.waiting else ""
    if state.mode == "paused":
        waiting += " I have paused: nothing goes on before you say “resume”."
    expected_s = state.foresee_s()
    if expected_s is None:
        return f"{begun}; I cannot say how long it takes.{waiting}"
    left_s = expected_s - state.worked_s
    if left_s < 1.0:
        return f"{begun} and should be over by now: I foresaw {expected_s:.0f} s.{waiting}"
    return f"About {left_s:.0f} s more: {begun}.{waiting}"


def _operator(state: RobotState) -> str:
    known = f"You are {state.operator}" if state.operator else "I do not know where you are"
    return f"{known}. {_location(state)}"


def _health(state: RobotState) -> str:
    battery = "" if state.battery is None else f" My battery is at {state.battery:.0%}."
    if not state.problems:
        return f"I am well.{battery}"
    return f"Something is wrong: {'; '.join(state.problems)}.{battery}"


def _why(state: RobotState) -> str:
    idle = f"I have not stopped. {_status(state)}" if state.doing else ""
    said = state.holds or state.last or idle or "I have not done anything yet."
    return f"{said} Something is wrong: {'; '.join(state.problems)}." if state.problems else said


def _capabilities(state: RobotState) -> str:
    known = [row for row in _SKILLS if not state.skills or row[0] in state.skills]
    said = state.examples() or tuple(example for _, _, example in known[:4])
    examples = "; ".join(f"“{example}”" for example in said[:4])
    if not known:
        return "I can answer questions and stop."
    can = listing([what for _, what, _ in known], "and")
    return f"I can {can}. Say for example {examples}. “Stop” always stops me."


_REPORTS: dict[ReportTopic, Callable[[RobotState], str]] = {
    "holding": _holding, "seeing": _seeing, "location": _location, "status": _status,
    "remaining": _remaining, "operator": _operator,
    "health": _health, "why": _why, "capabilities": _capabilities,
}  # fmt: skip
