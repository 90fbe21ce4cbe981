"""The closed set of things that can be asked of the robot.

A goal is a frozen value. Nothing else crosses from words to motion. As JSON a goal is
``{"goal": TYPE, ...slots}``, where TYPE is the class name in snake case and slots that were not
said are absent (``None`` in Python).

    >>> goals = (Pick(object=ObjectQuery(name="cup", color="red")),)
    >>> to_json(goals)
    '[{"goal":"pick","object":{"name":"cup","color":"red"}}]'
    >>> from_json(to_json(goals)) == goals
    True
"""

import builtins
import re
from collections.abc import Iterable, Iterator
from typing import Literal, cast

import msgspec

Superlative = Literal[
    "largest", "smallest", "heaviest", "lightest", "thinnest", "thickest", "tallest", "shortest",
    "leftmost", "rightmost", "nearest", "farthest", "highest", "lowest", "oldest", "youngest",
]  # fmt: skip
How = Literal[
    "on",
    "under",
    "above",
    "in",
    "behind",
    "in_front",
    "left",
    "right",
    "near",
    "between",
]
Part = Literal["middle", "edge", "other_end", "near_end", "left_end", "right_end"]
"""A part of a surface or a room; "other_end" is the far one."""
Side = Literal["left", "right", "forward", "backward"]
BalanceMode = Literal["stand", "squat", "one_leg", "lean", "sit"]
ReportTopic = Literal[
    "holding", "seeing", "location", "status", "remaining", "operator", "health", "why",
    "capabilities",
]  # fmt: skip
OPERATOR = "operator"
"""The person who speaks to the robot: ``Person(who="operator")``, and a place to come to."""


def snake_case(name: str) -> str:
    """The kind of a goal, from the name of its class."""
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()


class _Slots(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True,
             kw_only=True, rename={"in_": "in", "else_": "else", "except_": "except"}):  # fmt: skip
    """A record of slots, each of which may be left unsaid."""


class _Goal(_Slots, frozen=True, tag=snake_case, tag_field="goal", kw_only=True):
    """One thing to do."""


class ObjectQuery(_Slots, frozen=True, kw_only=True):
    """A description of an object, as it was said; grounding turns it into an id.

    Attributes:
        name: Name in the vocabulary, singular.
        category: Name of a category in the vocabulary, singular ("drink").
        color: Colour word ("red").
        size: Size word ("big", "small").
        superlative: Which of those that fit.
        count: How many, or "all"; 1 is any one ("a cup"), absent is the one that fits.
        at: Place or room where it is.
        relation: Where it is relative to another object.
        held: It is what the robot holds, or what was spoken of last ("it").
        except_: What is not meant, of what fits ("all cups but the red one").
    """

    name: str | None = None
    category: str | None = None
    color: str | None = None
    size: str | None = None
    superlative: Superlative | None = None
    count: int | Literal["all"] | None = None
    at: str | None = None
    relation: "Relation | None" = None
    held: bool = False
    except_: "ObjectQuery | None" = None


class Relation(_Slots, frozen=True, kw_only=True):
    """A place relative to another object: the cup *behind the bottle*.

    Attributes:
        other: The second of two things that something is between.
    """

    how: How
    of: ObjectQuery
    other: ObjectQuery | None = None


class Clothing(_Slots, frozen=True, kw_only=True):
    """Something worn; the item is singular ("shirt")."""

    color: str | None = None
    item: str | None = None


class Person(_Slots, frozen=True, kw_only=True):
    """A description of a person, as it was said.

    Attributes:
        who: "operator" for the one who speaks ("me", "us").
        name: Name in the vocabulary.
        gender: Said by "man", "girl" and the like.
        posture: "sitting", "standing" or "lying".
        gesture: "waving", "raising left arm", "pointing right" and the like.
        wearing: What is worn.
        superlative: Which of those that fit.
        count: How many, or "all"; absent means one.
        at: Place or room where the person is.
    """

    who: Literal["operator"] | None = None
    name: str | None = None
    gender: Literal["male", "female"] | None = None
    posture: Literal["sitting", "standing", "lying"] | None = None
    gesture: str | None = None
    wearing: Clothing | None = None
    superlative: Superlative | None = None
    count: int | Literal["all"] | None = None
    at: str | None = None


class Pose2(_Slots, frozen=True, kw_only=True):
    """A pose X_WB on the floor; without a heading any will do."""

    x_m: float
    y_m: float
    yaw_rad: float | None = None


class Displacement(_Slots, frozen=True, kw_only=True):
    """A motion relative to where the robot stands: first turn, then walk."""

    forward_m: float | None = None
    left_m: float | None = None
    turn_rad: float | None = None


class _OfSomething(_Goal, frozen=True, kw_only=True):
    """It has to do with an object or a person."""

    object: ObjectQuery | None = None
    person: Person | None = None


class GoTo(_Goal, frozen=True, kw_only=True):
    """Walk to a place (which may be "operator"), or by so much.

    Exactly one of place, pose and by is set; ``part`` is the part of the place.
    """

    place: str | None = None
    part: Part | None = None
    pose: Pose2 | None = None
    by: Displacement | None = None


