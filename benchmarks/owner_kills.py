"""`python -m benchmarks.owner_kills`: strike processes at random below a robot on emulated motors.

Each run is a robot that stands or walks, whose motors a process of its own commands. At a random
moment one process is killed or stopped: the controller, its spare, or the owner; the plant, which
stands for the world, stays. What follows is compared with what docs/safety.md says that may.
"""

from __future__ import annotations

import json
import os
import random
import signal
import sys
import tempfile
import time
from collections import Counter
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Annotated, NamedTuple

import typer

from benchmarks.kills import roles
from robot.bringup.live import LiveRuntime
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.memory import OwnerMemory
from robot.errors import RobotError
from robot.messages import WalkTo
from robot.model import description
from sim.simulation import Simulation

ROBOT = "juno"
SPARE_S, SETTLES_S = 30.0, 90.0
"""Wall time until there is a spare, and until it is clear what a strike came to."""
GOES_ON_S = 1.0
"""Of the robot's time, with commands, after which it has gone on."""
STANDS_S, WALKS_S = 0.5, 4.0
"""Of the robot's time, within which it is struck."""
LOOKS_S = 0.02
WENT_ON, LOWERED, DAMPED, OFF = "went on", "lowered", "damped", "let go"


class Strike(NamedTuple):
    """What is done to whom, and what docs/safety.md lets follow."""

    role: str
    how: str
    may: frozenset[str]

    def __str__(self) -> str:
        """As people call it."""
        return f"{self.role}: {self.how}"


STRIKES = (
    Strike("controller", "SIGKILL", frozenset({WENT_ON, LOWERED, DAMPED})),
    Strike("controller", "SIGSTOP", frozenset({WENT_ON, LOWERED, DAMPED})),
    Strike("controller", "SIGSTOP for a while", frozenset({WENT_ON, LOWERED, DAMPED})),
    Strike("spare controller", "SIGKILL", frozenset({WENT_ON})),
    Strike("owner", "SIGKILL", frozenset({"ended: motor_fault"})),
)
WEIGHTS = (4, 2, 2, 1, 1)
PAUSE_S = 0.4
MOST = 1.01
"""Of a joint's limit: torques are told in steps, and measured with noise."""


@dataclass
class Row:
    """What one run came to.

    Attributes:
        seed: of all that is drawn.
        strike: who, and how.
        walked: whether it was to walk.
        outcome: what followed.
        is_allowed: whether docs/safety.md lets that follow.
        codes: rows of the owner's ladder, in order.
        most: the largest torque while the owner acted alone, as a share of its joint's limit.
        load: of the machine, then.
    """

    seed: int
    strike: str = ""
    walked: bool = False
    outcome: str = ""
    is_allowed: bool = False
    codes: list[str] = field(default_factory=list[str])
    most: float = 0.0
    load: float = 0.0


def main(
    *,
    runs: Annotated[int, typer.Option(min=1, help="a strike each")] = 200,
    seed: Annotated[int, typer.Option(min=0, help="of the first run")] = 0,
    driver: Annotated[str, typer.Option(help="of the motors: can, ethernet, dynamixel")] = "can",
    only: Annotated[str, typer.Option(help="a strike, as in 'controller: SIGKILL'")] = "",
) -> None:
    """Strike and count; a line a run on standard output, the sum on standard error."""
    rows: list[Row] = []
    for number in range(seed, seed + runs):
        rows.append(once(number, driver, only))
        print(json.dumps(asdict(rows[-1])), flush=True)
    counted = Counter((row.strike, row.outcome) for row in rows)
    for (strike, outcome), count in sorted(counted.items()):
        print(f"{strike:36} {outcome:24} {count}", file=sys.stderr)
    wrong = [row.seed for row in rows if not row.is_allowed]
    most = max(row.most for row in rows)
    print(
        f"{len(rows)} strikes, {len(wrong)} worse than docs/safety.md says {wrong or ''}; the "
        f"largest torque of an owner alone was {most:.0%} of its joint's limit",
        file=sys.stderr,
    )
    raise typer.Exit(1 if wrong else 0)


