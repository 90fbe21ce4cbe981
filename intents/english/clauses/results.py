"""What is brought about: "the drawer open", "the lamp on"."""

from intents.english.frames.devices import device_names
from intents.english.phrases.complements import Complement, ends_clause
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import Scope
from intents.english.reading import Found
from intents.english.words.text import Text
from intents.goals import Close, Goal, Open, Switch

RESULTS: dict[str, tuple[type[Open | Close | Switch], bool]] = {
    "open": (Open, True), "closed": (Close, True), "shut": (Close, True), "on": (Switch, True),
    "going": (Switch, True), "running": (Switch, True), "started": (Switch, True),
    "off": (Switch, False), "out": (Switch, False), "stopped": (Switch, False),
}  # fmt: skip


def brought_about(text: Text, at: int, scope: Scope) -> Found | None:
    """The drawer open; the lamp on."""
    phrase = noun_phrase(text, at)
    if phrase is None:
        return None
    phrase.end += text.word(phrase.end) in ("is", "are", "being")
    made = text.word(phrase.end) in ("switched", "turned", "powered", "left", "put")
    phrase.end += made and text.word(phrase.end + 1) in ("on", "off", "open", "closed", "shut")
    return made_so(text, phrase, phrase.end, scope)


def made_so(
    text: Text, phrase: NounPhrase, at: int, scope: Scope, *, end: int | None = None
) -> Found | None:
    """What makes a thing what the word at ``at`` says, if the clause ends there or at ``end``."""
    result = RESULTS.get(text.word(at))
    end = at + 1 if end is None else end
    end = _past_favour(text, end)
    if result is None or not ends_clause(text, end):
        return None
    kind, on = result
    act = "switch" if kind is Switch else "open"
    names = device_names(Complement(phrases=[phrase]), scope, act)
    goals: list[Goal] = []
    for name in names:
        if kind is Switch:
            goals.append(Switch(what=name, on=on))
        else:
            goals.append(Open(what=name) if kind is Open else Close(what=name))
    return goals, end


def _past_favour(text: Text, at: int) -> int:
    """Crack it open *for me*."""
    return at + 2 if text.words[at : at + 2] in (["for", "me"], ["for", "us"]) else at