class Find(_OfSomething, frozen=True, kw_only=True):
    """Look for an object or a person until it is seen."""


class Pick(_Goal, frozen=True, kw_only=True):
    """Take an object and hold it."""

    object: ObjectQuery


class Place(_Goal, frozen=True, kw_only=True):
    """Put an object on or in a place; without either, down where it can be.

    ``part`` is the part of the place; ``relation`` is where, relative to another object.
    """

    object: ObjectQuery
    on: str | None = None
    in_: str | None = None
    part: Part | None = None
    relation: Relation | None = None


class Bring(_Goal, frozen=True, kw_only=True):
    """Fetch an object and hand it over to a person or put it down at a place."""

    object: ObjectQuery
    to: Person | str


class Give(_Goal, frozen=True, kw_only=True):
    """Hand what is held to a person."""

    object: ObjectQuery
    to: Person


class Follow(_Goal, frozen=True, kw_only=True):
    """Walk behind a person, until they arrive if a place is given."""

    person: Person
    to: str | None = None


class Guide(_Goal, frozen=True, kw_only=True):
    """Lead a person to a place; ``person.at`` is where to collect them."""

    person: Person
    to: str | None = None


class Meet(_Goal, frozen=True, kw_only=True):
    """Go up to a person and get to know them."""

    person: Person


class Greet(_Goal, frozen=True, kw_only=True):
    """Say hello to a person, or introduce the robot to them."""

    person: Person


class Say(_Goal, frozen=True, kw_only=True):
    """Say something; ``what`` holds the words after "say" or "tell"."""

    what: str
    to: Person | None = None


class Ask(_Goal, frozen=True, kw_only=True):
    """Ask a person something and wait for the answer; ``what`` holds the words after "ask".

    With ``to`` the answer is then told to somebody.
    """

    person: Person
    what: str
    to: Person | None = None


class Answer(_Goal, frozen=True, kw_only=True):
    """Answer a question or a quiz of a person."""

    what: str
    person: Person | None = None


class Count(_OfSomething, frozen=True, kw_only=True):
    """Count objects or people and report the number."""

    to: Person | None = None


class Tell(_OfSomething, frozen=True, kw_only=True):
    """Find out a property of an object or a person and report it.

    In JSON the object or person is the slot ``of``.
    """

    property: str = "name"
    to: Person | None = None

    @builtins.property
    def of(self) -> ObjectQuery | Person:
        """Whose property it is."""
        return self.object or self.person or ObjectQuery()


DIRECTIONS = ("left", "right", "up", "down", "ahead", "behind", "around")
"""Ways to look, in `LookAt.place`: they are no places."""


class LookAt(_OfSomething, frozen=True, kw_only=True):
    """Turn the head towards an object, a person or a place."""

    place: str | None = None


class Open(_Goal, frozen=True, kw_only=True):
    """Open a door, a drawer, the hand."""

    what: str


class Close(_Goal, frozen=True, kw_only=True):
    """Close a door, a drawer, the hand."""

    what: str


class Switch(_Goal, frozen=True, kw_only=True):
    """Switch a device on or off."""

    what: str
    on: bool


class Balance(_Goal, frozen=True, kw_only=True):
    """Take and hold a posture; side is the leg stood on, or where to lean."""

    mode: BalanceMode
    side: Side | None = None
    duration_s: float | None = None


class Gesture(_Goal, frozen=True, kw_only=True):
    """Wave, point, nod, shake_head, bow, raise_arm, lower_arm ...; at says towards whom or what.

    ``side`` is the hand or arm it is done with.
    """

    kind: str
    at: str | None = None
    side: Side | None = None


class Wait(_Goal, frozen=True, kw_only=True):
    """Do nothing for a while; without a duration until told to go on."""

    duration_s: float | None = None


class Stop(_Goal, frozen=True, kw_only=True):
    """Stop moving, at once and safely."""


class Pause(_Goal, frozen=True, kw_only=True):
    """Hold the mission where it is."""


class Resume(_Goal, frozen=True, kw_only=True):
    """Go on with a paused mission."""


class Cancel(_Goal, frozen=True, kw_only=True):
    """Give the mission up."""


class Report(_Goal, frozen=True, kw_only=True):
    """Say something about the robot itself."""

    topic: ReportTopic


class Repeat(_Goal, frozen=True, kw_only=True):
    """Do the goals several times over."""

    times: int
    goals: "tuple[Goal, ...]"


class ForEach(_Goal, frozen=True, kw_only=True):
    """Do the goals once with each object; in them ``held`` means that object."""

    object: ObjectQuery
    goals: "tuple[Goal, ...]"


class Present(_Slots, frozen=True, tag="present", tag_field="is", kw_only=True):
    """Some object or person is there (or, negated, is not)."""

    object: ObjectQuery | None = None
    person: Person | None = None
    negated: bool = False


class Holding(_Slots, frozen=True, tag="holding", tag_field="is", kw_only=True):
    """The robot holds something that fits (or, negated, does not)."""

    object: ObjectQuery
    negated: bool = False


