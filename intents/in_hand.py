"""Which of the things in its hands "it" is, where nothing else was spoken of."""

from intents.english.trouble import listing
from intents.goals import Goal, ObjectQuery
from intents.grounding import describe_entity, narrowed
from intents.outcomes import Choice, Question
from intents.state import RobotState

_IT = ObjectQuery(held=True)


def which_in_hand(text: str, goals: tuple[Goal, ...], state: RobotState) -> Question | None:
    """Drop *it*: what is asked where several things are held; None where that is clear.

    Args:
        text: What was said.
        goals: What it means.
        state: Of the robot.
    """
    about = any(getattr(goal, "object", None) == _IT for goal in goals)
    if not about or len(state.held) < 2:
        return None
    named = [f"the {describe_entity(entity)}" for entity in state.held]
    choices = tuple(
        Choice(label=label, query=narrowed(ObjectQuery(), entity))
        for label, entity in zip(named, state.held, strict=True)
    )
    return Question(
        question=f"Which one, {listing(named)}?", choices=choices, goals=goals, about=_IT,
        text=text, kind="choice",
    )  # fmt: skip
