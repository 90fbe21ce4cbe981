"""`humanoid parse`: sentences to goals, for people and, as JSON lines, for programs."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import msgspec

from executive.frontends.composition_root import REALITY
from executive.frontends.language_model import language_model
from executive.frontends.output import say, write_json
from executive.meaning.knowledge import Knowledge
from intents.dialogue import Context
from intents.goals import to_builtins
from intents.outcomes import Goals, Outcome, Question, to_record
from intents.parser import hear
from intents.vocabulary import Names, Vocabulary
from intents.wording import in_words
from robot.errors import ConfigError, Problem, shortened
from robot.files import plain_data
from robot.files.yaml_nodes import read_text

MAX_NAMES = 200_000
"""Bytes of a vocabulary; of its names, see `intents.vocabulary.MOST_NAMES`."""
MAX_SENTENCES = 10_000_000
"""Bytes of a file of sentences: some 100 000."""


def parse_all(
    texts: list[str],
    *,
    world: str,
    vocabulary: Path | None,
    file: Path | None,
    as_json: bool,
    model: Path | None = None,
    show_prompt: bool = False,
) -> int:
    """Parse and print; returns 0, or 2 if a single sentence is not goals.

    Args:
        texts: Sentences.
        world: Whose names they speak of.
        vocabulary: A file of names instead.
        file: A file of more sentences.
        as_json: One record a line, for programs.
        model: The file of a language model's endpoint, asked what the grammar cannot read.
        show_prompt: Print the bodies of the requests to it, as they are sent; without a model what
            the first would be.

    Raises:
        ConfigError: the world, the vocabulary, the endpoint or the file cannot be read.
    """
    names, context = _vocabulary(world, vocabulary)
    fallback = language_model(model, shown=write_json if show_prompt else None)
    outcome: Outcome | None = None
    for text in [*texts, *(_lines(file) if file else ())]:
        if show_prompt and fallback is None:
            write_json(_would_ask(text, names, context))
        if fallback is not None:
            fallback.trouble = ""
        outcome, _ = hear(text, names, context=context, fallback=fallback)
        if as_json:
            write_json(to_record(text, outcome))
        else:
            say(_words(text, outcome))
        if fallback is not None and fallback.trouble:
            say(f"  {fallback.trouble}", err=True)
    return 0 if file is not None or isinstance(outcome, Goals) else 2


def _would_ask(text: str, names: Vocabulary, context: Context) -> dict[str, Any]:
    """The first request to a language model about a sentence, whether or not it is asked."""
    from intents.language_model import prompt

    return prompt.talk_of(text, names, context).body("MODEL", form="json_schema")


def _vocabulary(world: str, file: Path | None) -> tuple[Vocabulary, Context]:
    """The names of a world, and what is there; a file of names does not say what is there."""
    if file is None:
        knowledge = Knowledge(REALITY.world(world).map)
        return knowledge.vocabulary(), Context(entities=knowledge.entities())
    text = read_text(file, limit=MAX_NAMES)
    try:
        data = plain_data.from_json(text)
    except ValueError as error:
        cure = "docs/intents.md shows the form"
        raise ConfigError([Problem(str(error), str(file), suggestion=cure)]) from None
    return plain_data.fitted(data, Names, file).vocabulary(), Context()


def _lines(file: Path) -> Iterable[str]:
    """The sentences of a file, one a line."""
    if str(file) == "-":
        return (line.rstrip("\n") for line in sys.stdin)
    return read_text(file, limit=MAX_SENTENCES).splitlines()


def _words(text: str, outcome: Outcome) -> str:
    """An outcome for people: what is understood, from which words, and the goals."""
    text = shortened(text)
    if isinstance(outcome, Goals):
        goals = [msgspec.json.encode(goal).decode() for goal in to_builtins(outcome.goals)]
        lines = [text, f"  understood: {in_words(outcome.goals)}", *_why(outcome)]
        return "\n".join([*lines, *(f"  {goal}" for goal in goals)])
    if isinstance(outcome, Question):
        choices = [f"    - {choice.label}" for choice in outcome.choices]
        return "\n".join([text, f"  question: {shortened(outcome.question)}", *choices])
    return f"{text}\n  refused: {shortened(outcome.reason)}"


def _why(outcome: Goals) -> list[str]:
    """From which words what was understood; nothing where that is plain."""
    told = {
        "stop": ["  why: a cry to stop comes before everything else"],
        "model": ["  why: the language model read it so"],
    }.get(outcome.parser, [])
    clauses = outcome.clauses if len(outcome.clauses) > 1 else ()
    told += [f"  “{said}”: {in_words(goals) if goals else 'noted'}" for said, goals in clauses]
    return told + ([f"  {outcome.reason}"] if outcome.reason else [])
