"""The speech grammar of a world: `commands.jsgf`, with the names of a vocabulary in it."""

from __future__ import annotations

import importlib.resources
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable

from intents.numbers import plural
from intents.speech import jsgf
from intents.speech.automaton import Automaton
from intents.vocabulary import Thing, Vocabulary

SPOKEN, REPLY, CRY = "spoken", "reply", "short_cry"
"""Rules to begin with: a command; what may be said while a question is open; a cry to stop."""


def grammar(vocabulary: Vocabulary, root: str = SPOKEN, *, wake_word: str = "") -> Automaton:
    """Everything that can be said of the names of a vocabulary, as an automaton over words."""
    return jsgf.automaton(rules(vocabulary, wake_word=wake_word), root)


def rules(vocabulary: Vocabulary, *files: str, wake_word: str = "") -> dict[str, jsgf.Node]:
    """The rules of `commands.jsgf` and other files, with the names of a vocabulary in them."""
    found: dict[str, jsgf.Node] = {}
    for file in ("commands.jsgf", *files):
        source = importlib.resources.files("intents.speech").joinpath(file)
        found |= jsgf.read(source.read_text(encoding="utf-8"))
    names = _names(vocabulary)
    found["name"] = jsgf.words(*names)
    found["a_name"] = jsgf.words(*(f"{_article(name)} {name}" for name in names))
    found["names"] = jsgf.words(*_several(vocabulary))
    found["colour"] = jsgf.words(*_spoken(thing.color for thing in vocabulary.objects))
    places = (*vocabulary.places, *vocabulary.rooms)
    found["place"] = jsgf.words(*_spoken(n for p in places for n in (p.name, *p.synonyms)))
    people = vocabulary.people
    found["person"] = jsgf.words(*_spoken(n for p in people for n in (p.name, *p.synonyms)))
    drinks = any(category.singular == "drink" for category in vocabulary.categories)
    found["anything"] = jsgf.words(*(["something to drink"] if drinks else []))
    found["wake"] = jsgf.words(*_spoken([wake_word]))
    return found


def _names(vocabulary: Vocabulary) -> list[str]:
    """What objects are called: by name, with what tells one from others, by kind."""
    called: list[str] = []
    for thing in vocabulary.objects:
        for name in _names_of(thing):
            called += [name, f"{thing.color} {name}", f"{thing.size} {name}"]
    called += [category.singular for category in vocabulary.categories]
    return _spoken(called)


def _several(vocabulary: Vocabulary) -> list[str]:
    """What several objects are called: by name, by colour where several have it, by kind."""
    called = [category.plural for category in vocabulary.categories]
    looks = Counter(
        (thing.color, name) for thing in vocabulary.objects for name in _names_of(thing)
    )
    for (color, name), count in looks.items():
        called.append(plural(name))
        if count > 1:
            called.append(f"{color} {plural(name)}")
    return _spoken(called)


def _names_of(thing: Thing) -> tuple[str, ...]:
    return (thing.name, *thing.synonyms)


def _spoken(names: Iterable[str]) -> list[str]:
    """Names as they are spoken, each once: letters only, in lower case, without accents."""
    lower = (unicodedata.normalize("NFKD", name.lower()) for name in names)
    bare = ("".join(c for c in name if not unicodedata.combining(c)) for name in lower)
    plain = (" ".join(re.findall(r"[a-z']+|\d", name)) for name in bare)
    return sorted({name for name in plain if name})


def _article(name: str) -> str:
    return "an" if name[0] in "aeiou" else "a"
