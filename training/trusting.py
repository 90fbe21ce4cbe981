"""What readings of the marked sentences tell of when a reading is to be trusted."""

from typing import Any, cast

from intents.context import Context
from intents.english.learnt.field import Fields
from intents.english.learnt.sight import sight
from intents.english.learnt.trust import RIGHT, WRONG, signs
from intents.english.words.names import index_of
from intents.goals import Goal, to_builtins
from intents.parser import first_look
from intents.sameness import same
from intents.second_look import Attempt, is_settled, looks_at
from training.learning import Example
from training.marked import Marked


def readings(sentence: Marked, fields: Fields) -> list[Example]:
    """The readings of a sentence, each with whether it is what was meant.

    Args:
        sentence: What a speaker said whom the fields have not heard.
        fields: What was learnt from others.
    """
    context, index = Context(), index_of(sentence.vocabulary)

    def read(said: str) -> Attempt:
        return first_look(said, sentence.vocabulary, context)

    first = read(sentence.text)
    seen = None if is_settled(sentence.text, first) else sight(sentence.text, index, fields)
    if seen is None:
        return []
    found = looks_at(sentence.text, index, seen, first, read, fields=fields)
    every = [one.reading for one in found]
    told: list[Example] = []
    for one in every:
        label = RIGHT if is_meant(sentence, one.goals) else WRONG
        told.append(([signs(one, every, seen, first.trouble)], [label]))
    return told


def is_meant(sentence: Marked, goals: tuple[Goal, ...]) -> bool:
    """Whether goals are what a sentence asks for."""
    said = to_builtins(goals)
    return any(same(one, said) for one in map(_listed, (sentence.gold, *sentence.also)) if one)


def _listed(wanted: Any) -> list[dict[str, Any]]:
    """Goals as a list; empty where none are wanted."""
    if isinstance(wanted, str):
        return []
    return cast("list[dict[str, Any]]", wanted if isinstance(wanted, list) else [wanted])
