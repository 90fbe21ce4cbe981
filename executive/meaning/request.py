"""From a sentence to a task that can be done here, before anything is started."""

from __future__ import annotations

from collections.abc import Callable

import msgspec
from msgspec.structs import replace

from executive.meaning import own_eyes
from executive.meaning.identify import CannotMean, Scene
from executive.meaning.knowledge import Knowledge
from executive.meaning.tasks import understand
from executive.meaning.validation import check
from executive.meaning.whereabouts import Whereabouts, is_busy, needed
from executive.trees.parts import Part
from intents import dialogue, parser, plans
from intents.context import noted, verdict_of
from intents.goals import Goal
from intents.outcomes import YES_OR_NO, Goals, Question, Refusal
from intents.parser import Fallback
from intents.risks import risk
from intents.state import RobotState
from robot.failures import Failure
from robot.messages import WorldMap
from robot.model import description
from robot.model.body import BodyModel
from robot.model.description import RobotDescription
from robot.reality.contract import Reality, World

MAX_QUESTIONS = 3
"""Of the robot's, before it gives up."""
EXAMPLE = 'for example: humanoid do "pick up the red cup and put it on the shelf"'

ANSWER = "say it again with the answer, or at a terminal, where you can be asked"
AGREE = "say it again with --yes, or at a terminal, where you can be asked"
MAX_CHANGES = 20
"""Of one plan, before it is asked about no more."""

Ask = Callable[[Question], str | None]
"""Puts a question to a person; their answer, None if there is none."""


class Setting(msgspec.Struct, frozen=True, kw_only=True):
    """A robot and its world, read and checked, and the reality that the world is of."""

    reality: Reality
    world: World
    description: RobotDescription
    robot_name: str

    @property
    def world_map(self) -> WorldMap:
        """The prior map."""
        return self.world.map

    @property
    def knowledge(self) -> Knowledge:
        """The map, to look things up in."""
        return Knowledge(self.world_map)


class Refused(msgspec.Struct, frozen=True, kw_only=True):
    """A sentence that leads to nothing: why, and what to do about it."""

    outcome: str
    """"refusal", "question", or the code of a failure."""
    reason: str
    suggestion: str = EXAMPLE


class Understood(msgspec.Struct, frozen=True, kw_only=True):
    """A sentence, its goals, the task they make; what is in the hands before and after it (ids).

    `whereabouts` is what they were understood by, where their meaning depends on it; `remark` what
    people are told of how they were understood.
    """

    text: str
    goals: tuple[Goal, ...]
    task: Part
    held: tuple[str, ...] = ()
    holds: tuple[str, ...] = ()
    whereabouts: Whereabouts | None = None
    remark: str = ""


def setting(reality: Reality, world: str, *, robot: str, vary_seed: int | None = None) -> Setting:
    """Read a world and a robot, by name or path; with a seed, shuffle the world.

    Raises:
        ConfigError: with everything that is wrong in a file, by line.
    """
    body = description.load(robot)
    BodyModel(body)  # the MJCF has what the description names, or this says what not
    there = reality.world(world, vary_seed=vary_seed)
    if reality.eyes == "auto":
        there = there.seen_by(own_eyes.trusted(there, robot))
    return Setting(
        reality=reality,
        world=there,
        description=body,
        robot_name=robot,
    )


def request(
    text: str, where: Setting, *, ask: Ask | None = None, fallback: Fallback | None = None
) -> Understood | Refused:
    """What a sentence asks for, checked against the world and the robot.

    Args:
        text: what was typed; anything is accepted.
        where: robot and world.
        ask: puts open questions to a person; without it an open question is a refusal.
        fallback: asked what the grammar does not understand; what it makes of a sentence is put to
            a person first.
    """
    outcome = _hear(text, where.knowledge, ask, fallback)
    if isinstance(outcome, Refusal):
        return Refused(outcome="refusal", reason=outcome.reason)
    if isinstance(outcome, Question):
        plan = outcome.parser == "model" and outcome.goals and not risk(outcome.goals)
        cure = AGREE if plan else ANSWER
        return Refused(outcome="question", reason=outcome.question, suggestion=cure)
    understood = meant(text, outcome.goals, where)
    if isinstance(understood, Refused):
        return understood
    return replace(understood, remark=outcome.reason or "")


