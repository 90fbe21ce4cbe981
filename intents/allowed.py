"""What goals may hold, whoever made them: names of the vocabulary, numbers within ranges.

The grammar keeps to this by how it is built; what a language model says is checked here, after
its types have been.
"""

from collections.abc import Iterator
from math import isfinite, pi
from typing import cast

import msgspec

from intents import goals as g
from intents.english.words.lexer import singular
from intents.goals import OPERATOR, Goal, ObjectQuery, Person
from intents.vocabulary import Vocabulary

MAX_GOALS, MAX_DEPTH, MAX_TIMES, MAX_COUNT = 30, 4, 100, 100
MAX_WALK_M, MAX_TURN_RAD, MAX_TIME_S = 50.0, 20 * pi, 86400.0
MAX_SPOKEN = 300
MOST_LISTED = 40
"""Names that are told where one is not known."""
DIRECTIONS = g.DIRECTIONS
GESTURES = (
    "wave", "point", "nod", "shake_head", "bow", "thumbs_up", "clap", "shrug", "dance",
    "shake_hands", "high_five", "cross_arms", "raise_arm", "raise_left_arm", "raise_right_arm",
    "raise_both_arms", "lower_arm", "lower_left_arm", "lower_right_arm", "lower_both_arms",
)  # fmt: skip
PERSON_GESTURES = (
    "waving", "raising arm", "raising left arm", "raising right arm", "pointing left",
    "pointing right", "pointed at",
)  # fmt: skip
PROPERTIES = ("name", "posture", "gesture", "gender", "color", "size", "location", "category",
              "description", "clothes", "age")  # fmt: skip
ANSWERS = ("question", "quiz")
STEERING = (g.Stop, g.Pause, g.Resume, g.Cancel)
"""Goals that steer the jobs under way: a person says them, and the grammar reads them."""
_DEVICES = ("hand", "door", "drawer", "fridge", "cabinet", "window", "light", "lamp")


