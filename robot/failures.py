"""What a robot could not do, as values, and the catalogue of them with the words that people read.

A failure is an expected outcome of asking a robot to do something: a value with a code out of one
catalogue, chosen by code for recovery, and shown to people with its cause and a suggestion.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec


class Failure(msgspec.Struct, frozen=True, kw_only=True):
    """Why something asked for was not done.

    Attributes:
        code: an entry of `CATALOGUE`; recovery is chosen by it.
        cause: one sentence with the particulars, for people.
        evidence: the measurements behind it, name to value (units in the names).
        suggestion: what a person could do about it.
    """

    code: str
    cause: str
    evidence: dict[str, float | str] = {}
    suggestion: str = ""

    def __post_init__(self) -> None:
        """Refuse a code that the catalogue does not have."""
        if self.code not in CATALOGUE:
            raise ValueError(f"unknown failure code {self.code!r}")


Spoilt: TypeAlias = Literal["look", "thing", "robot", "system"]
"""How far a failure reaches. "look": that one look came to nothing, the next may still find it.
"thing": what was to be done with one thing; the others get their turn. "robot": all that is left,
since the robot itself cannot go on. "system": the same, and it is this software that broke, not the
task: the exit status says so."""


class FailureKind(msgspec.Struct, frozen=True):
    """An entry of the catalogue: what a code means, and what a person can usually do.

    Attributes:
        meaning: for people.
        suggestion: what they can do about it.
        spoils: how much of what was asked for it ends.
    """

    meaning: str
    suggestion: str
    spoils: Spoilt


CATALOGUE: dict[str, FailureKind] = {
    # words and goals
    "unknown_object": FailureKind(
        "no such object in this world", "name one of the objects that are there", spoils="thing"
    ),
    "unknown_place": FailureKind(
        "no such place in this world", "name one of the places that are there", spoils="thing"
    ),
    "ambiguous": FailureKind("more than one thing fits", "say which one", spoils="thing"),
    "unsupported": FailureKind(
        "this robot has no skill for that", "ask what it can do", spoils="thing"
    ),
    "invalid_goal": FailureKind(
        "the goal is out of range or contradicts itself", "check the numbers", spoils="thing"
    ),
    # planning
    "no_path": FailureKind(
        "no free path leads to the place", "clear the way or name another place", spoils="look"
    ),
    "start_in_collision": FailureKind(
        "the robot touches something where it stands", "move it into free space", spoils="thing"
    ),
    "goal_in_collision": FailureKind(
        "the goal is inside an obstacle", "free the place", spoils="look"
    ),
    "out_of_reach": FailureKind(
        "the hand cannot reach there", "move the object nearer", spoils="thing"
    ),
    "no_grasp": FailureKind(
        "no grasp holds this shape", "hand over something at most 9 cm wide", spoils="thing"
    ),
    "no_stance": FailureKind(
        "no free place to stand within reach", "clear the floor in front of it", spoils="look"
    ),
    "no_free_spot": FailureKind(
        "the place has no free spot of that size", "clear the place", spoils="thing"
    ),
    "planner_timeout": FailureKind(
        "the planner ran out of its budget", "try again, or simplify", spoils="thing"
    ),
    # acting
    "path_blocked": FailureKind("something stands in the way", "clear the way", spoils="look"),
    "walk_stalled": FailureKind(
        "walking made no progress", "look for what holds the robot", spoils="look"
    ),
    "grasp_missed": FailureKind(
        "the fingers closed on air", "check where the object is", spoils="thing"
    ),
    "wrong_object": FailureKind(
        "what was taken is another thing", "show it to the camera", spoils="thing"
    ),
    "object_dropped": FailureKind("the object left the hand", "check the object", spoils="thing"),
    "object_not_seen": FailureKind(
        "the object is not where it was", "show it to the camera", spoils="look"
    ),
    "place_not_seen": FailureKind(
        "a place could not be looked over", "clear the view of it", spoils="look"
    ),
    "not_made_out": FailureKind(
        "something has no name and may be what was asked for", "say what it is", spoils="look"
    ),
    "on_the_floor": FailureKind(
        "the object lies on the floor, lower than a hand reaches",
        "put it back onto a table",
        spoils="thing",
    ),
    "not_taken": FailureKind(
        "nobody took what was held out", "pull it out of the hand", spoils="thing"
    ),
    "no_answer": FailureKind(
        "somebody who was asked said nothing", "ask them yourself", spoils="thing"
    ),
    "person_near": FailureKind(
        "somebody stands too near to go on", "step back from the robot", spoils="thing"
    ),
    "person_not_seen": FailureKind(
        "the person is not where they were", "come before the camera", spoils="thing"
    ),
    "not_holding": FailureKind(
        "there is nothing in the hand", "pick something up first", spoils="thing"
    ),
    "hands_full": FailureKind("no free hand", "put something down first", spoils="thing"),
    "arm_stalled": FailureKind(
        "the arm did not get to where it was sent", "clear the arm", spoils="thing"
    ),
    "place_missed": FailureKind(
        "the object did not stay where it was put", "check the place", spoils="thing"
    ),
    "lost_balance": FailureKind(
        "the robot could not keep its balance", "stand it up", spoils="thing"
    ),
    # body and system
    "fallen": FailureKind(
        "the robot lies on the floor", "make room, then say 'get up'", spoils="robot"
    ),
    "localisation_lost": FailureKind(
        "the robot does not know where it is", "wait, or re-localise", spoils="robot"
    ),
    "camera_unplugged": FailureKind(
        "the camera is not there", "plug it in; it is looked for again", spoils="thing"
    ),
    "camera_late": FailureKind(
        "pictures of the camera stay away", "check cable and USB port", spoils="thing"
    ),
    "camera_frozen": FailureKind(
        "the camera gives the same picture over and over",
        "unplug it and plug it in again",
        spoils="thing",
    ),
    "camera_black": FailureKind(
        "the camera sees nothing", "uncover it, or make light", spoils="thing"
    ),
    "sensor_silent": FailureKind("a sensor stopped answering", "check its cable", spoils="robot"),
    "overheated": FailureKind("a motor is too hot", "let it cool down", spoils="robot"),
    "motor_fault": FailureKind(
        "a motor or its bus has a fault",
        "look at its power and cable: humanoid motors check",
        spoils="robot",
    ),
    "imu_fault": FailureKind(
        "the IMU tells nothing that can be believed",
        "look at its cable and its power, and start the robot anew",
        spoils="robot",
    ),
    "battery_low": FailureKind("the battery is nearly empty", "charge it", spoils="robot"),
    "emergency_stop": FailureKind(
        "the emergency stop was pressed", "release it, then reset it", spoils="robot"
    ),
    "overloaded": FailureKind(
        "the computer does not keep up", "end other programs on it", spoils="thing"
    ),
    "controller_lost": FailureKind(
        "the controller process died", "see that the robot stands, and say it again", spoils="robot"
    ),
    "plant_lost": FailureKind("the simulation died", "restart", spoils="system"),
    "timeout": FailureKind("it took longer than it may", "try again", spoils="look"),
    "given_up": FailureKind(
        "the mission gave up on purpose", "read the mission's reason", spoils="thing"
    ),
    "not_as_expected": FailureKind(
        "the world is not as the mission expects it",
        "look at what was found instead",
        spoils="thing",
    ),
    "cancelled": FailureKind("it was stopped on request", "", spoils="robot"),
    "internal": FailureKind("the software broke", "report it with the run folder", spoils="system"),
}


def codes(*spoilt: Spoilt) -> tuple[str, ...]:
    """Codes that reach so far, in the catalogue's order."""
    return tuple(code for code, kind in CATALOGUE.items() if kind.spoils in spoilt)


def failure(code: str, cause: str, *, suggestion: str = "", **evidence: float | str) -> Failure:
    """Make a `Failure`, with the catalogue's suggestion unless a better one is given."""
    return Failure(
        code=code,
        cause=cause,
        evidence=evidence,
        suggestion=suggestion or CATALOGUE[code].suggestion,
    )
