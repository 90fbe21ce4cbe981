"""What a mission file may hold, as types: the reader checks against them.

A step is a sentence, or a mapping with one key that says what is done (`pick`, `repeat`, ...), keys
that belong to it, and options that every step may have. Each kind of step is one struct here; its
first field is the key that it is known by.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal, TypeAlias, get_args

import msgspec
from msgspec import Meta

from executive.skills.navigate import MAX_DISPLACEMENT_M, MAX_TURN_RAD
from executive.skills.parameters import MAX_DURATION_S
from intents import goals
from robot.files.yaml_nodes import Node

Parameter: TypeAlias = Annotated[
    str, Meta(pattern=r"^\{\{ *[a-z][a-z0-9_]* *\}\}$", description="A parameter of the mission.")
]
Number: TypeAlias = float | Parameter
MAX_ROUNDS = 1000
MAX_TRIES = 100
Rounds: TypeAlias = Annotated[int, Meta(ge=1, le=MAX_ROUNDS)]
Tries: TypeAlias = Annotated[int, Meta(ge=1, le=MAX_TRIES)]
DAY_S = 86_400.0
Limit: TypeAlias = Annotated[float, Meta(gt=0.0, le=DAY_S)]
"""A longest time [s]."""
Span: TypeAlias = Annotated[float, Meta(ge=0.0, le=MAX_DURATION_S)]
Displacement: TypeAlias = Annotated[float, Meta(ge=-MAX_DISPLACEMENT_M, le=MAX_DISPLACEMENT_M)]
Turn: TypeAlias = Annotated[float, Meta(ge=-MAX_TURN_RAD, le=MAX_TURN_RAD)]
TurnDegrees: TypeAlias = Annotated[
    float, Meta(ge=-math.degrees(MAX_TURN_RAD), le=math.degrees(MAX_TURN_RAD))
]

ParameterType = Literal[
    "object", "objects", "place", "places", "person", "text", "number", "integer", "flag"
]
Value: TypeAlias = str | float | int | bool | list[str]
"""Of a parameter: names of things and places, texts, numbers, true and false."""


class StepNode:
    """A step in a file, read when its turn comes; in the schema any kind of step."""


class BranchNode:
    """A branch of a `parallel`: a step, or a list of steps."""


class FaultNode:
    """A fault on purpose, read when robot and world are known."""


Steps: TypeAlias = tuple[StepNode, ...]


class Record(
    msgspec.Struct,
    frozen=True,
    kw_only=True,
    forbid_unknown_fields=True,
    rename={"in_": "in", "else_": "else", "if_": "if", "while_": "while", "with_": "with",
            "not_": "not"},
):  # fmt: skip
    """A mapping with known keys."""

    @classmethod
    def words(cls, key: str, node: Node) -> tuple[str, ...] | None:
        """The words that may stand at a key beside the others there; None: those of its type."""
        del key, node
        return None


# --- the file -----------------------------------------------------------------------------------


class LimitsRecord(Record, frozen=True, kw_only=True):
    """What the whole mission may take; what is done `always` comes on top."""

    duration_s: Annotated[Limit, Meta(description="Longest time at work [s].")] | None = None
    speed_m_s: Annotated[float, Meta(gt=0, description="Fastest walk [m/s].")] | None = None


class ParameterRecord(Record, frozen=True, kw_only=True):
    """Something that may differ from run to run: `{{name}}` stands for it."""

    type: ParameterType
    default: Annotated[Value, Meta(description="Without one it has to be given.")] | None = None
    about: Annotated[str, Meta(description="For people.")] = ""


ROBOT = "juno"
"""Of a mission that names none."""


class MissionRecord(Record, frozen=True, kw_only=True):
    """A mission."""

    name: Annotated[str, Meta(min_length=1, max_length=100, description="For people.")]
    steps: Annotated[Steps, Meta(min_length=1, description="What is done, in this order.")]
    about: Annotated[str, Meta(description="What it is for.")] = ""
    world: Annotated[str, Meta(description="A shipped world, or a file beside this one.")] = (
        "kitchen"
    )
    robot: Annotated[str, Meta(description="A shipped robot, or a file beside this one.")] = ROBOT
    limits: LimitsRecord = LimitsRecord()
    parameters: dict[str, ParameterRecord] = {}
    always: Annotated[Steps, Meta(description="Done after the steps, however they end.")] = ()
    expect: Annotated[
        tuple[ConditionRecord | str, ...], Meta(description="What has to be so at the end.")
    ] = ()
    faults: Annotated[
        tuple[FaultNode, ...],
        Meta(description="What goes wrong on purpose; in simulation only."),
    ] = ()


# --- conditions ---------------------------------------------------------------------------------


class ConditionRecord(Record, frozen=True, kw_only=True):
    """What may be so; a sentence says the same ("the red cup is on the table").

    `seen` (with `on`) is about an object, `holding` about the hands (true and false: anything),
    `robot_at` about where the robot stands; `not` turns another condition round, `all` and `any`
    join several.
    """

    seen: Annotated[str, Meta(description="An object whose whereabouts are known.")] | None = None
    on: Annotated[str, Meta(description="The place where it is.")] | None = None
    holding: Annotated[str | bool, Meta(description="An object in a hand.")] | None = None
    robot_at: Annotated[str, Meta(description="A place within reach, or a room.")] | None = None
    not_: ConditionRecord | str | None = None
    all: tuple[ConditionRecord | str, ...] | None = None
    any: tuple[ConditionRecord | str, ...] | None = None


Condition: TypeAlias = ConditionRecord | str


# --- steps: what they have in common ------------------------------------------------------------


class StepRecord(Record, frozen=True, kw_only=True):
    """The options of every step."""

    name: Annotated[str, Meta(description="For people and the journal.")] | None = None
    retry: (
        Annotated[Tries | Parameter, Meta(description="How often it is tried again if it fails.")]
        | None
    ) = None
    timeout_s: (
        Annotated[Limit | Parameter, Meta(description="Longest time, all its tries together [s].")]
        | None
    ) = None
    on_fail: (
        Annotated[
            dict[str, Steps],
            Meta(description="What else is done, by failure code (`any`: all others)."),
        ]
        | None
    ) = None
    always: Annotated[Steps, Meta(description="Done after it, however it ends.")] | None = None


# --- steps: one goal each -----------------------------------------------------------------------


class PoseSlots(Record, frozen=True, kw_only=True):
    """A pose on the floor."""

    x_m: Number
    y_m: Number
    yaw_rad: Turn | Parameter | None = None
    yaw_deg: TurnDegrees | Parameter | None = None


class DisplacementSlots(Record, frozen=True, kw_only=True):
    """A motion relative to where the robot stands: first turn, then walk."""

    forward_m: Displacement | Parameter | None = None
    left_m: Displacement | Parameter | None = None
    turn_rad: Turn | Parameter | None = None
    turn_deg: TurnDegrees | Parameter | None = None


class GoToSlots(Record, frozen=True, kw_only=True):
    """Where to: exactly one of them."""

    place: str | None = None
    person: str | None = None
    pose: PoseSlots | None = None
    by: DisplacementSlots | None = None


class ObjectSlots(Record, frozen=True, kw_only=True):
    """Which object, and where it is."""

    object: str
    at: str | None = None


class PlaceSlots(Record, frozen=True, kw_only=True):
    """Which object where: `on` or `in`."""

    object: str = "it"
    on: str | None = None
    in_: str | None = None


class BringSlots(Record, frozen=True, kw_only=True):
    """Which object where to, or to whom."""

    object: str
    to: str
    at: str | None = None


class TargetSlots(Record, frozen=True, kw_only=True):
    """An object, a person or a place: exactly one of them."""

    object: str | None = None
    person: str | None = None
    place: str | None = None
    at: str | None = None


class PersonSlots(Record, frozen=True, kw_only=True):
    """Who."""

    person: str


class BalanceSlots(Record, frozen=True, kw_only=True):
    """Which posture, for how long."""

    mode: goals.BalanceMode
    side: goals.Side | None = None
    duration_s: Span | Parameter | None = None

    @classmethod
    def words(cls, key: str, node: Node) -> tuple[str, ...] | None:
        """A leg is left or right, a lean goes to any side, and nothing else has one."""
        mode = node.get("mode")
        if key != "side" or mode is None or mode.text not in get_args(goals.BalanceMode):
            return None
        return {"one_leg": ("left", "right"), "lean": get_args(goals.Side)}.get(mode.text, ())


class WaitSlots(Record, frozen=True, kw_only=True):
    """For how long."""

    duration_s: Span | Parameter


class GoToStep(StepRecord, frozen=True, kw_only=True):
    """Walk to a place or a person, to a pose, or some way from here."""

    go_to: str | GoToSlots


class FindStep(StepRecord, frozen=True, kw_only=True):
    """Look for an object or a person until it is seen."""

    find: str | TargetSlots


class PickStep(StepRecord, frozen=True, kw_only=True):
    """Take an object and hold it."""

    pick: str | ObjectSlots


class PlaceStep(StepRecord, frozen=True, kw_only=True):
    """Put an object on or in a place."""

    place: PlaceSlots


class BringStep(StepRecord, frozen=True, kw_only=True):
    """Fetch an object and put it down at a place, or hand it to a person."""

    bring: BringSlots


class LookAtStep(StepRecord, frozen=True, kw_only=True):
    """Turn the head towards an object, a person or a place."""

    look_at: str | TargetSlots


class GreetStep(StepRecord, frozen=True, kw_only=True):
    """Say hello to a person."""

    greet: str | PersonSlots


class MeetStep(StepRecord, frozen=True, kw_only=True):
    """Go up to a person and say hello."""

    meet: str | PersonSlots


class SayStep(StepRecord, frozen=True, kw_only=True):
    """Say something."""

    say: str


class CountStep(StepRecord, frozen=True, kw_only=True):
    """Count objects and say how many."""

    count: str | ObjectSlots


class BalanceStep(StepRecord, frozen=True, kw_only=True):
    """Take a posture and hold it."""

    balance: goals.BalanceMode | BalanceSlots


class WaitStep(StepRecord, frozen=True, kw_only=True):
    """Do nothing for some seconds."""

    wait: Span | Parameter | WaitSlots


class ReportStep(StepRecord, frozen=True, kw_only=True):
    """Say something about the robot itself."""

    report: goals.ReportTopic


# --- steps: structure ---------------------------------------------------------------------------


class DoStep(StepRecord, frozen=True, kw_only=True):
    """Several steps as one, to give them options together."""

    do: Annotated[Steps, Meta(min_length=1)]


class ParallelStep(StepRecord, frozen=True, kw_only=True):
    """Several things at the same time, where they need different parts of the body."""

    parallel: Annotated[tuple[BranchNode, ...], Meta(min_length=2)]


class IfStep(StepRecord, frozen=True, kw_only=True):
    """One thing or another, as a condition holds when its turn comes."""

    if_: Condition
    then: Steps
    else_: Steps = ()


class RepeatStep(StepRecord, frozen=True, kw_only=True):
    """The same several times."""

    repeat: Rounds | Parameter
    do: Annotated[Steps, Meta(min_length=1)]


class WhileStep(StepRecord, frozen=True, kw_only=True):
    """The same as long as a condition holds; it fails if that is so after `at_most` rounds."""

    while_: Condition
    at_most: Rounds | Parameter
    do: Annotated[Steps, Meta(min_length=1)]


class ForEachStep(StepRecord, frozen=True, kw_only=True):
    """The same with each of several things or places; `{{name}}` stands for it."""

    for_each: Annotated[str, Meta(description="The name for it.", pattern=r"^[a-z][a-z0-9_]*$")]
    in_: Annotated[
        str | tuple[str, ...],
        Meta(description="Names, or a description of objects such as `all cups`."),
    ]
    do: Annotated[Steps, Meta(min_length=1)]


class MissionStep(StepRecord, frozen=True, kw_only=True):
    """Another mission's steps: a file beside this one."""

    mission: str
    with_: dict[str, Value] = {}


class FailStep(StepRecord, frozen=True, kw_only=True):
    """Give up, and say why."""

    fail: str


GOALS: dict[str, type[StepRecord]] = {
    "go_to": GoToStep,
    "find": FindStep,
    "pick": PickStep,
    "place": PlaceStep,
    "bring": BringStep,
    "look_at": LookAtStep,
    "greet": GreetStep,
    "meet": MeetStep,
    "say": SayStep,
    "count": CountStep,
    "balance": BalanceStep,
    "wait": WaitStep,
    "report": ReportStep,
}
"""Steps that are one goal."""

STEPS: dict[str, type[StepRecord]] = {
    **GOALS,
    "parallel": ParallelStep,
    "if": IfStep,
    "repeat": RepeatStep,
    "while": WhileStep,
    "for_each": ForEachStep,
    "mission": MissionStep,
    "fail": FailStep,
    "do": DoStep,  # last: "do" belongs to others as well
}
"""The key that a step is known by to its type, in the order in which they are looked for."""

OPTIONS = ("name", "retry", "timeout_s", "on_fail", "always")
