"""What the names of a sentence are to what it asks for, out of the goals that are meant."""

from typing import Any, NamedTuple, cast

from intents.english.learnt.looks import Said, said
from intents.english.learnt.roles import ASK, IDLE, NOTHING, SEVERAL, act_of, mentions
from intents.english.words.names import NameIndex
from training.marked import Marked

_ME = "(me)"
Roles = list[tuple[str, str]]
"""What each name is, in the order of the goals."""


class Labelled(NamedTuple):
    """A sentence, what it asks for, and what each of its words is to that.

    ``roles`` is None where the goals name what the sentence does not.
    """

    text: str
    act: str
    roles: list[str] | None


def labelled(sentence: Marked, index: NameIndex) -> list[Labelled]:
    """A sentence without its background, and as it was said."""
    asked = " ".join(sentence.asked.split())
    act, roles = _of_goals(sentence.gold)
    found = [Labelled(asked, act, _by_word(said(asked), roles, index))] if _speaks(asked) else []
    if asked == sentence.text or not found:
        return found
    words = said(sentence.text)
    idle = {n for n, w in enumerate(words) if all(sentence.idle[w.start : w.end])}
    return [*found, Labelled(sentence.text, act, _by_word(words, roles, index, idle))]


def _speaks(text: str) -> bool:
    return any(c.isalnum() for c in text)


def _by_word(
    words: list[Said], roles: Roles | None, index: NameIndex, idle: set[int] | None = None
) -> list[str] | None:
    """The role of each word; None if not all names are found."""
    if roles is None:
        return None
    labels = [NOTHING] * len(words)
    told = [one for one in mentions(words, index) if one.start not in (idle or ())]
    used: set[int] = set()
    for role, name in roles:
        fits = [m for m in told if m.start not in used and (name in m.names or
                (name == _ME and not m.names))]  # fmt: skip
        if not fits and name != _ME:
            return None
        if fits:
            mention = fits[0 if name == _ME else -1]
            used.add(mention.start)
            labels[mention.start : mention.end] = [role] * (mention.end - mention.start)
    return labels


def _of_goals(gold: Any) -> tuple[str, Roles | None]:
    """What is asked for, and the name of each role; None where roles have nothing to say."""
    if isinstance(gold, str):
        return (ASK if gold == "ask" else IDLE), None
    told = [_roles(goal) for goal in gold]
    roles = list(dict.fromkeys(pair for pairs in told for pair in pairs or ()))
    act = act_of(gold[0]) if len(gold) == 1 else SEVERAL
    return act, None if None in told else roles


def _roles(goal: dict[str, Any]) -> Roles | None:
    thing: dict[str, Any] = goal.get("object") or {}
    person: dict[str, Any] = goal.get("person") or {}
    told: dict[str, Any]
    if "relation" in thing:
        return None
    what, who = thing.get("name") or thing.get("category"), _who(person)
    source = thing.get("at") or person.get("at")
    match goal["goal"]:
        case "bring" | "give":
            told = {"what": what, "from": source, "to": _who(goal.get("to"))}
        case "place":
            told = {"what": what, "from": source, "to": goal.get("on") or goal.get("in")}
        case "pick" | "find" | "count" | "greet" | "meet":
            told = {"what": what, "who": who, "from": source}
        case "go_to":
            place = goal.get("place")
            told = {"to": _ME if place == "operator" else place}
        case "guide" | "follow":
            told = {"who": who, "from": source, "to": goal.get("to")}
        case "look_at":
            told = {"what": what, "who": who, "to": goal.get("place")}
        case "gesture":
            told = {"who": _who(goal.get("at"))}
        case "tell":
            of: dict[str, Any] = goal.get("of") or {}
            told = {"what": of.get("name") or of.get("category"), "from": of.get("at")}
        case "switch" | "open" | "close":
            told = {"what": goal["what"]}
        case _:
            return None
    return [(role, name) for role, name in told.items() if isinstance(name, str)]


def _who(to: Any) -> str | None:
    """A place, or the name of a person."""
    if not isinstance(to, dict):
        return to
    told = cast("dict[str, Any]", to)
    return _ME if told.get("who") else told.get("name")
