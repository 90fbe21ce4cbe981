"""What is asked about the conversation itself: what was done, in which order, because of what."""

import re

from intents.letters import bare
from intents.outcomes import Question
from intents.state import RobotState
from intents.wording import in_words

_JUST = r"(?: just| last| really| actually| right| only)*"
_DID = re.compile(
    rf"(?:and )?(?:so )?(?:tell me )?what (?:did|have|had|were|was) you{_JUST} "
    r"(?:do|done|did|doing|up to)(?: (?:just now|last|before(?: that)?|there|just|now|so far|then|"
    r"until now|earlier|for me|today))*"
    r"|(?:tell me )?what (?:you|you have|you ve|youve) (?:just )?(?:did|done)(?: \w+){0,2}"
    r"|what was (?:the last thing|your last (?:job|task|action|step))(?: you did)?"
)
_ORDER = re.compile(
    r"(?:and )?(?:which|what)(?: one| of (?:them|those|these)| thing| task| job| cup)?"
    r"(?: (?:is|comes|goes|will be|do you (?:do|take|bring|start with)|will you (?:do|take|bring)|"
    r"are you (?:doing|going to do|taking|bringing)))? (?:first|next|after that|then|afterwards)"
    r"|(?:in )?(?:which|what) (?:is the )?order(?: (?:do|will|are) you .*)?|where do you start"
    r"|what do you start with|what (?:comes|follows) (?:next|then|after that)"
)
_REASON = re.compile(
    r"(?:and |but )?(?:why|how come|what for)(?: (?:did|do|are|were|have) you| you(?: are| re)?)"
    r" (?:do|doing|done|did|go|going|gone|went|take|taking|took|pick|picking|"
    r"bring|bringing|put|putting|walk|walking|turn|turning|look|looking|move|moving|wave|waving|say|carry|"
    r"carrying|fetch|fetching)(?: .*)?"
)


def told(text: str, state: RobotState, opened: Question | None = None) -> str | None:
    """The answer to a question about what was done or is to be done; None if it is none.

    Args:
        text: what was said.
        state: of the robot.
        opened: the question that is open, whose goals are what is to be done.
    """
    said = " ".join(re.findall(r"[a-z]+", bare(text).replace("'", "")))
    said = said.removesuffix(" please").removesuffix(" robot")
    if _DID.fullmatch(said):
        return _did(state)
    if _ORDER.fullmatch(said):
        return _order(state, opened, first="first" in said or "start" in said or "order" in said)
    if _REASON.fullmatch(said):
        return _reason(state)
    return None


def _did(state: RobotState) -> str:
    now = f" I am at “{state.doing}” now." if state.doing else ""
    return f"{state.last or 'I have not done anything yet.'}{now}"


def _order(state: RobotState, opened: Question | None, *, first: bool) -> str:
    if opened is not None and len(opened.goals) > 1:
        return f"First I would {', then '.join(in_words((goal,)) for goal in opened.goals)}."
    jobs = [f"“{job}”" for job in (state.doing, *state.waiting) if job]
    if not jobs:
        return f"I have nothing to do right now. {state.last}".strip()
    if first:
        step = f" ({state.step})" if state.step else ""
        then = "".join(f", then {job}" for job in jobs[1:])
        return f"First {jobs[0]}{step}{then}."
    if not state.waiting:
        return f"Nothing after {jobs[0]}."
    return f"After {jobs[0]} comes {', then '.join(jobs[1:])}."


def _reason(state: RobotState) -> str | None:
    if state.doing:
        return f"Because you said “{state.doing}”."
    if not state.did:
        return "I have not done anything yet."
    well = state.last.startswith("I have done")
    return f"Because you said “{state.did}”.{'' if well else f' {state.last}'}"
