"""Where things belong, as it is told behind an order: "put the cup away, *it lives in the box*"."""

from intents.english.frames.slots import Slots
from intents.english.frames.targets import Target, destination
from intents.english.phrases.complements import Clause, read_complements
from intents.english.phrases.referents import Scope
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.lexicon import phrases, words
from intents.english.words.text import Text

_THEY = words("it they that those these both")
_LIVES = phrases(
    "lives,live,goes,go,belongs,belong,should go,should all go,should both go,should be,"
    "should all be,should live,are supposed to go,is supposed to go,are meant to go,is meant to go,"
    "need to go,needs to go,need to be,needs to be,have to go,has to go,must go,want to go,"
    "wants to go,usually live,usually lives,normally live,normally lives,usually go,usually goes,"
    "always go,always goes,always live,always lives"
)
"""How it is said where something belongs."""
_COLLECTS = ("pick up", "gather", "gather up", "round up", "collect", "scoop up")


def home(clause: Clause, scope: Scope) -> Target | None:
    """Put it away, *it lives in the drawer*: where it belongs, told behind the order."""
    at = clause.end + (clause.text.word(clause.end) in (COMMA, FULL_STOP))
    told = told_home(clause.text, at, scope)
    return told and told[0]


def told_home(text: Text, at: int, scope: Scope) -> tuple[Target, int] | None:
    """Where what was spoken of belongs, and where that ends: *they all belong in the box*."""
    if at >= len(text) or text.word(at) not in _THEY:
        return None
    lives = at + 1 + (text.word(at + 1) in ("all", "both"))
    start = text.phrase_end(_LIVES, lives)
    if start is None:
        return None
    complements, end = read_complements(text, start)
    target = destination(Slots(Clause(text, "put", "put", start, end, complements), scope))
    return (target, end) if target else None


def tidies_away(clause: Clause) -> bool:
    """Tidy away the mugs *in the hall*, they go on the rack: that is where they are."""
    away = "away" in clause.particles() or clause.verb == "tidy" or clause.verb.endswith("away")
    return away or collects(clause)


def collects(clause: Clause) -> bool:
    """Pick up the mugs *in the hall*, they go on the rack: from where they are to where they go."""
    things = clause.with_role("")
    placed = bool(things) and bool(things[0].phrases[-1:]) and bool(things[0].phrases[-1].places)
    return placed and clause.verb in _COLLECTS
