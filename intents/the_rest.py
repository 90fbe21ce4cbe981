"""And the rest: what was asked for one thing, done with the others of its kind."""

import re

from msgspec.structs import replace

from intents.goals import Bring, Find, Give, Goal, LookAt, ObjectQuery, Pick, Place
from intents.grounding import Entity, Grounded, ground, narrowed
from intents.letters import bare
from intents.state import RobotState

_REST = re.compile(
    r"(?:(?:and|now|then|ok|also|so|next|please) )*(?:(?:what|how) about |do |"
    r"the same (?:for|with) |bring (?:me )?|take |get (?:me )?|fetch (?:me )?|with |same for )?"
    r"(?:all (?:of )?)?(?:the )?(?:rest|others|other ones|remaining ones|remainder)"
    r"(?: of (?:them|those|these))?(?: (?:too|also|as well|please|now|the same))*"
)


def is_rest(text: str) -> bool:
    """Whether a text asks for the same with the others."""
    return _REST.fullmatch(" ".join(re.findall(r"[a-z]+", bare(text)))) is not None


def with_the_rest(goals: tuple[Goal, ...], state: RobotState) -> tuple[Goal, ...] | str:
    """The last goal, once for each other thing of its kind; or why there is none."""
    last = next((goal for goal in reversed(goals) if _kind(goal)), None)
    if last is None:
        return "I do not know the rest of what you mean."
    name = _kind(last)
    done = {found for goal in goals for found in _meant(goal, state)}
    to = _goes_to(last)
    left = [
        entity
        for entity in state.entities
        if name in (entity.name, entity.category)
        and entity.id not in done
        and not (to and entity.at == to and not entity.held)
    ]
    if not left:
        return f"I know of no other {name}."
    return tuple(_with(last, entity, name) for entity in left)


def _kind(goal: Goal) -> str:
    query = _thing(goal)
    return (query.name or query.category or "") if query is not None else ""


def _thing(goal: Goal) -> ObjectQuery | None:
    return goal.object if isinstance(goal, Pick | Place | Bring | Give | Find | LookAt) else None


def _meant(goal: Goal, state: RobotState) -> tuple[str, ...]:
    query = _thing(goal)
    found = ground(replace(query, at=None), state.entities, view=state.view) if query else None
    return found.ids if isinstance(found, Grounded) else ()


def _goes_to(goal: Goal) -> str | None:
    if isinstance(goal, Place):
        return goal.on or goal.in_
    return goal.to if isinstance(goal, Bring) and isinstance(goal.to, str) else None


def _with(goal: Goal, entity: Entity, name: str) -> Goal:
    assert isinstance(goal, Pick | Place | Bring | Give | Find | LookAt)
    kind = ObjectQuery(name=name) if name == entity.name else ObjectQuery(category=name)
    return replace(goal, object=narrowed(kind, entity))
