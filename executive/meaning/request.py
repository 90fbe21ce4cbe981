"""From a sentence to a task that can be done here, before anything is started."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from executive.meaning.identify import CannotMean, Scene
from executive.meaning.knowledge import Knowledge
from executive.meaning.tasks import understand
from executive.meaning.validation import check
from executive.meaning.whereabouts import Whereabouts, needed
from executive.trees.parts import Part
from intents import dialogue, parser
from intents.context import verdict_of
from intents.goals import Goal
from intents.outcomes import YES_OR_NO, Goals, Question, Refusal
from intents.parser import Fallback
from intents.state import RobotState
from intents.wording import in_words
from robot.failures import Failure
from robot.messages import WorldMap
from robot.model import description
from robot.model.body import BodyModel
from robot.model.description import RobotDescription
from robot.reality.contract import Reality, World

MAX_QUESTIONS = 3
EXAMPLE = 'for example: humanoid do "pick up the red cup and put it on the shelf"'

ANSWER = "say it again with the answer, or at a terminal, where you can be asked"

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

    `whereabouts` is what they were understood by, where their meaning depends on it.
    """

    text: str
    goals: tuple[Goal, ...]
    task: Part
    held: tuple[str, ...] = ()
    holds: tuple[str, ...] = ()
    whereabouts: Whereabouts | None = None


def setting(reality: Reality, world: str, *, robot: str, vary_seed: int | None = None) -> Setting:
    """Read a world and a robot, by name or path; with a seed, shuffle the world.

    Raises:
        ConfigError: with everything that is wrong in a file, by line.
    """
    body = description.load(robot)
    BodyModel(body)  # the MJCF has what the description names, or this says what not
    return Setting(
        reality=reality,
        world=reality.world(world, vary_seed=vary_seed),
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
        return Refused(outcome="question", reason=outcome.question, suggestion=ANSWER)
    return meant(text, outcome.goals, where)


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
    scene = Scene(where.knowledge, held=held, entities=state.entities, view=state.view)
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
    for _ in range(MAX_QUESTIONS):
        if not isinstance(outcome, Question) or ask is None:
            break
        answer = ask(outcome)
        if not answer:
            break
        outcome, context = parser.hear(answer, vocabulary, context=context, fallback=fallback)
    if isinstance(outcome, Goals) and outcome.parser == "model":
        return _confirmed(outcome, ask)
    return outcome


def _confirmed(outcome: Goals, ask: Ask | None) -> Goals | Question | Refusal:
    """What a language model made of a sentence, once a person has agreed to it."""
    question = Question(
        question=f"I shall {in_words(outcome.goals)}; so the language model reads it. Shall I?",
        choices=YES_OR_NO,
        goals=outcome.goals,
        kind="confirmation",
        parser=outcome.parser,
    )
    answer = ask(question) if ask is not None else None
    if not answer:
        return question
    return outcome if verdict_of(answer) else Refusal(reason="All right, I leave it")
