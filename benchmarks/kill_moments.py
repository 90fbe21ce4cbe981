"""`python -m benchmarks.kill_moments`: processes die at random moments, in simulated time.

What each process does is here in one thread with the simulated body, period by period: so whatever
follows is due to the moment and not to how busy the machine is. At a random moment of a random walk
(or standing) one stops. Compared with what docs/safety.md lets follow. `benchmarks.owner_kills`
does the same to real processes, live, which takes a minute each.
"""

from __future__ import annotations

import json
import random
import sys
from collections import Counter
from dataclasses import asdict, dataclass, field
from typing import Annotated

import numpy as np
import typer

from benchmarks.rig import STEPS, Rig
from robot.control.loop import BUS_PERIOD_S, ControlLoop
from robot.drivers.body_sample import BodySample
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.driver import GOOD_FOR_S
from robot.drivers.motors.owned.memory import Order
from robot.messages import Walk
from robot.owner import reactions
from robot.owner.balancing import OwnController
from robot.owner.owner import BusOwner
from robot.owner.sit import plan
from robot.reality.contract import USUAL

KILLED, FOLLOWED, STOPPED = (
    "controller killed",
    "controller killed, a spare follows",
    "controller stopped",
)
OWNER = "bus owner killed"
STRUCK = (KILLED, FOLLOWED, STOPPED, OWNER)
WENT_ON, LOWERED, TIPPED, DAMPED = "went on", "lowered on its feet", "tipped and damped", "damped"
LET_GO = "motors damp by their watchdog"
MAY = {
    KILLED: {LOWERED, TIPPED, DAMPED},
    FOLLOWED: {WENT_ON},
    STOPPED: {WENT_ON, LOWERED, TIPPED, DAMPED},
    OWNER: {LET_GO},
}
"""What docs/safety.md lets follow."""
STANDS_S, STRIKES_S = 0.3, 3.0
"""Before the walk begins, and the latest moment of it at which somebody dies."""
HOLDS_S, PAUSE_S = 0.006, 0.4
"""By when a spare has its turn, and how long a controller stands still at most."""
ENDS_S, GOES_ON_S, LETS_GO_S = 9.0, 2.0, 0.5
"""How long it is watched: until the owner is through, a spare walks, motors have let go."""
MOST = 1.01
"""Of a joint's limit: torques are told with noise."""
WATCHDOG_S = 0.024
"""By when motors damp for themselves: 20 ms, and the period in which it is seen."""


@dataclass
class Row:
    """What one strike came to.

    Attributes:
        seed: of all that is drawn.
        struck: who, and how.
        at_s: when, after the walk began.
        walked: whether it was to walk.
        silent_s: for how long nobody commanded, where somebody did again.
        outcome: what followed.
        codes: rows of the owner's ladder, in order.
        most: the largest torque after the strike, as a share of its joint's limit.
        is_allowed: whether docs/safety.md lets that follow.
    """

    seed: int
    struck: str
    at_s: float = 0.0
    walked: bool = False
    silent_s: float = 0.0
    outcome: str = ""
    codes: list[str] = field(default_factory=list[str])
    most: float = 0.0
    is_allowed: bool = False


class Trial:
    """A robot, its controller and the owner of its motors, played period by period."""

    def __init__(self, seed: int, *, robot: str, reality: str) -> None:
        """Stand."""
        self.rng = random.Random(seed)
        self.rig = Rig(seed=seed, robot=robot, reality=reality)
        body = self.rig.loop.body
        self.owner = BusOwner(body, plan(body), lambda: OwnController(self.rig.robot))
        self.controller: ControlLoop | None = self.rig.loop
        self._limit_nm = body.torque_limit_nm
        self._number = 0
        self.most, self.codes = 0.0, list[str]()
        self.struck = False

    def period(self, *, is_owned: bool = True, is_claimed: bool = True) -> BodySample:
        """One period; who is dead says nothing."""
        plant = self.rig.plant
        sample = plant.read()
        order = None
        if self.controller is not None:
            self._number += 1
            command = self.controller.tick(sample)
            good_until_s = sample.motors.stamp_s + GOOD_FOR_S
            order = Order(self._number, good_until_s, leaves=False, command=command)
        if is_owned:
            decided = self.owner.decide(sample, order, is_pressed=False, is_claimed=is_claimed)
            if decided is not None:
                plant.write(decided)
            self._note()
        plant.step(STEPS)
        if self.struck:
            share = np.abs(plant.data.actuator_force) / self._limit_nm
            self.most = max(self.most, float(share.max()))
        return sample

    def _note(self) -> None:
        code = self.owner.state.code
        if code and (not self.codes or self.codes[-1] != code):
            self.codes.append(code)

    def pass_s(self, duration_s: float, *, is_owned: bool = True, is_claimed: bool = True) -> None:
        """Let time pass."""
        for _ in range(round(duration_s / BUS_PERIOD_S)):
            self.period(is_owned=is_owned, is_claimed=is_claimed)


