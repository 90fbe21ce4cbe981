"""What the owner of the buses does by itself, as one table, and the machine that goes by it.

Nothing here reads a clock or moves a motor: signs with their durations come in, a level comes out.
The most severe row wins. What is latched stays until a person resets it, and a reset is refused
while the robot still gives torque, or while anything is wrong that a reset would not mend.
`docs/safety.md` is made of the table.

It is the lowest latch, the last that can hold motors back, and knows nothing of the one above it in
software (`executive.engine.estop`). What the owner still sends goes through the last clamp
(`robot.drivers.motors.limiter`), but not through the controller's (`robot.control.limits`).
"""

from __future__ import annotations

from typing import NamedTuple

from robot.drivers.motors.alarms import Level

HOLDS_S, AT_MOST_S = 0.006, 0.020
"""So long every joint is held where it was sent last, before the robot is lowered; the longer one
where another controller has claimed the motors, or the old one still does: a spare's first tick
takes more than a period, and a standing robot does not notice."""
FREE_S = 0.004
"""So long a claim that was let go counts on: the system takes a killed process apart while it still
has its claim, and a spare can only claim what is free. At most `AT_MOST_S` in all."""
SEATED_S, DAMPED_S, TIPPING_S = 0.5, 2.0, 0.1
SLACK_S = 1e-6
"""Sums of periods are not exact."""


class Signs(NamedTuple):
    """What the owner sees in one period: for how long each has been so [s], 0 where it is not.

    Attributes:
        silent_s: no command came that is still good, since one did.
        claimed_s: a process that lives has claimed the motors, or had until `FREE_S` ago.
        astray_s: the robot does not stand on both feet, near a posture of its squat.
        on_feet_s: it is upright, a foot bears it, and the owner can lower it from a step.
        lowering_s: it is being lowered.
        seated_s: the motion that lowers it has ended.
        damping_s: its motors damp.
        let_go_s: motors that were commanded have stopped by themselves.
        stop_s: the stop input is pressed, or does not say that it is not.
    """

    silent_s: float = 0.0
    claimed_s: float = 0.0
    astray_s: float = 0.0
    on_feet_s: float = 0.0
    lowering_s: float = 0.0
    seated_s: float = 0.0
    damping_s: float = 0.0
    let_go_s: float = 0.0
    stop_s: float = 0.0


class Term(NamedTuple):
    """A condition: a sign that has lasted for longer than this, or one that has not."""

    sign: str
    over_s: float = 0.0
    is_not: bool = False

    def holds(self, signs: Signs) -> bool:
        """Whether it is so."""
        lasts_s: float = getattr(signs, self.sign)
        return (lasts_s > self.over_s + SLACK_S) is not self.is_not


class Row(NamedTuple):
    """One cause and what it leads to.

    Attributes:
        code: for programs.
        level: what is done.
        when: what it takes, for people.
        cure: what a person does about it.
        terms: all of them have to hold.
        below: looked at only while less than this is done.
        is_latched: whether only a reset ends it.
        refuses_reset: whether it has to be over before a reset is taken.
    """

    code: str
    level: Level
    when: str
    cure: str
    terms: tuple[Term, ...]
    below: Level = Level.OFF
    is_latched: bool = True
    refuses_reset: bool = False

    def holds(self, signs: Signs, level: Level) -> bool:
        """Whether it applies in a period that began at a level."""
        return level < self.below and all(term.holds(signs) for term in self.terms)


DOES: dict[Level, str] = {
    Level.OK: "carries commands out",
    Level.HOLD: "keeps every joint's last target",
    Level.SIT: "lowers the robot by its own squat, and obeys nobody",
    Level.DAMP: "lets every joint brake; what stands goes down",
    Level.OFF: "gives no torque",
}
"""What the owner does at each level, for people."""

REARM = "look at the robot, then `humanoid motors rearm`"
LOST = (Term("silent_s", HOLDS_S), Term("claimed_s", is_not=True))
SILENT = (Term("silent_s", AT_MOST_S),)
STANDS, ASTRAY = Term("astray_s", is_not=True), Term("astray_s")
IN_A_STEP = (ASTRAY, Term("on_feet_s"))
DOWN = (ASTRAY, Term("on_feet_s", is_not=True))
BALANCED = frozenset({"controller_lost_in_a_step", "controller_silent_in_a_step"})
"""Rows from which the robot is lowered by a controller of the owner's own."""

