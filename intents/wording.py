"""Goals in words, to read back what was understood: "pick up the red cup, then ..."."""

from collections.abc import Iterable
from math import degrees

from msgspec.structs import replace

from intents import goals as g
from intents.goals import OPERATOR, Goal, ObjectQuery, Person
from intents.grounding import HOW_WORDS
from intents.numbers import plural

_PRONOUN = {"male": "a man", "female": "a woman", None: "a person"}
_GESTURES = {
    "thumbs_up": "give a thumbs up", "shake_head": "shake my head", "shake_hands": "shake hands",
    "cross_arms": "cross my arms", "high_five": "give a high five",
    "raise_both_arms": "raise both arms", "raise_arm": "raise an arm",
    "raise_left_arm": "raise my left arm", "raise_right_arm": "raise my right arm",
    "lower_both_arms": "lower both arms", "lower_arm": "lower an arm",
    "lower_left_arm": "lower my left arm", "lower_right_arm": "lower my right arm",
}  # fmt: skip
_REPORTS = {
    "holding": "say what I hold", "seeing": "say what I see", "location": "say where I am",
    "status": "say what I am doing", "remaining": "say how much longer I need",
    "operator": "say where you are", "health": "say how I am", "why": "say why I stopped",
    "capabilities": "say what I can do",
}  # fmt: skip
_PLAIN = {g.Stop: "stop", g.Pause: "pause", g.Resume: "go on", g.Cancel: "give the task up"}


def sentence_case(text: str) -> str:
    """A text with a capital at its beginning."""
    return text[:1].upper() + text[1:]


def in_words(goals: Iterable[Goal]) -> str:
    """What would be done, in one sentence without a full stop."""
    return ", then ".join(_goal(goal) for goal in goals) or "do nothing"


def thing(query: ObjectQuery) -> str:
    """A description with its article: "the red cup on the table", "all cups", "it"."""
    bare = query == ObjectQuery(held=query.held, at=query.at, count=query.count)
    if query.held and bare:
        return "it"
    noun = query.name or query.category or "thing"
    if isinstance(query.count, int) and query.count > 1:
        noun = plural(noun)
    words = " ".join(w for w in (query.superlative, query.size, query.color, noun) if w)
    first = {"all": "every", None: "the", 1: "a"}.get(query.count, str(query.count))
    first = "an" if first == "a" and words[0] in "aeiou" else first
    where = f" at {the(query.at)}" if query.at else ""
    if query.relation:
        where += f" {_beside(query.relation)}"
    if query.except_:
        other = query.except_
        nameless = other.name is None and other.category is None and not other.held
        where += f" except {thing(replace(other, name='one') if nameless else other)}"
    return f"{first} {words}{where}"


def _beside(relation: g.Relation) -> str:
    ends = [q for q in (relation.of, relation.other) if q is not None]
    return f"{HOW_WORDS[relation.how]} {' and '.join(map(thing, ends))}"


def _part(part: g.Part | None) -> str:
    """The other end of ..."""
    return f"the {part.replace('_', ' ')} of " if part else ""


def who(person: Person) -> str:
    """A person as one speaks of them to the operator: "you", "Ada in the kitchen"."""
    if person.who == OPERATOR:
        return "you"
    said = person.name or _PRONOUN[person.gender]
    if person.count is not None and not person.name:
        noun = {"male": "men", "female": "women", None: "people"}[person.gender]
        said = f"{'all' if person.count == 'all' else person.count} {noun}"
    worn = person.wearing
    traits = [person.posture, person.gesture]
    traits += ["in " + " ".join(w for w in (worn.color, worn.item) if w)] if worn else []
    traits += [f"at {the(person.at)}"] if person.at else []
    return " ".join([said, *(t for t in traits if t)])


def the(name: str) -> str:
    """A place with its article; the operator is "you"."""
    return "you" if name == OPERATOR else f"the {name}"


