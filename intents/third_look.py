"""A sentence that the grammar does not read whole, as a network says it again.

The network (:mod:`intents.english.paraphrase`) makes no goals: it says the sentence in plain
words, and how sure it is of them; the grammar reads those. Which of the two readings is to be
acted on, or whether neither is, was learnt (:mod:`intents.english.learnt.choice`).
"""

import re
from collections.abc import Callable, Sequence

from intents.english.faithfulness import numbers
from intents.english.learnt.choice import Both, Kind, Name, Side, choice, lost
from intents.english.learnt.field import LEARNT, Fields
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard
from intents.english.trouble import (
    Idle,
    Offered,
    Partly,
    Unasked,
    Unpromised,
)
from intents.english.words import lexicon
from intents.english.words.limits import CONDITIONS, MEASURES, TIMES
from intents.english.words.measures import number
from intents.english.words.names import NameIndex
from intents.goals import Cancel, Goal, LookAt, Pause, Report, Say, Stop, Wait
from intents.outcomes import Goals, Outcome, Question, Refusal
from intents.second_look import (
    LONGEST,
    Attempt,
    Grammar,
    is_plain,
    is_settled,
    just_that,
    remarked,
)

SURE, LIKELY = 0.7, 0.35
"""From the first on the network's reading is acted on; from the second on it is asked about."""
FOUND, HEARD = 0.6, 0.3
"""So sure the network itself has to be of the words that are acted on, and asked about."""
SURER = 0.9
"""From here on it is acted on where an order is left out as talk, or something is said that a
network may well guess: when, how long, how far."""
KEPT = 0.25
"""From here on the orders that the grammar read from every word stay."""
SHORT = 6
"""In so few words the one that the grammar asks about may well matter: "the lamp, gingerly"."""
_BY_THE_WAY = (Wait, Stop, Cancel, Pause, Say, Report, LookAt)
"""What is read out of talk beside an order: "hang on", "never mind", "look", "I say"."""

_RELATIVE = lexicon.words("that which who is")
"""Behind one of these "not" says which is meant: "all that is not red"."""
_WORDS = re.compile(r"[\w']+")
_MEANT = re.compile(r"\bI meant? (?:the|a|an|my|your|our|his|her|this|that)\s+\w", re.IGNORECASE)
"""I mean *the cellar*: what takes another's place, be it known or not."""
_SEVERAL = 2
_BESIDE = re.compile(rf",\s*(?:{'|'.join(sorted(lexicon.DETERMINERS))})\s+(\w+)\s*,")
"""Something more that is meant: "the kettle, the cosy, ..."."""

Hearing = Callable[[str, NameIndex], Heard]


def third_look(
    text: str,
    index: NameIndex,
    before: Attempt,
    read: Grammar,
    *,
    hear: Hearing = Heard,
    fields: Fields = LEARNT,
) -> Attempt:
    """The reading of a sentence to act on, or a question or refusal.

    Args:
        text: What was said.
        index: The names of this world.
        before: What was made of it so far.
        read: The grammar.
        hear: What says it in plain words; by default the network that comes with the package.
        fields: What was learnt; by default what comes with the package.
    """
    found = looked(text, index, before, read, hear)
    if found is None:
        return before
    both, other = found
    own, likely = choice(both, fields)
    said = None if other is None or not isinstance(other.outcome, Goals) else other
    if isinstance(before.outcome, Goals):
        return before if own >= KEPT else _without_talk(text, before, said, both, likely)
    if said and likely >= SURE and not _lacks(text, index, before, both, likely):
        return _taken(said, both)
    if said and likely >= LIKELY and both.likely >= HEARD and not _offers(before):
        return _asked(text, said, "I did not get every word")
    return before


def _offers(before: Attempt) -> tuple[Goal, ...]:
    """What the grammar asks whether it is meant."""
    return before.outcome.goals if isinstance(before.outcome, Question) else ()


def _lacks(text: str, index: NameIndex, before: Attempt, both: Both, likely: float) -> bool:
    """Whether something may be missing in what the network says, however sure it is."""
    goals = both.other.goals
    is_short = len(text.split()) <= SHORT and _offers(before) == goals
    guessed = both.likely < FOUND or isinstance(before.error, Idle)
    guessed |= likely < SURER and (_measures(text) or _tells_when(text))
    return bool(lost(both)) or is_short or guessed or _loses_count(text, index, goals)