ROWS: tuple[Row, ...] = (
    Row(
        "late", Level.HOLD, "a period without a command that is still good",
        "none: the next command ends it", (Term("silent_s"),), is_latched=False,
    ),
    Row(
        "controller_lost", Level.SIT,
        f"none for more than {1000 * HOLDS_S:g} ms, no controller has claimed the motors, or had "
        f"{1000 * FREE_S:g} ms ago, and the robot stands on both feet",
        REARM, (*LOST, STANDS), below=Level.SIT,
    ),
    Row(
        "controller_silent", Level.SIT,
        f"none for more than {1000 * AT_MOST_S:g} ms, though one has, and it stands",
        REARM, (*SILENT, STANDS), below=Level.SIT,
    ),
    Row(
        "controller_lost_in_a_step", Level.SIT,
        "as `controller_lost`, but it steps, or moves, upright, and a foot bears it: a controller "
        "of the owner's own ends the step first",
        REARM, (*LOST, *IN_A_STEP), below=Level.SIT,
    ),
    Row(
        "controller_silent_in_a_step", Level.SIT, "as `controller_silent`, but it steps",
        REARM, (*SILENT, *IN_A_STEP), below=Level.SIT,
    ),
    Row(
        "controller_lost_astray", Level.DAMP,
        "as `controller_lost`, and it is not on its feet: lying, falling",
        REARM, (*LOST, *DOWN), below=Level.SIT,
    ),
    Row(
        "controller_silent_astray", Level.DAMP,
        "as `controller_silent`, and it is not on its feet",
        REARM, (*SILENT, *DOWN), below=Level.SIT,
    ),
    Row(
        "tipping", Level.DAMP,
        f"while it is lowered it does not stand on both feet for {1000 * TIPPING_S:g} ms, or, from "
        "a step, that controller does not keep it up",
        REARM, (Term("lowering_s"), Term("astray_s", TIPPING_S)),
    ),
    Row(
        "seated", Level.DAMP, f"it has been down for {SEATED_S:g} s",
        REARM, (Term("seated_s", SEATED_S),),
    ),
    Row(
        "at_rest", Level.OFF, f"its motors have damped for {DAMPED_S:g} s",
        REARM, (Term("damping_s", DAMPED_S),), below=Level.OFF,
    ),
    Row(
        "motors_let_go", Level.OFF, "motors that were commanded stopped by themselves",
        f"{REARM}; humanoid motors check", (Term("let_go_s"),),
    ),
    Row(
        "stop_pressed", Level.OFF, "the stop input is pressed, or says nothing that can be read",
        f"release it; {REARM}", (Term("stop_s"),), refuses_reset=True,
    ),
)  # fmt: skip
"""In no order that counts: the level does."""

BY_CODE = {row.code: row for row in ROWS}


class State(NamedTuple):
    """Where on the ladder the owner is.

    Attributes:
        level: what it does.
        code: of the row that brought it there; "" at OK.
        latched: codes of all rows that are latched.
    """

    level: Level = Level.OK
    code: str = ""
    latched: frozenset[str] = frozenset()


WELL = State()


def after(state: State, signs: Signs) -> State:
    """The state after a period with such signs: latched rows and those that hold, the worst wins.

    Of several at one level it is the first that was there, so that a cause is not covered up.
    """
    on = [row for row in ROWS if row.holds(signs, state.level)]
    latched = state.latched | {row.code for row in on if row.is_latched}
    rows = [*on, *(BY_CODE[code] for code in latched)]
    level = max((row.level for row in rows), default=Level.OK)
    if state.code and level == state.level and state.code in {row.code for row in rows}:
        return State(level, state.code, latched)
    return State(level, next((row.code for row in rows if row.level == level), ""), latched)


class Refused(NamedTuple):
    """Why a reset is not taken: a row's code or "moving", cause and cure for people."""

    code: str
    cause: str
    cure: str


def reset(state: State, signs: Signs) -> State | Refused:
    """What a person's reset leads to: all is forgotten, or it is refused.

    Args:
        state: before it.
        signs: as they are now.
    """
    for row in ROWS:
        if row.refuses_reset and all(term.holds(signs) for term in row.terms):
            return Refused(row.code, row.when, row.cure)
    if state.latched and state.level < Level.OFF:
        return Refused("moving", "the motors still give torque", "wait until they have let go")
    return WELL