def once(seed: int, driver: str, only: str = "") -> Row:
    """One run and its strike, or one of those that are called `only`."""
    rng = random.Random(seed)
    (strike,) = rng.choices(STRIKES, WEIGHTS)
    strike = next((one for one in STRIKES if str(one) == only), strike)
    row = Row(seed, str(strike), walked=rng.random() < 0.5)
    row.load = round(os.getloadavg()[0], 1)
    world = Simulation().world("empty")
    with tempfile.TemporaryDirectory() as folder:
        try:
            with LiveRuntime(
                world, ROBOT, folder=Path(folder), seed=seed, motors=driver, owned=True
            ) as runtime:
                _play(runtime, strike, row, rng, driver)
        except RobotError as error:
            row.outcome = f"{type(error).__name__}: {error}"
    row.is_allowed = row.outcome in strike.may and row.most <= MOST
    return row


def _play(runtime: LiveRuntime, strike: Strike, row: Row, rng: random.Random, driver: str) -> None:
    robot, folder = description.load(ROBOT).driven_by(driver), Path(runtime.run.sockets)
    spare_until_s = time.monotonic() + SPARE_S
    with OwnerMemory(robot, folder) as owner:
        # A spare that is there may still be loading: it is one when it follows the states.
        while "spare controller" not in (found := roles(os.getpid(), {})) or not owner.ready():
            if time.monotonic() > spare_until_s or runtime.failure() is not None:
                row.outcome = "did not come up"
                return
            runtime.advance(LOOKS_S)
    link = runtime.link
    if row.walked:
        link.send(WalkTo(stamp_s=link.now_s(), id=link.next_id(), x_m=1.0, y_m=0.0, yaw_rad=0.0))
    strikes_s = link.now_s() + rng.uniform(0.0, WALKS_S if row.walked else STANDS_S)
    while link.now_s() < strikes_s and runtime.failure() is None:
        runtime.advance(LOOKS_S)
    with OwnerMemory(robot, folder) as owner:
        _strike(strike, found[strike.role], rng)
        begun_s, numbered = owner.stamp_s(), owner.last_number()
        settles_s = time.monotonic() + SETTLES_S
        row.outcome = "nothing was clear"
        while time.monotonic() < settles_s:
            runtime.advance(LOOKS_S)
            row.codes = [change.code for change in owner.said().changes]
            row.most = max(row.most, round(owner.standing().peak, 3))
            if (outcome := _outcome(runtime, owner, row.codes, begun_s, numbered)) is not None:
                row.outcome = outcome
                break
        if strike.how.startswith("SIGSTOP"):
            _signal(found[strike.role], signal.SIGCONT)


def _outcome(
    runtime: LiveRuntime, owner: OwnerMemory, codes: list[str], begun_s: float, numbered: int
) -> str | None:
    """What has followed by now; None if that is not clear."""
    if (failure := runtime.failure()) is not None:
        return f"ended: {failure.code}"
    level = owner.standing().level
    if level == Level.OFF:
        if "seated" in codes:
            return LOWERED
        return DAMPED if "at_rest" in codes else OFF
    passed_s = owner.stamp_s() - begun_s
    if level < Level.SIT and passed_s > GOES_ON_S and owner.last_number() > numbered + 100:
        body = runtime.link.body()
        return "fell" if body is not None and body.mode == "fallen" else WENT_ON
    return None


def _strike(strike: Strike, pid: int, rng: random.Random) -> None:
    if strike.how == "SIGKILL":
        _signal(pid, signal.SIGKILL)
        return
    _signal(pid, signal.SIGSTOP)
    if strike.how != "SIGSTOP":
        time.sleep(rng.uniform(0.0, PAUSE_S))
        _signal(pid, signal.SIGCONT)


def _signal(pid: int, number: signal.Signals) -> None:
    if pid in roles(os.getpid(), {}).values():  # only what was started from here
        os.kill(pid, number)


if __name__ == "__main__":
    typer.run(main)