class State(_Slots, frozen=True, tag="state", tag_field="is", kw_only=True):
    """A door, drawer or device is open, closed, on, off, empty or full (negated: is not)."""

    what: str
    state: Literal["open", "closed", "on", "off", "empty", "full"]
    negated: bool = False


class AllOf(_Slots, frozen=True, tag="all", tag_field="is", kw_only=True):
    """Every one of several conditions holds."""

    of: "tuple[Condition, ...]"


class AnyOf(_Slots, frozen=True, tag="any", tag_field="is", kw_only=True):
    """At least one of several conditions holds."""

    of: "tuple[Condition, ...]"


Simple = Present | Holding | State
"""A condition of one thing."""
Condition = Simple | AllOf | AnyOf


def simple_conditions(condition: Condition) -> Iterator[Simple]:
    """What a condition is made of, in the order said."""
    if isinstance(condition, AllOf | AnyOf):
        for one in condition.of:
            yield from simple_conditions(one)
    else:
        yield condition


class If(_Goal, frozen=True, kw_only=True):
    """Do one thing or another, as a condition holds."""

    condition: Condition
    then: "tuple[Goal, ...]" = ()
    else_: "tuple[Goal, ...]" = ()


Goal = (
    GoTo | Find | Pick | Place | Bring | Give | Follow | Guide | Meet | Greet | Say | Ask
    | Answer
    | Count | Tell | LookAt | Open | Close | Switch | Balance | Gesture | Wait | Stop | Pause
    | Resume | Cancel | Report | Repeat | ForEach | If
)  # fmt: skip
"""Any goal."""


def each(goals: Iterable[Goal]) -> Iterator[Goal]:
    """Every goal, those inside of others included."""
    for goal in goals:
        yield goal
        for slot in ("goals", "then", "else_"):
            yield from each(cast("tuple[Goal, ...]", getattr(goal, slot, ())))


_PERSON_ONLY = frozenset({"who", "gender", "posture", "gesture", "wearing"})
_PERSON_PROPERTIES = frozenset({"posture", "pose", "gesture", "gender", "age", "clothes"})
_NESTED = ("goals", "then", "else")
_Plain = dict[str, object]


def to_builtins(goals: Iterable[Goal]) -> list[dict[str, object]]:
    """Goals as plain dicts and lists, in the form of the contract."""
    return [_outward(cast("_Plain", msgspec.to_builtins(goal))) for goal in goals]


def from_builtins(data: object, *, strict: bool = True) -> tuple[Goal, ...]:
    """Goals from plain dicts and lists; not ``strict``, "2" is a number as well.

    Raises:
        msgspec.ValidationError: Not a list of goals; the message says where and why.
    """
    return msgspec.convert(_inward(data), tuple[Goal, ...], strict=strict)


def to_json(goals: Iterable[Goal]) -> str:
    """Goals as one line of JSON."""
    return msgspec.json.encode(to_builtins(goals)).decode()


def from_json(text: str | bytes) -> tuple[Goal, ...]:
    """Goals from JSON.

    Raises:
        msgspec.DecodeError: Not JSON, or (ValidationError) not a list of goals.
    """
    return from_builtins(msgspec.json.decode(text))


def _outward(goal: _Plain) -> _Plain:
    """Merge the two subjects of a tell into "of", here and in nested goals.

    A person of whom nothing is said that tells them from an object stays in "person".
    """
    person = cast("_Plain", goal.get("person") or _Plain())
    if goal["goal"] == "tell" and "person" in goal and not _is_person(person, goal):
        return {"goal": "tell", "property": "name", **goal}
    if goal["goal"] == "tell":
        rest = {k: v for k, v in goal.items() if k not in ("goal", "object", "person")}
        subject = goal.get("object") or goal.get("person") or _Plain()
        return {"goal": "tell", "of": subject, "property": "name", **rest}
    return {
        k: [_outward(g) for g in cast("tuple[_Plain, ...]", v)] if k in _NESTED else v
        for k, v in goal.items()
    }


def _is_person(slots: Iterable[str], goal: _Plain) -> bool:
    """Whether the slots of "of" can only be a person's."""
    return bool(_PERSON_ONLY.intersection(slots)) or goal.get("property") in _PERSON_PROPERTIES


def _inward(data: object) -> object:
    """Undo :func:`_outward`; leaves what is malformed to the validator."""
    if isinstance(data, list):
        return [_inward(item) for item in cast("list[object]", data)]
    if not isinstance(data, dict):
        return data
    goal = cast("_Plain", data)
    if goal.get("goal") == "tell" and "of" in goal:
        rest = {k: v for k, v in goal.items() if k != "of"}
        of = goal["of"]
        keys: set[str] = set(cast("_Plain", of)) if isinstance(of, dict) else set()
        rest["person" if _is_person(keys, goal) else "object"] = cast("object", of)
        return rest
    plain: _Plain = {k: _inward(v) if k in _NESTED else v for k, v in goal.items()}
    return plain
