"""Undoing what was asked last: things back where they stood, the robot back to where it was.

What is known is how things stood when it was asked (`before`), and how they stand now; what was
said, shown or handed over cannot be undone, and the robot says so.
"""

import re
from collections.abc import Iterable

from msgspec.structs import replace

from intents.goals import (
    Balance,
    Bring,
    Close,
    Follow,
    Give,
    Goal,
    GoTo,
    Guide,
    ObjectQuery,
    Open,
    Person,
    Pick,
    Place,
    Pose2,
    Switch,
)
from intents.grounding import Entity, Grounded, describe_entity, ground, narrowed
from intents.letters import bare
from intents.state import RobotState

_UNDO = re.compile(
    r"(?:undo|revert|reverse|take back)(?: (?:that|it|this|what you (?:just )?did|everything|"
    r"(?:the|your) last (?:thing|step|one|action|move|job|task|command)))?(?: again| please)*"
    r"|(?:please )?make (?:that|it) undone|put everything back(?: .*)?"
)
_BACK = re.compile(
    r"put (?:it|that|them|this) back(?: (?:where (?:it|they|that) (?:was|were|belongs?|stood|came "
    r"from)|where you (?:got|took|found|had) (?:it|them|that)(?: from)?|in its place|again|there|"
    r"please|to where it was))*"
)
_WALK_BACK = re.compile(
    r"(?:go|walk|move|return|come)(?: back)?(?: to)? where you (?:were|came from|started|stood)"
    r"(?: before| from| just now)*"
)
_UNDO_SEVERAL = re.compile(
    r"(?:undo|revert|reverse|take back) (?:all |both )?(?:of )?(?:the |your |my )?"
    r"(?:last|previous) "
    r"(?:(?:two|three|four|five|six|few|couple of|several) )?"
    r"(?:things|steps|ones|actions|moves|jobs|tasks|commands|orders)(?: you did)?"
)
Undone = tuple[Goal, ...] | str
"""What undoes it, or why nothing does."""


def is_undo(text: str) -> bool:
    """Whether a text is a wish to have undone all of what was asked last."""
    return _UNDO.fullmatch(_said(text)) is not None


def is_undo_of_several(text: str) -> bool:
    """Whether a text is a wish to have undone more than what was asked last."""
    return _UNDO_SEVERAL.fullmatch(_said(text)) is not None


def is_back(text: str) -> bool:
    """Whether a text is a wish to have a thing, or the robot, back where it was."""
    said = _said(text)
    return any(kind.fullmatch(said) for kind in (_BACK, _WALK_BACK))


def is_things_back(text: str) -> bool:
    """Whether a text is a wish to have things back, whatever was done since they were moved."""
    return _BACK.fullmatch(_said(text)) is not None


def undone(text: str, goals: tuple[Goal, ...], before: RobotState, now: RobotState) -> Undone:
    """What undoes goals.

    Args:
        text: the wish, which may be for things or the robot only ("put it back").
        goals: what was done.
        before: how things stood when it was asked.
        now: how they stand.
    """
    said = _said(text)
    walks = _walk_back(goals, before) if not _BACK.fullmatch(said) else ()
    if _WALK_BACK.fullmatch(said):
        return walks or _pose(before) or "I do not know where I was."
    if any(hasattr(goal, "goals") or hasattr(goal, "then") for goal in goals):
        return "That was more than I can undo in one go; tell me what to put back, and where."
    found: list[Goal] = []
    for goal in reversed(goals):
        steps = _reversed(goal, before, now)
        if isinstance(steps, str):
            return steps
        found += [step for step in steps if step not in found]
    if _walked(goals) and before.view is None and not found:
        return "I do not know where I stood before that."
    if not (found or walks):
        return "Nothing of that is left to undo."
    return (*found, *walks)


def _said(text: str) -> str:
    said = " ".join(re.findall(r"[a-z]+", bare(text)))
    return said.removeprefix("please ").removesuffix(" please").removesuffix(" robot")


def _reversed(goal: Goal, before: RobotState, now: RobotState) -> Undone:
    if isinstance(goal, GoTo | Follow | Guide):
        return ()
    if isinstance(goal, Open | Close):
        return (Close(what=goal.what) if isinstance(goal, Open) else Open(what=goal.what),)
    if isinstance(goal, Switch):
        return (replace(goal, on=not goal.on),)
    if isinstance(goal, Balance):
        return (Balance(mode="stand"),)
    if isinstance(goal, Pick | Place | Bring | Give):
        gave = isinstance(goal, Give) or (isinstance(goal, Bring) and isinstance(goal.to, Person))
        return _things_back(goal.object, before, now, gave=gave)
    return "That cannot be undone: it moved nothing."


def _things_back(query: ObjectQuery, before: RobotState, now: RobotState, *, gave: bool) -> Undone:
    found = ground(query, before.entities, view=before.view)
    ids = found.ids if isinstance(found, Grounded) else ()
    steps: list[Goal] = []
    for was, is_now in _both(ids, before, now):
        thing = replace(narrowed(ObjectQuery(), was), at=None)
        named = describe_entity(was)
        stood_on = was.at or is_now.came_from  # nobody had seen it before it was taken from there
        if was.held:
            steps += [] if is_now.held else [Pick(object=thing)]
        elif not stood_on:
            return f"I do not know where the {named} was."
        elif is_now.held or is_now.at != stood_on:
            if gave and not is_now.held and not is_now.at:
                return f"I gave the {named} away; hand it to me, or tell me where it lies."
            steps.append(Place(object=thing, on=stood_on))
    return tuple(steps) if ids else "I do not know any more which thing that was."


def _both(
    ids: Iterable[str], before: RobotState, now: RobotState
) -> Iterable[tuple[Entity, Entity]]:
    later = {entity.id: entity for entity in now.entities}
    return [(e, later[e.id]) for e in before.entities if e.id in ids and e.id in later]


def _walk_back(goals: tuple[Goal, ...], before: RobotState) -> tuple[Goal, ...]:
    """To where the robot was, if it was sent somewhere."""
    return _pose(before) if _walked(goals) else ()


def _walked(goals: tuple[Goal, ...]) -> bool:
    return any(isinstance(goal, GoTo | Follow | Guide) for goal in goals)


def _pose(before: RobotState) -> tuple[Goal, ...]:
    view = before.view
    if view is None:
        return ()
    return (GoTo(pose=Pose2(x_m=view.x_m, y_m=view.y_m, yaw_rad=view.yaw_rad)),)