def once(seed: int, struck: str, *, robot: str, reality: str) -> Row:
    """One robot and its strike."""
    trial = Trial(seed, robot=robot, reality=reality)
    rng, row = trial.rng, Row(seed, struck)
    row.walked, row.at_s = rng.random() < 0.75, round(rng.uniform(0.0, STRIKES_S), 3)
    trial.pass_s(STANDS_S)
    if row.walked:
        trial.rig.send(
            Walk, forward_m_s=rng.uniform(-0.1, 0.4), left_m_s=rng.uniform(-0.1, 0.1),
            turn_rad_s=rng.uniform(-0.3, 0.3), hold_s=60.0,
        )  # fmt: skip
    trial.pass_s(row.at_s)
    trial.struck, trial.codes[:] = True, []
    row.outcome = _follow(trial, row)
    row.codes, row.most = trial.codes, round(trial.most, 3)
    row.is_allowed = row.outcome in MAY[struck] and row.most <= MOST
    return row


def _follow(trial: Trial, row: Row) -> str:
    """Strike, and watch."""
    rig, controller = trial.rig, trial.rig.loop
    known = controller.state()
    trial.controller = None
    if row.struck == OWNER:
        return _let_go(trial)
    if row.struck == KILLED:
        return _alone(trial, is_claimed=False)
    longest_s = HOLDS_S if row.struck == FOLLOWED else PAUSE_S
    row.silent_s = BUS_PERIOD_S * _periods(trial.rng, longest_s)
    trial.pass_s(row.silent_s, is_claimed=row.struck == STOPPED)
    trial.controller = controller
    if row.struck == FOLLOWED:
        trial.controller = rig.loop = ControlLoop(rig.robot)
        trial.controller.recall(known)
    if trial.owner.state.latched:
        return _alone(trial, is_claimed=True)
    trial.pass_s(GOES_ON_S)
    return WENT_ON if rig.upright and trial.owner.state == reactions.WELL else "fell"


def _periods(rng: random.Random, longest_s: float) -> int:
    """A number of periods, one at least."""
    return rng.randint(1, round(longest_s / BUS_PERIOD_S))


def _alone(trial: Trial, *, is_claimed: bool) -> str:
    """The owner acts alone; what a controller says that goes on is not carried out."""
    for _ in range(round(ENDS_S / BUS_PERIOD_S)):
        trial.period(is_claimed=is_claimed)
        if trial.owner.state.level == Level.OFF:
            break
    else:
        return "gave torque for ever"
    if "seated" in trial.codes:
        return LOWERED
    return TIPPED if "tipping" in trial.codes else DAMPED


def _let_go(trial: Trial) -> str:
    """Nobody writes any more: the motors' own watchdog."""
    begun_s = trial.rig.time_s
    for _ in range(round(LETS_GO_S / BUS_PERIOD_S)):
        sample = trial.period(is_owned=False)
        if trial.rig.time_s - begun_s > WATCHDOG_S and not sample.motors.watchdog:
            return "motors went on"
    return LET_GO


def main(
    *,
    runs: Annotated[int, typer.Option(min=1, help="of each")] = 200,
    seed: Annotated[int, typer.Option(min=0, help="of the first run")] = 0,
    only: Annotated[str, typer.Option(help=f"one of: {'; '.join(STRUCK)}")] = "",
    robot: Annotated[str, typer.Option(help="by name")] = "juno",
    reality: Annotated[str, typer.Option(help="ideal, real, harsh")] = USUAL,
) -> None:
    """Strike and count; a line a run on standard output, the sums on standard error."""
    if only and only not in STRUCK:
        raise typer.BadParameter(f"there are {'; '.join(STRUCK)}")
    rows: list[Row] = []
    for struck in [only] if only else STRUCK:
        for number in range(seed, seed + runs):
            rows.append(once(number, struck, robot=robot, reality=reality))
            print(json.dumps(asdict(rows[-1])), flush=True)
    for (struck, outcome), count in sorted(Counter((r.struck, r.outcome) for r in rows).items()):
        most = max(r.most for r in rows if (r.struck, r.outcome) == (struck, outcome))
        print(
            f"{struck:36} {outcome:32} {count:4}  {most:.0%} of a joint's torque", file=sys.stderr
        )
    wrong = [(row.struck, row.seed) for row in rows if not row.is_allowed]
    print(
        f"{len(rows)} strikes, {len(wrong)} worse than docs/safety.md says {wrong or ''}",
        file=sys.stderr,
    )
    raise typer.Exit(1 if wrong else 0)


if __name__ == "__main__":
    typer.run(main)
