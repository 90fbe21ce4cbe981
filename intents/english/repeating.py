"""How often: a whole number of times, or it is refused and never rounded."""

from intents.english.trouble import NotUnderstood
from intents.goals import Goal, Repeat


def repeated(goals: list[Goal], times: float) -> list[Goal]:
    """Goals to be done so often; once they are as they are.

    Raises:
        NotUnderstood: That is no number of times.
    """
    if times < 1 or times != int(times):
        raise NotUnderstood(f"I do a thing a whole number of times, once at least, not {times:g}")
    return [Repeat(times=int(times), goals=tuple(goals))] if times > 1 else goals
