"""What a person asks while a question of the robot's is open: it is answered, and ends nothing.

"Are you sure?", "how many cups are there?" are no answers and no errands: whatever the robot would
have to ask back, or to go and see, a "yes" afterwards belongs to the question that was open.
"""

import re

from intents.goals import Answer, Count, Find, LookAt, Report, Resume, Say, Tell, each
from intents.outcomes import Goals, Question, Reply, Turn

_ASKS = re.compile(
    r"\W*(?:(?:and|but|so|well|wait|sorry|robot|hey|hmm|um)\W+)*"
    r"(?:what|which|who|whose|whom|where|when|why|how|is|are|am|was|were|do|does|did|has|have|had"
    r"|isn|aren|wasn|don|doesn|didn|hasn|haven)\b",
    re.IGNORECASE,
)
"""How a question begins that is no polite order, as "can you ..." may be one."""
_ANSWERS = (Answer, Count, Find, LookAt, Report, Say, Tell)
"""What answers a question, or finds out what would."""
_OFFER = re.compile(r"\s*Shall I [^?]*\?$")
NOT_NOW = "I would have to look for that first."


def is_halt(question: Question) -> bool:
    """Whether it is asked if a robot that halted shall go on."""
    return question.goals == (Resume(),)


def not_offered(text: str, opened: Question, outcome: Turn) -> Reply | None:
    """What is said instead of asking back, or of setting out, where a question is open.

    Args:
        text: What the person said.
        opened: What the robot had asked.
        outcome: What the text means by itself, as far as it is not known already.

    Returns:
        None where the text asks for something to be done.
    """
    asks = _ASKS.match(text) is not None
    if isinstance(outcome, Question) and outcome.kind == "confirmation":
        answers = all(isinstance(goal, _ANSWERS) for goal in each(outcome.goals))
        return Reply(text="I did not get that.") if asks or answers else None
    if isinstance(outcome, Goals) and asks and is_halt(opened):
        answers = all(isinstance(goal, _ANSWERS) for goal in each(outcome.goals))
        return Reply(text=NOT_NOW) if answers else None
    return None


def without_offer(question: Question) -> Reply:
    """What is known, without the offer to find out the rest."""
    return Reply(text=_OFFER.sub("", question.question))
