"""How far it is to something, as the crow flies, from what is known of where things are."""

import re
from collections.abc import Callable

from intents.goals import GoTo, LookAt
from intents.grounding import Grounded, describe_entity, ground
from intents.letters import bare
from intents.outcomes import Goals, Outcome
from intents.state import RobotState

_HOW_FAR = re.compile(
    r"(?:(?:and|tell me|please) )*how (?:far|close|near|distant|many (?:metres|meters))"
    r"(?: away| off)? (?:is|are|was)(?: (?:it|you|we))?(?: from here)?(?: away)?(?: to| from)? "
    r"(?P<what>(?!it\b|that\b|this\b|you\b).+?)"
    r"(?: (?:from (?:here|you|us|there)|away|now))*"
)


def how_far(text: str, state: RobotState, read: Callable[[str], Outcome]) -> str | None:
    """The answer to "how far is the table?"; None if it is no such question, or not clear of what.

    Args:
        text: what was said.
        state: of the robot.
        read: what a sentence means, for the description in the question.
    """
    asked = _HOW_FAR.fullmatch(" ".join(re.findall(r"[\w'-]+", bare(text))))
    outcome = read(f"look at {asked['what']}") if asked else None
    goal = outcome.goals[0] if isinstance(outcome, Goals) and len(outcome.goals) == 1 else None
    if not isinstance(goal, GoTo | LookAt):
        return None
    if state.view is None:
        return "I do not know where I am."
    if goal.place:
        away = [state.view.distance_m((x, y, 0.0)) for n, x, y in state.spots if n == goal.place]
        return _told(f"the {goal.place}", min(away)) if away else None
    if isinstance(goal, GoTo) or goal.object is None:
        return None
    found = ground(goal.object, state.entities, view=state.view)
    meant = found.id if isinstance(found, Grounded) else ""
    one = next((entity for entity in state.entities if entity.id == meant), None)
    if one is None:
        return None
    if one.held:
        return f"I am holding the {describe_entity(one)}."
    if one.p_WO is None:
        return f"I do not know where the {describe_entity(one)} is."
    return _told(f"the {describe_entity(one)}", state.view.distance_m(one.p_WO))


def _told(what: str, distance_m: float) -> str:
    """What is said of a distance; the middle of what is large may be far when its edge is near."""
    return f"It is about {distance_m:.1f} m from me to the middle of {what}, as the crow flies."