def meant(
    text: str,
    goals: tuple[Goal, ...],
    where: Setting,
    *,
    held: tuple[str, ...] = (),
    state: RobotState | None = None,
) -> Understood | Refused:
    """What goals mean here, checked against the world and the robot.

    Args:
        text: what was said.
        goals: what it was understood as.
        where: robot and world.
        held: ids of the objects that will be in the hands by then.
        state: where things are and where the robot stands, for "the leftmost", as far as known.
    """
    state = state or RobotState()
    scene = Scene(
        where.knowledge, held=held, entities=state.entities, view=state.view, moves=is_busy(state)
    )
    try:
        task = understand(goals, scene)
    except CannotMean as end:
        return refused(end.failure)
    refusal = check(task, where.world_map, where.description)
    if refusal is not None:
        return refused(refusal)
    return Understood(
        text=text, goals=goals, task=task, held=held, holds=tuple(scene.held),
        whereabouts=needed(goals, state),
    )  # fmt: skip


def unable(
    goals: tuple[Goal, ...],
    where: Setting,
    *,
    held: tuple[str, ...] = (),
    state: RobotState | None = None,
) -> str:
    """Why goals cannot be done here, whatever a person may add; empty if they can, or it depends.

    Of those of a language model it is asked before the person is: it is told, and may plan anew.
    """
    outcome = meant("", goals, where, held=held, state=state)
    if isinstance(outcome, Understood) or outcome.outcome == "ambiguous":
        return ""
    return outcome.reason


def refused(reason: Failure) -> Refused:
    """A failure found before anything moved."""
    return Refused(outcome=reason.code, reason=reason.cause, suggestion=reason.suggestion)


def _hear(
    text: str, knowledge: Knowledge, ask: Ask | None, fallback: Fallback | None
) -> Goals | Question | Refusal:
    """Parse, asking back as often as it takes within reason."""
    vocabulary = knowledge.vocabulary()
    context = dialogue.Context(entities=knowledge.entities())
    outcome, context = parser.hear(text, vocabulary, context=context, fallback=fallback)
    for _ in range(MAX_QUESTIONS + MAX_CHANGES):
        if isinstance(outcome, Goals) and outcome.parser == "model":
            outcome = _proposal(text, outcome)
            context = replace(context, question=outcome)
        answer = ask(outcome) if isinstance(outcome, Question) and ask is not None else None
        if not answer or not isinstance(outcome, Question):
            return outcome
        changed = plans.changed(answer, outcome, vocabulary)
        if changed is None and _is_plan(outcome) and verdict_of(answer) is not None:
            agreed = Goals(goals=outcome.goals)
            return agreed if verdict_of(answer) else Refusal(reason="All right, I leave it")
        context = noted(context, text, outcome.question)
        if changed is not None:
            outcome, context = changed, replace(context, question=changed)
        else:
            outcome, context = parser.hear(answer, vocabulary, context=context, fallback=fallback)
        text = answer
    return outcome


def _is_plan(question: Question) -> bool:
    """Whether it is asked if something is to be done that a language model has made."""
    return question.parser == "model" and question.kind == "confirmation"


def _proposal(text: str, outcome: Goals) -> Question:
    """What a language model made of a sentence, put to a person."""
    return Question(
        question=plans.proposal(outcome.goals, risk(outcome.goals) or plans.HOW_I_READ_IT),
        choices=YES_OR_NO,
        goals=outcome.goals,
        text=text,
        kind="confirmation",
        parser=outcome.parser,
    )