def _goal(goal: Goal) -> str:  # noqa: PLR0912 - one line a kind of goal
    match goal:
        case g.GoTo():
            return _go(goal)
        case g.Find():
            return f"look for {_subject(goal.object, goal.person)}"
        case g.Pick():
            return "pick it up" if thing(goal.object) == "it" else f"pick up {thing(goal.object)}"
        case g.Place(relation=g.Relation() as relation):
            return f"put {thing(goal.object)} {_beside(relation)}"
        case g.Place(on=None, in_=None):
            return "put it down" if thing(goal.object) == "it" else f"put down {thing(goal.object)}"
        case g.Place(in_=None):
            return f"put {thing(goal.object)} on {_part(goal.part)}{the(goal.on or '')}"
        case g.Place():
            return f"put {thing(goal.object)} into {the(goal.in_ or '')}"
        case g.Bring():
            to = the(goal.to) if isinstance(goal.to, str) else who(goal.to)
            return f"bring {thing(goal.object)} to {to}"
        case g.Give():
            return f"give {thing(goal.object)} to {who(goal.to)}"
        case g.Follow() | g.Guide():
            to = f" to {the(goal.to)}" if goal.to else ""
            verb = "follow" if isinstance(goal, g.Follow) else "guide"
            return f"{verb} {who(goal.person)}{to}"
        case g.Meet():
            return f"meet {who(goal.person)}"
        case g.Greet():
            return f"greet {who(goal.person)}"
        case g.Say():
            return f"say “{goal.what}”" + (f" to {who(goal.to)}" if goal.to else "")
        case g.Ask():
            told = f" and tell {who(goal.to)} the answer" if goal.to else ""
            return f"ask {who(goal.person)} “{goal.what}”{told}"
        case g.Answer():
            return f"answer the {goal.what}" + (f" of {who(goal.person)}" if goal.person else "")
        case g.Count():
            return f"count {_many(goal.object, goal.person)}"
        case g.Tell():
            subject = _subject(goal.object, goal.person)
            return f"tell {who(goal.to or Person(who='operator'))} the {goal.property} of {subject}"
        case g.LookAt():
            return f"look {goal.place}" if goal.place in _WAYS else f"look at {_looked_at(goal)}"
        case g.Open() | g.Close():
            return f"{'open' if isinstance(goal, g.Open) else 'close'} {the(goal.what)}"
        case g.Switch():
            return f"switch {'on' if goal.on else 'off'} {the(goal.what)}"
        case g.Balance():
            return _balance(goal)
        case g.Gesture():
            hand = f" with my {goal.side} hand" if goal.side else ""
            return _GESTURES.get(goal.kind, goal.kind) + _at(goal.at) + hand
        case g.Wait():
            return "wait" if goal.duration_s is None else f"wait {_seconds(goal.duration_s)}"
        case g.Report():
            return _REPORTS[goal.topic]
        case g.Repeat():
            return f"{goal.times} times: {in_words(goal.goals)}"
        case g.ForEach():
            each = thing(_each(goal.object))
            return f"for {each}: {in_words(goal.goals)}"
        case g.If():
            return _if(goal)
        case _:
            return _PLAIN[type(goal)]


_WAYS = ("left", "right", "up", "down", "ahead", "behind", "around")


def _each(query: ObjectQuery) -> ObjectQuery:
    return replace(query, count="all", held=False)


def _subject(query: ObjectQuery | None, person: Person | None) -> str:
    return thing(query) if query is not None else who(person or Person())


def _many(query: ObjectQuery | None, person: Person | None) -> str:
    if query is not None:
        return thing(_several(_each(query))).replace("every", "the", 1)
    return who(person or Person()).replace("a person", "the people", 1)


def _several(query: ObjectQuery) -> ObjectQuery:
    """The same, called by many: "cups"; what ends as many do stays ("scissors", "crisps")."""
    noun = query.name or query.category or "thing"
    many = noun if noun.endswith("s") and not noun.endswith("ss") else plural(noun)
    return replace(query, name=many)


def _looked_at(goal: g.LookAt) -> str:
    return the(goal.place) if goal.place else _subject(goal.object, goal.person)


def _at(name: str | None) -> str:
    if not name:
        return ""
    return " at you" if name == OPERATOR else f" at {name}"


def _seconds(duration_s: float) -> str:
    return f"{duration_s:g} s"


def _go(goal: g.GoTo) -> str:
    if goal.pose:
        return f"walk to x {goal.pose.x_m:g} m, y {goal.pose.y_m:g} m"
    by = goal.by
    if by is None:
        return f"go to {_part(goal.part)}{the(goal.place or '')}"
    parts: list[str] = []
    if by.turn_rad:
        parts.append(
            f"turn {abs(degrees(by.turn_rad)):.0f}° {'left' if by.turn_rad > 0 else 'right'}"
        )
    for value, plus, minus in ((by.forward_m, "forward", "back"), (by.left_m, "left", "right")):
        if value:
            parts.append(f"walk {abs(value):g} m {plus if value > 0 else minus}")
    return " and ".join(parts) or "stay here"


def _balance(goal: g.Balance) -> str:
    mode = {"one_leg": "stand on one leg", "stand": "stand", "sit": "sit down"}.get(goal.mode)
    mode = mode or goal.mode
    if goal.mode == "one_leg" and goal.side:
        mode = f"stand on my {goal.side} leg"
    elif goal.mode == "lean" and goal.side:
        mode = f"lean {goal.side}"
    return mode + (f" for {_seconds(goal.duration_s)}" if goal.duration_s else "")


def condition(holds: g.Condition) -> str:
    """A condition as a clause: "the cup is on the table"."""
    if isinstance(holds, g.AllOf | g.AnyOf):
        link = " and " if isinstance(holds, g.AllOf) else " or "
        return link.join(
            f"({condition(one)})" if isinstance(one, g.AllOf | g.AnyOf) else condition(one)
            for one in holds.of
        )
    no = " not" if holds.negated else ""
    if isinstance(holds, g.Present):
        return f"{_subject(holds.object, holds.person)} is{no} there"
    if isinstance(holds, g.Holding):
        return f"I do{no} hold {thing(holds.object)}"
    return f"{the(holds.what)} is{no} {holds.state}"


def _if(goal: g.If) -> str:
    other = f", otherwise {in_words(goal.else_)}" if goal.else_ else ""
    return f"if {condition(goal.condition)}, {in_words(goal.then)}{other}"