def _without_talk(
    text: str, before: Attempt, said: Attempt | None, both: Both, likely: float
) -> Attempt:
    """Orders that are not to be trusted, without what was read out of talk beside them."""
    if both.plain == NOTHING:
        return _asked(text, before, "I am not sure that I got that")
    if said is None or likely < SURER or any(goal not in before.goals for goal in said.goals):
        return before
    left_out = (goal for goal in before.goals if goal not in said.goals)
    return _taken(said, both) if all(map(_is_by_the_way, left_out)) else before


def _taken(said: Attempt, both: Both) -> Attempt:
    told = f"I take that as “{both.plain.replace(' ;', ';')}”"
    return said._replace(outcome=remarked(said.outcome, told))


def looked(
    text: str, index: NameIndex, before: Attempt, read: Grammar, hear: Hearing
) -> tuple[Both, Attempt | None] | None:
    """What grammar and network make of a sentence; None if the network is not to be asked.

    Returns:
        Both, and what the grammar makes of the network's words: None if it says that nothing is
        to be done, or that it has to be asked.
    """
    if not _is_open(text, before):
        return None
    heard = hear(text, index)
    if not heard.is_whole:
        return None
    said = heard.paraphrase()
    if any(word not in said.text for word in _BESIDE.findall(text.lower())):
        return None
    other = None if said.text in (ASK, NOTHING) else read(said.text)
    names = [Name(one.sort, one.names, one.is_whole) for one in heard.units if one.names]
    sides = _side(before), _side(other) if other else Side("nothing")
    return Both(text, names, said.text, said.likely, *sides), other


def _is_open(text: str, before: Attempt) -> bool:
    """Whether other words might be read better than those that were said.

    What the grammar says it cannot keep, will not do or has to ask, no other words make clear.
    """
    if isinstance(before.error, Unasked | Offered | Unpromised) or type(before.error) is Partly:
        return False
    is_done = not before.goals and is_settled(text, before)
    if is_done or is_plain(text) or _limits(text) or len(text.split()) > LONGEST:
        return False
    if isinstance(before.outcome, Goals):
        beside = len(before.goals) > 1 and any(map(_is_by_the_way, before.goals))
        return beside and not is_settled(text, before)
    return before.outcome.puzzled or isinstance(before.error, Idle)


def _measures(text: str) -> bool:
    """Whether it is said how long or how far: of what may well be guessed."""
    return not MEASURES.isdisjoint(_WORDS.findall(text.lower()))


def _tells_when(text: str) -> bool:
    """Whether it is said when: of what may well be lost."""
    return not TIMES.isdisjoint(_WORDS.findall(text.lower()))


def _loses_count(text: str, index: NameIndex, goals: Sequence[Goal]) -> bool:
    """Whether it is said how many of a thing are meant, and no goal says that."""
    words = _WORDS.findall(text.lower())
    told = numbers(goals)
    for at in range(len(words) - 1):
        count = number(words, at)
        if count is None or count.value < _SEVERAL or count.value in told:
            continue
        names = (index.match(words, n) for n in range(count.end, min(count.end + 2, len(words))))
        if any(match is not None and match.of("object", "category") for match in names):
            return True
    return False


def _is_by_the_way(goal: Goal) -> bool:
    """Whether somebody may have said that without asking for it: "hang on", not "wait 10 s"."""
    return isinstance(goal, _BY_THE_WAY) and not (isinstance(goal, Wait) and goal.duration_s)


def _limits(text: str) -> bool:
    """Whether words say when something is to be done, or what is not meant: "that isn't red"."""
    words = _WORDS.findall(text.lower().replace("’", "'"))
    if CONDITIONS.intersection(words) or _MEANT.search(text):
        return True
    denied = [n for n, word in enumerate(words) if word == "not" or word.endswith("n't")]
    return any(n == 0 or words[n - 1] in _RELATIVE for n in denied)


def _side(attempt: Attempt) -> Side:
    outcome = attempt.outcome
    goals = () if isinstance(outcome, Refusal) else outcome.goals
    puzzled = not isinstance(outcome, Goals) and outcome.puzzled
    return Side(_kind(outcome), goals, attempt.trouble, puzzled)


def _kind(outcome: Outcome) -> Kind:
    if isinstance(outcome, Goals):
        return "goals"
    return "question" if isinstance(outcome, Question) else "refusal"


def _asked(text: str, attempt: Attempt, doubt: str) -> Attempt:
    return attempt._replace(outcome=just_that(text, Partly(doubt, attempt.goals)))