class Names:
    """The names that goals may hold.

    Attributes:
        objects: Of objects, and of furniture that can be looked at.
        spots: Of places and rooms, and the operator.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        self.things = frozenset(thing.name for thing in vocabulary.objects)
        furniture = frozenset(spot.name for spot in (*vocabulary.places, *vocabulary.rooms))
        self.objects = self.things | furniture
        self.spots = self.things | furniture | {OPERATOR}
        self.people = frozenset(person.name for person in vocabulary.people)
        self.categories = frozenset(c.singular for c in vocabulary.categories) | frozenset(
            thing.category for thing in vocabulary.objects if thing.category
        )
        self.devices = self.objects | set(_DEVICES)


def fault(goals: tuple[Goal, ...], vocabulary: Vocabulary) -> str:
    """What is wrong with goals, in words that help to mend it; empty if nothing is."""
    names = Names(vocabulary)
    if not goals:
        return "there are no goals"
    for depth, goal in _each(goals):
        if depth > MAX_DEPTH:
            return f"goals are nested more than {MAX_DEPTH} deep"
        found = _fault_of(goal, names)
        if found:
            return found
    if sum(1 for _ in _each(goals)) > MAX_GOALS:
        return f"there are more than {MAX_GOALS} goals"
    return ""


def excess(goals: tuple[Goal, ...]) -> str:
    """Which number in goals is beyond what makes sense, in words; empty if none is."""
    for _, goal in _each(goals):
        for slot in goal.__struct_fields__:
            found = _fault_of_number(slot, getattr(goal, slot))
            if found:
                return f"“{slot.removesuffix('_s')}” {found}" if slot != "by" else f"That {found}"
    return ""


def steering(goals: tuple[Goal, ...]) -> str:
    """What is wrong with goals that a person alone may say; empty if none of them is."""
    found = next((goal for goal in g.each(goals) if isinstance(goal, STEERING)), None)
    return f"{type(found).__name__.lower()} is for a person to say" if found else ""


def _each(goals: tuple[Goal, ...], depth: int = 1) -> Iterator[tuple[int, Goal]]:
    for goal in goals:
        yield depth, goal
        if depth > MAX_DEPTH:
            continue
        for slot in ("goals", "then", "else_"):
            yield from _each(cast("tuple[Goal, ...]", getattr(goal, slot, ())), depth + 1)


def _fault_of(goal: Goal, names: Names) -> str:
    kind = type(goal).__name__
    for slot in goal.__struct_fields__:
        value = getattr(goal, slot)
        found = _fault_in(value, names) if slot not in ("goals", "then", "else_") else ""
        found = found or _fault_of_slot(kind, slot, value, names)
        if found:
            return f"{kind}.{slot.rstrip('_')}: {found}"
    if isinstance(goal, g.GoTo) and [goal.place, goal.pose, goal.by].count(None) != 2:
        return "GoTo: exactly one of place, pose and by is to be set"
    return ""


def _fault_in(value: object, names: Names) -> str:
    """What is wrong with a value that stands anywhere: objects, people, numbers."""
    if isinstance(value, float):
        return "" if isfinite(value) else "is not finite"
    if isinstance(value, ObjectQuery):
        return _fault_of_object(value, names)
    if isinstance(value, Person):
        return _fault_of_person(value, names)
    if isinstance(value, g.State) and value.what not in names.devices:
        return _unknown(value.what, names.devices)
    if isinstance(value, msgspec.Struct):
        parts = (_fault_in(getattr(value, slot), names) for slot in value.__struct_fields__)
        return next((part for part in parts if part), "")
    return ""


def _fault_of_object(query: ObjectQuery, names: Names) -> str:
    if isinstance(query.count, int) and not 0 < query.count <= MAX_COUNT:
        return f"count is not from 1 to {MAX_COUNT}"
    for said, known in (
        (query.name, names.objects), (query.category, names.categories), (query.at, names.spots),
    ):  # fmt: skip
        if said is not None and said not in known:
            return _unknown(said, known)
    if any(not _is_word(word) for word in (query.color, query.size) if word is not None):
        return "colour and size are one word each"
    inner = (query.relation, query.except_)
    return next((fault for one in inner if one and (fault := _fault_in(one, names))), "")


def _fault_of_person(person: Person, names: Names) -> str:
    if isinstance(person.count, int) and not 0 < person.count <= MAX_COUNT:
        return f"count is not from 1 to {MAX_COUNT}"
    if person.name is not None and person.name not in names.people:
        return _unknown(person.name, names.people)
    if person.at is not None and person.at not in names.spots:
        return _unknown(person.at, names.spots)
    if person.gesture is not None and person.gesture not in PERSON_GESTURES:
        return _unknown(person.gesture, PERSON_GESTURES)
    worn = person.wearing
    words = [w for w in (worn.color, worn.item) if w] if worn else []
    return "clothes are named in one word" if any(not _is_word(w) for w in words) else ""


def _is_word(text: str) -> bool:
    return text.replace(" ", "").replace("-", "").isalpha() and len(text) <= 20


def _fault_of_slot(kind: str, slot: str, value: object, names: Names) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        known = _strings_of(kind, slot, names)
        if known is None:
            return _fault_of_speech(value)
        return "" if value in known else _unknown(value, known)
    return _fault_of_number(slot, value)


def _fault_of_number(slot: str, value: object) -> str:
    if value is None:
        return ""
    if slot == "times" and not 0 < cast("int", value) <= MAX_TIMES:
        return f"is not from 1 to {MAX_TIMES}"
    if slot == "duration_s" and not 0.0 <= cast("float", value) <= MAX_TIME_S:
        return f"is not from 0 to {MAX_TIME_S:g} s"
    if isinstance(value, g.Displacement):
        lengths = (value.forward_m or 0.0, value.left_m or 0.0)
        if max(map(abs, lengths)) > MAX_WALK_M:
            return f"is more than {MAX_WALK_M:g} m"
        return "is more than ten turns" if abs(value.turn_rad or 0.0) > MAX_TURN_RAD else ""
    if isinstance(value, g.Pose2):
        return "is too far" if max(abs(value.x_m), abs(value.y_m)) > 1e3 else ""
    return ""


def _strings_of(kind: str, slot: str, names: Names) -> frozenset[str] | tuple[str, ...] | None:
    """What a slot may say; None where it holds words to be spoken."""
    if slot == "what":
        return None if kind in ("Say", "Ask") else ANSWERS if kind == "Answer" else names.devices
    if slot in ("kind", "property", "mode", "side", "topic"):
        return {"kind": GESTURES, "property": PROPERTIES}.get(slot, _CLOSED)
    if slot == "at":
        return names.spots | names.people
    if kind == "LookAt":
        return names.spots | set(DIRECTIONS)
    return names.spots


_CLOSED = (
    "stand", "squat", "one_leg", "lean", "sit", "left", "right", "forward", "backward", "holding",
    "seeing", "location", "status", "health", "why", "capabilities",
)  # fmt: skip


def _fault_of_speech(text: str) -> str:
    if len(text) > MAX_SPOKEN:
        return f"is longer than {MAX_SPOKEN} characters"
    return "" if text.strip() and text.isprintable() else "is not printable text"


def spoken(text: str) -> str:
    """Text that may be shown or spoken: printable, and not too long."""
    return "".join(c if c.isprintable() else " " for c in text).strip()[:MAX_SPOKEN]


def _unknown(said: str, known: frozenset[str] | set[str] | tuple[str, ...]) -> str:
    alike = [name for name in sorted(known) if singular(name.lower()) == singular(said.lower())]
    if alike:
        return f"{said[:60]!r} is not known; did you mean {alike[0]!r}?"
    more = f" and {len(known) - MOST_LISTED} more" if len(known) > MOST_LISTED else ""
    return f"{said[:60]!r} is not known; known: {', '.join(sorted(known)[:MOST_LISTED])}{more}"
