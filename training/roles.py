"""What the names of a sentence are to what it asks for, out of the goals that are meant."""

from typing import Any, NamedTuple

from intents.english.learnt.looks import Said, said
from intents.english.learnt.roles import NOTHING, OTHER, mentions
from intents.english.words.names import NameIndex
from training.marked import Marked

_ME = "(me)"
Roles = dict[str, str]


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
    for role, name in roles.items():
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
    """What one goal asks for and the name of each role; None if it is not to be said again."""
    if gold == "ask":
        return "ask", None
    if isinstance(gold, str) or len(gold) != 1:
        return OTHER, None
    goal = gold[0]
    kind = goal["goal"]
    thing, person = goal.get("object") or {}, goal.get("person") or {}
    what, who = thing.get("name") or thing.get("category"), _who(person)
    source = thing.get("at") or person.get("at")
    if "relation" in thing:
        return OTHER, None
    match kind:
        case "bring" | "give":
            told = ("bring", {"what": what, "from": source, "to": _who(goal.get("to"))})
        case "place":
            told = (kind, {"what": what, "from": source, "to": goal.get("on") or goal.get("in")})
        case "pick" | "find" | "count":
            told = (kind, {"what": what, "who": who, "from": source})
        case "go_to" if isinstance(goal.get("place"), str):
            told = (kind, {"to": _ME if goal["place"] == "operator" else goal["place"]})
        case "guide" | "follow":
            told = (kind, {"who": who, "from": source, "to": goal.get("to")})
        case "greet" if who not in (None, _ME):
            told = (kind, {"who": who, "from": source})
        case "switch":
            told = ("switch_on" if goal["on"] else "switch_off", {"what": goal["what"]})
        case "open" | "close":
            told = (kind, {"what": goal["what"]})
        case _:
            return OTHER, None
    act, roles = told
    return act, {role: name for role, name in roles.items() if isinstance(name, str)}


def _who(to: Any) -> str | None:
    """A place, or the name of a person."""
    if not isinstance(to, dict):
        return to
    return _ME if to.get("who") else to.get("name")
