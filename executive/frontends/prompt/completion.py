"""What can come next on the line: commands, openings of sentences, and the names of this world."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from prompt_toolkit.completion import CompleteEvent, Completer, Completion
from prompt_toolkit.document import Document

from executive.frontends.prompt.command import Command
from intents.vocabulary import Vocabulary

OPENINGS = (
    "pick up", "put", "bring", "go to", "walk", "turn left", "turn right", "look at", "find",
    "count", "say", "wait", "squat", "stand on your left leg", "stand on your right leg",
    "what can you do?", "what are you holding?", "where are you?",
)  # fmt: skip
"""How sentences begin; there are more, see `docs/intents.md`."""


class LineCompleter(Completer):
    """Completes a command and its argument, or the words of a sentence."""

    def __init__(self, commands: Iterable[Command], vocabulary: Vocabulary) -> None:
        """Complete from the table of commands and the names of a world."""
        self._commands = {command.name: command for command in commands}
        self._names = sorted(set(names(vocabulary)), key=lambda name: (len(name), name))

    def get_completions(
        self,
        document: Document,
        complete_event: CompleteEvent,  # noqa: ARG002, prompt_toolkit's signature
    ) -> Iterator[Completion]:
        """What fits before the cursor, commands first."""
        text = document.text_before_cursor.lstrip()
        first, space, rest = text.partition(" ")
        if not space:
            for command in self._commands.values():
                if command.name.startswith(first.casefold()):
                    yield Completion(
                        command.name, -len(first), display_meta=command.summary,
                    )  # fmt: skip
        yield from _prefixed(OPENINGS, text)
        command = self._commands.get(first.casefold())
        if command is not None and space:
            yield from _prefixed(tuple(command.choices()), rest)
        if space and (command is None or command.takes_sentence):
            yield from _named(self._names, text)


def names(vocabulary: Vocabulary) -> Iterator[str]:
    """Every name by which something in a world is called."""
    for thing in vocabulary.objects:
        yield from (thing.name, *thing.synonyms)
        if thing.color:
            yield f"{thing.color} {thing.name}"
    for spot in (*vocabulary.places, *vocabulary.rooms):
        yield from (spot.name, *spot.synonyms)
    for someone in vocabulary.people:
        yield someone.name


def _prefixed(choices: tuple[str, ...], typed: str) -> Iterator[Completion]:
    for choice in choices:
        if choice.startswith(typed.casefold()) and choice != typed:
            yield Completion(choice, -len(typed))


def _named(known: list[str], text: str) -> Iterator[Completion]:
    """Names of which the last words of a text are the beginning, the longest match first."""
    words = text.split(" ")
    offered: set[str] = set()
    for first in range(max(0, len(words) - 4), len(words)):
        tail = " ".join(words[first:])
        if not tail:
            continue
        for name in known:
            if name.casefold().startswith(tail.casefold()) and name not in offered:
                offered.add(name)
                if name.casefold() != tail.casefold():
                    yield Completion(name, -len(tail))
