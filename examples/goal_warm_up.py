"""A goal: warm up, which is to squat and to lean for a while each.

Every piece below says in which file it would stand; docs/extending.md has the list.
"""

from __future__ import annotations

from executive.meaning.identify import Scene
from executive.skills.balance import BalanceParams
from executive.trees.parts import Errand, Part, Series
from intents.english.frames.slots import Slots
from intents.english.phrases.complements import Clause
from intents.english.phrases.referents import Scope
from intents.goals import Goal, _Goal


# intents/goals.py: the struct, and its name in the union `Goal`.
class WarmUp(_Goal, frozen=True, kw_only=True):
    """Move a little before the work begins; each posture is held for so long."""

    duration_s: float | None = None


# intents/english/words/verbs.py: its sense and the spellings of it, separated by commas, as a row
# of `SPELLINGS` has them: "warm_up": "warm up,limber up".
SENSE, SPELLINGS = "warm_up", "warm up,limber up"


# intents/english/frames/postures.py, or a new file beside it: what the verb makes of its
# complements; imported and made a row of `FRAMES` in intents/english/frames/__init__.py:
# "warm_up": postures.warm_up.
def warm_up(clause: Clause, scope: Scope) -> list[Goal]:
    """Warm up; limber up for five seconds."""
    slots = Slots(clause, scope)
    duration_s = slots.measure("time")
    slots.done()
    return [WarmUp(duration_s=duration_s)]


# intents/wording.py: how it is read back to people, a row of `_PLAIN`; or a case of `_goal`.
WORDS = "warm up"


# executive/meaning/handlers/moving.py: the steps it takes; a row of `HANDLERS` in
# executive/meaning/tasks.py.
def warming_up(goal: WarmUp, _scene: Scene) -> Part:
    """Squat, then lean."""
    held_s = 3.0 if goal.duration_s is None else goal.duration_s
    parts = (
        Errand(
            name=f"squat for {held_s:g} s", params=BalanceParams(mode="squat", duration_s=held_s)
        ),
        Errand(name=f"lean for {held_s:g} s", params=BalanceParams(mode="lean", duration_s=held_s)),
    )
    return Series(name="warm up", parts=parts)
