"""A last look at what is to be done, whatever reading it came from: where it is not what was said.

Each sense finds one kind of words that goals contradict or lost, and says so; what one of them
finds is asked about. They make no goals but those that may be meant as well.
"""

from collections.abc import Callable

from intents.contradictions import contradiction
from intents.degrees import lost_degree
from intents.descriptions import lost_description
from intents.english.trouble import Unpromised
from intents.english.words.names import NameIndex
from intents.goals import Goal
from intents.occasions import missed
from intents.outcomes import Goals, Outcome
from intents.perils import peril
from intents.second_look import just_that
from intents.sentence_kind import only_told

Sense = Callable[[str, tuple[Goal, ...], NameIndex], Unpromised | None]


def last_look(text: str, outcome: Outcome, index: NameIndex) -> Outcome:
    """An outcome, as a question where what was said is not what its goals do."""
    if not isinstance(outcome, Goals):
        return outcome
    doubts = (sense(text, outcome.goals, index) for sense in _SENSES)
    doubt = next((one for one in doubts if one is not None), None)
    return outcome if doubt is None else just_that(text, doubt)


def _contradicted(text: str, goals: tuple[Goal, ...], index: NameIndex) -> Unpromised | None:
    found = contradiction(text, goals, index)
    return found and Unpromised(f"I heard “{found.said}” and may get it wrong", found.goals)


def _untimely(text: str, goals: tuple[Goal, ...], index: NameIndex) -> Unpromised | None:
    said = missed(text, goals, index)
    return Unpromised(f"I begin at once, and cannot do it “{said}”", goals) if said else None


def _described(text: str, goals: tuple[Goal, ...], index: NameIndex) -> Unpromised | None:
    said = lost_description(text, goals, index) or lost_degree(text, goals, index)
    return Unpromised(f"I cannot take account of “{said}”", goals) if said else None


def _perilous(text: str, goals: tuple[Goal, ...], _: NameIndex) -> Unpromised | None:
    why = peril(text, goals)
    return Unpromised(f"That may be dangerous: {why}", goals) if why else None


def _told(text: str, goals: tuple[Goal, ...], _: NameIndex) -> Unpromised | None:
    told = only_told(text, goals)
    return Unpromised("I am not sure that you ask for that", goals) if told else None


_SENSES: tuple[Sense, ...] = (_contradicted, _untimely, _described, _perilous, _told)
"""In the order in which they are asked: what was said instead before what only may be dangerous."""
