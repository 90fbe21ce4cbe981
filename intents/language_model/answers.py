"""What a model answers: goals still to be read, a question, or a refusal, in whichever frame."""

from typing import Any, Literal, NamedTuple, cast

from intents.language_model.peeling import values
from intents.language_model.slang import goal_kind

Kind = Literal["goals", "question", "refusal"]
Frame = dict[str, Any]


class Answer(NamedTuple):
    """What a model answers.

    Attributes:
        goals: As it wrote them.
        text: Of a question or a refusal.
    """

    kind: Kind
    goals: list[object]
    text: str = ""


_OUTCOMES: dict[str, Kind] = {
    "question": "question", "ask": "question", "clarification": "question", "clarify": "question",
    "needs_clarification": "question",
    "refusal": "refusal", "refuse": "refusal", "refused": "refusal", "error": "refusal",
    "impossible": "refusal",
}  # fmt: skip
_GOALS = ("goals", "steps", "plan", "actions", "tasks", "goal")
_WRAPPED = ("response", "answer", "result", "output")
_TEXTS = ("text", "question", "refusal", "reason", "message")


def answer_in(said: str) -> Answer | None:
    """The answer in a model's words: the last of several, for those before were drafts."""
    found = values(said)
    if len(found) > 1 and all(_is_goal(one) for one in found):
        return Answer("goals", found)  # a goal a line
    answers = [answer for one in found if (answer := _framed(one))]
    return answers[-1] if answers else None


def _framed(value: object) -> Answer | None:
    if isinstance(value, list):
        goals = cast("list[object]", value)
        return Answer("goals", goals) if goals and all(map(_is_goal, goals)) else None
    if not isinstance(value, dict):
        return None
    frame = {key.lower(): one for key, one in cast("Frame", value).items()}
    if _is_goal(frame):
        return Answer("goals", [frame])
    inner = next((frame[key] for key in _WRAPPED if isinstance(frame.get(key), list | dict)), None)
    return _of_frame(frame) or (_framed(inner) if inner is not None else None)


def _of_frame(frame: Frame) -> Answer | None:
    said = frame.get("outcome")
    kind: Kind | None = _OUTCOMES.get(said.strip().lower()) if isinstance(said, str) else None
    text = next((str(frame[key]) for key in _TEXTS if isinstance(frame.get(key), str)), "")
    held = next((frame[key] for key in _GOALS if isinstance(frame.get(key), list | dict)), None)
    if isinstance(held, dict):  # one goal, or several by their numbers
        several = cast("Frame", held)
        held = list(several.values()) if all(key.isdecimal() for key in several) else [several]
    goals = cast("list[object]", held or [])
    if kind is None and not goals:
        kind = next((_OUTCOMES[key] for key in ("question", "refusal") if frame.get(key)), None)
    if kind is not None:
        return Answer(kind, [], text)
    said_goals = isinstance(said, str) and said.lower() == "goals"
    return Answer("goals", goals) if goals or said_goals else None


def _is_goal(value: object) -> bool:
    """Whether a value is a goal by itself, and no frame of some."""
    return isinstance(value, dict) and goal_kind(cast("Frame", value)) is not None
