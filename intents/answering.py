"""What can be said to a sentence at once, from what is known, or asked because it is not known."""

import re

from intents import replies
from intents.goals import Find, Goal, ObjectQuery, Report, Tell
from intents.outcomes import YES_OR_NO, Goals, Question, Reply
from intents.state import RobotState

_WHERE = re.compile(
    r"\bwhere(?:'s|s|\s)|^\W*(?:is|are)\b|^\W*(?:do|can|have) you "
    r"(?:see|know|seen|find)\b",
    re.IGNORECASE,
)


def asks_where(text: str) -> bool:
    """Whether a sentence asks where something is: "find it" is a wish to have it looked for."""
    return bool(_WHERE.search(text))


def told_at_once(text: str, outcome: Goals, state: RobotState) -> Reply | Question | None:
    """What goals come to where all of them are questions that can be answered now.

    Args:
        text: What was said.
        outcome: What was read in it.
        state: What the robot knows.

    Returns:
        The answers; or what is known, and whether to look for the one thing that is not; None if
        something is to be done in any case.
    """
    asked = _as_asked(text, outcome)
    answers = [_known(said, goal, state) for said, goal in asked]
    told = list(dict.fromkeys(filter(None, answers)))
    if told and all(answers):
        return Reply(text=" ".join(told))
    open_ = [one for one, answer in zip(asked, answers, strict=True) if not answer]
    sought = _sought(*open_[0]) if len(open_) == 1 else None
    if sought is None:
        return None
    question = " ".join([*told, replies.unknown_place(sought)])
    return confirmation(Goals(goals=(open_[0][1],)), question)


def confirmation(outcome: Goals, question: str) -> Question:
    """A question to be answered with yes or no, whether goals are to be carried out."""
    return Question(
        question=question,
        choices=YES_OR_NO,
        goals=outcome.goals,
        kind="confirmation",
        parser=outcome.parser,
    )


def _as_asked(text: str, outcome: Goals) -> list[tuple[str, Goal]]:
    """Each goal with the words that it was read from, as far as they can be told apart."""
    if len(outcome.goals) == 1:
        return [(text, outcome.goals[0])]
    asked = [(said, goal) for said, goals in outcome.clauses for goal in goals]
    if [goal for _, goal in asked] != list(outcome.goals):
        return [("", goal) for goal in outcome.goals]
    return asked


def _known(said: str, goal: Goal, state: RobotState) -> str:
    """The answer to a question, from what is known; empty if it is none, or that is not known."""
    if isinstance(goal, Report):
        return replies.report(goal.topic, state)
    if isinstance(goal, Tell):
        return replies.told(goal, state) or ""
    sought = _sought(said, goal)
    return (replies.where(sought, state) or "") if sought is not None else ""


def _sought(said: str, goal: Goal) -> ObjectQuery | None:
    """What it was asked where it is."""
    return goal.object if isinstance(goal, Find) and asks_where(said) else None
