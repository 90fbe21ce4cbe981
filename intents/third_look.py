"""A sentence that the grammar does not read whole, as a network says it again.

The network (:mod:`intents.english.paraphrase`) makes no goals: it says the sentence in plain
words, and how sure it is of them; the grammar reads those. It also tells how likely it would have
said what the grammar made of the sentence itself: an order read out of talk is so left out.
"""

import re
from collections.abc import Callable, Iterator

from intents.english.learnt.trust import NEVER
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard, Paraphrase
from intents.english.paraphrase.source import Unit
from intents.english.trouble import Idle, Offered, Partly, Unasked, Unpromised
from intents.english.words import lexicon
from intents.english.words.limits import CONDITIONS
from intents.english.words.names import NameIndex
from intents.goals import Cancel, LookAt, Pause, Report, Say, Stop, Wait
from intents.outcomes import Goals, Question, Refusal
from intents.plain_words import plainly
from intents.second_look import LONGEST, Attempt, Grammar, is_plain, is_settled, just_that, remarked

SURE, LIKELY = 0.7, 0.4
"""From here on plain words are acted on; from here on they are asked about."""
_BY_THE_WAY = (Wait, Stop, Cancel, Pause, Say, Report, LookAt)
"""What is read out of talk beside an order: "hang on", "never mind", "look", "I say"."""
ODD = 1e-3
"""The grammar's reading of such talk is given up for what the network would say so much rather."""
_RELATIVE = lexicon.words("that which who is")
"""Behind one of these "not" says which is meant: "all that is not red"."""

Hearing = Callable[[str, NameIndex], Heard]


def third_look(
    text: str, index: NameIndex, before: Attempt, read: Grammar, *, hear: Hearing = Heard
) -> Attempt:
    """The reading of a sentence to act on, or a question or refusal.

    Args:
        text: What was said.
        index: The names of this world.
        before: What was made of it so far.
        read: The grammar.
        hear: What says it in plain words; by default the network that comes with the package.
    """
    if is_plain(text) or len(text.split()) > LONGEST:
        return before
    if isinstance(before.outcome, Goals):
        more = any(isinstance(goal, _BY_THE_WAY) for goal in before.goals)
        settled = len(before.goals) == 1 or not more or is_settled(text, before)
        return before if settled else _checked(text, index, before, read, hear)
    idle = isinstance(before.error, Idle)
    if type(before.error) is Partly or not (before.outcome.puzzled or idle):
        return before
    if isinstance(before.error, Unasked | Offered | Unpromised):
        return before
    words = re.findall(r"[\w']+", text.lower().replace("’", "'"))
    if CONDITIONS.intersection(words) or _is_denied(words):
        return before
    heard = hear(text, index)
    if not heard.is_whole:
        return before
    said = heard.paraphrase()
    if said.text in (ASK, NOTHING):
        return before
    attempt = read(said.text)
    if isinstance(attempt.outcome, Refusal):
        return before
    least = NEVER if idle or _loses_names(heard, said) else SURE
    taken = _taken(text, said, attempt, least)
    offers = isinstance(before.outcome, Question) and before.outcome.goals
    if taken is None or (offers and isinstance(taken.outcome, Question)):
        return before  # what is offered already has more of the sentence in it
    return taken


def _is_denied(words: list[str]) -> bool:
    """Whether it is said what is not meant: "not the mug, ...", "all that isn't red"."""
    denied = [n for n, word in enumerate(words) if word == "not" or word.endswith("n't")]
    return any(n == 0 or words[n - 1] in _RELATIVE for n in denied)


def _loses_names(heard: Heard, said: Paraphrase) -> bool:
    """Whether something is named that does not come back: a name of this world, ", the cosy,"."""
    told = {name for n in said.pointed for name in heard.units[n].names}
    named = (unit for unit in heard.units if unit.is_whole and unit.names)
    beside = any(
        one.sort == two.sort == "word" and before.said == after.said == ","
        and one.said in lexicon.DETERMINERS and n + 2 not in said.pointed
        for n, (before, one, two, after) in enumerate(_in_fours(heard.units))
    )  # fmt: skip
    return beside or any(told.isdisjoint(unit.names) for unit in named)


def _in_fours(units: list[Unit]) -> Iterator[tuple[Unit, Unit, Unit, Unit]]:
    return zip(units, units[1:], units[2:], units[3:], strict=False)


def _checked(text: str, index: NameIndex, before: Attempt, read: Grammar, hear: Hearing) -> Attempt:
    """What the grammar made of a sentence, without what it read out of talk beside it."""
    heard = hear(text, index)
    said = heard.paraphrase()
    if said.likely < SURE or said.text in (ASK, NOTHING):
        return before
    attempt = read(said.text)
    more = list(before.goals)
    for goal in attempt.goals:
        if goal not in more:
            return before
        more.remove(goal)
    sidelong = attempt.goals and more and all(isinstance(goal, _BY_THE_WAY) for goal in more)
    if not sidelong or heard.likely(plainly(before.goals)) >= ODD * said.likely:
        return before
    return _taken(text, said, attempt, SURE) or before


def _taken(text: str, said: Paraphrase, attempt: Attempt, least: float) -> Attempt | None:
    """A reading of plain words to act on or to ask about; None if they are not likely enough."""
    if said.likely >= least:
        told = f"I take that as “{said.text.replace(' ;', ';')}”"
        return attempt._replace(outcome=remarked(attempt.outcome, told))
    if isinstance(attempt.outcome, Goals) and said.likely >= LIKELY:
        asked = just_that(text, Partly("I did not get every word", attempt.outcome.goals))
        return attempt._replace(outcome=asked)
    return None
