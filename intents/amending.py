"""The goals of the last order with another name or amount in place of one that was said."""

from msgspec.structs import replace

from intents.allowed import excess
from intents.amounts import amended
from intents.context import Context
from intents.outcomes import Goals, Outcome, Refusal
from intents.parser import hear
from intents.small_questions import is_halt
from intents.swaps import focused, is_alike, swap
from intents.vocabulary import Vocabulary
from intents.wording import sentence_case


def swapped(text: str, before: Context, vocabulary: Vocabulary) -> tuple[Outcome, Context] | None:
    """What "not the bottle, the box" makes of the goals before, if they speak of a bottle.

    Or what "no, three times" does, if one of them has such an amount.

    Args:
        text: What was said.
        before: What was said before; a question that is open is answered first.
        vocabulary: The names of this world.
    """
    answers = before.question is not None and not is_halt(before.question)
    other = None if answers else amended(text, before.goals)
    if other is not None:
        after = replace(before, goals=other, question=None)
        too_much = excess(other)
        if too_much:
            return Refusal(reason=f"{sentence_case(too_much)}."), before
        return Goals(goals=other, elliptic=True), after
    found = None if answers else swap(text)
    about = focused(before, found.old) if found else None
    if found is None or about is None:
        return None
    outcome, after = hear(f"no, {found.new}", vocabulary, context=about)
    if isinstance(outcome, Refusal):
        return None if found.by_name else (outcome, after)
    changed = outcome.goals != before.goals
    alike = not found.by_name or is_alike(outcome.goals, before.goals)
    return (outcome, after) if changed and alike else None
