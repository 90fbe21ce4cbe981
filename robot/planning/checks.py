"""Collision checks of every pose that a candidate for picking or placing will take."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from robot.messages import Side
from robot.planning import reach
from robot.planning.body import Body
from robot.planning.grasps import HandOption
from robot.planning.reach import Bases, Targets
from robot.planning.requests import Held
from robot.planning.scene import Scene
from robot.planning.solids import Solid, solid
from robot.planning.stances import LEANS, Candidates
from robot.se3 import SE3, Array

if TYPE_CHECKING:
    from robot.planning.handling import Job

STAND_CLEARANCE_M = 0.03
APPROACH_CLEARANCE_M = 0.012
TOUCH_CLEARANCE_M = 0.004
SWEEP_CLEARANCE_M = (0.03, 0.02, 0.012)
RAISE_M = (0.10, 0.06, 0.03, 0.0)
PULL_M = (0.0, 0.06, 0.12, 0.18)
STEP_M = 0.05
REACH_UPRIGHT_M = 0.36


class Checker:
    """Checks candidates among the same solids."""

    def __init__(self, body: Body, others: tuple[Solid, ...]) -> None:
        """`others` are all solids without the handled object."""
        self.body = body
        self.others = others

    def passes(
        self,
        job: Job,
        option: HandOption,
        candidate: Candidates,
        side: Side,
        *,
        main: Targets,
        back: Targets,
        up: Targets,
        q: tuple[Array, Array, Array, Array],
    ) -> tuple[str | None, Array | None]:
        """Name of what is touched first (None: nothing), and the ready posture's chain values.

        `q` are chain values at main, half-way back, back and up.
        """
        body = self.body
        lean = LEANS[int(candidate.lean[0])].posture(side)
        bases = reach.bases_of(body, side, candidate)
        X_WB, (_, q_body) = reach.base_pose(bases, 0), body.standing(lean)
        thing = solid(job.object_id, main.pose(0) @ option.X_GO, job.shape)
        free, held = self._scenes(job, option, side, thing)
        q_main, q_middle, q_back, q_up = q
        hand = body.description.hands[side]
        opened = hand.max_opening_m / hand.opening_per_motor

        touch = self._touch(free, X_WB, q_body, side, q_back, opened, special=None, rest=True)
        for q_near in (q_middle, q_main):
            touch = touch or self._touch(
                free, X_WB, q_body, side, q_near, opened,
                clearance_m=TOUCH_CLEARANCE_M, special=job.object_id,
            )  # fmt: skip
        closed = option.opening_m / hand.opening_per_motor
        touch = touch or self._touch(
            held, X_WB, q_body, side, q_up, closed, clearance_m=TOUCH_CLEARANCE_M
        )
        if touch is not None:
            return touch, None
        picking = job.kind == "pick"
        arriving, leaving = (free, held) if picking else (held, free)
        grips = (opened, closed) if picking else (closed, opened)
        touch, q_ready = self._ready(
            arriving, candidate, side, back if picking else up, q_back if picking else q_up, grips[0]
        )
        if q_ready is None:
            return touch, None
        q_away = q_up if picking else q_back
        touch = self._leaning(leaving, candidate, side, q_away, grips[1])
        touch = touch or self._sweep(leaving, candidate, side, q_away, grips[1], TOUCH_CLEARANCE_M)
        return touch, q_ready

    def _scenes(self, job: Job, option: HandOption, side: Side, thing: Solid) -> tuple[Scene, Scene]:
        """With the object in its place and nothing held, and with the object held."""
        held = Held(id=job.object_id, shape=job.shape, X_GO=option.X_GO)
        scenes = self.body.scenes
        return scenes.get((*self.others, thing)), scenes.get(self.others, (side, held))

    def _touch(
        self,
        scene: Scene,
        X_WB: SE3,
        q_body: Array,
        side: Side,
        q_chain: Array,
        finger: float,
        *,
        clearance_m: float = APPROACH_CLEARANCE_M,
        special: str | None = None,
        rest: bool = False,
    ) -> str | None:
        """What the arm (with `rest`: and the rest of the body) touches; `special` may be touched."""
        body = self.body
        motors = q_body.copy()
        motors[body.arms[side].motors] = q_chain
        motors[body.motor(body.description.hands[side].motor)] = finger
        scene.pose(X_WB, motors)
        scene.update()
        scene.set_clearance(clearance_m)
        allowed = frozenset({special} if special else ())
        touches = scene.touches(scene.arm_geoms(side), allowed=allowed)
        if not touches and rest:
            scene.set_clearance(STAND_CLEARANCE_M)
            touches = scene.touches(scene.rest_geoms(side), solids_only=True)
        return touches[0].second if touches else None

    def _ready(
        self,
        scene: Scene,
        candidate: Candidates,
        side: Side,
        target: Targets,
        q_near: Array,
        finger: float,
    ) -> tuple[str | None, Array | None]:
        """Chain values with the hand raised before `target`, free on the way from the standoff.

        The hand is raised and pulled back by what is free; the trunk is upright, and leans only
        at the stance.
        """
        body, arm = self.body, self.body.arms[side]
        upright = reach.bases_of(body, side, candidate, upright=True)
        x, y, yaw = candidate.stance_of(0)
        forward = np.array([np.cos(yaw), np.sin(yaw), 0.0])
        ahead = float((target.p[0, :2] - np.array([x, y])) @ forward[:2])
        pulls = [max(0.0, ahead - REACH_UPRIGHT_M) + pull for pull in PULL_M]
        grid = [(raised, pull) for pull in pulls for raised in RAISE_M]
        n = len(grid)
        p = np.stack([target.p[0] + [0, 0, raised] - pull * forward for raised, pull in grid])
        bases = Bases(
            np.repeat(upright.p, n, 0), np.repeat(upright.yaw, n), np.repeat(upright.q_chain, n, 0)
        )
        reached = reach.reach(
            arm, bases, Targets(np.repeat(target.R, n, 0), p), np.tile(q_near, (n, 1)), iterations=16
        )
        touch: str | None = "the end of its reach"
        for clearance in SWEEP_CLEARANCE_M:
            for i in np.flatnonzero(reached.ok).tolist():
                q = reached.q[i]
                touch = self._sweep(scene, candidate, side, q, finger, clearance)
                touch = touch or self._leaning(scene, candidate, side, q, finger)
                if touch is None:
                    return None, q
        return touch, None

    def _sweep(
        self,
        scene: Scene,
        candidate: Candidates,
        side: Side,
        q_chain: Array,
        finger: float,
        clearance_m: float,
    ) -> str | None:
        """What is touched between the stance and the standoff, standing as at the stance's end."""
        body, arm = self.body, self.body.arms[side]
        X_SB, q_body = body.standing(LEANS[0].posture(side))
        q = q_chain.copy()
        waist = [i for i in range(len(q)) if i not in arm.free]
        q[waist] = q_body[arm.motors][waist]
        x, y, yaw = candidate.stance_of(0)
        length = float(candidate.standoff_m[0])
        for back in np.linspace(0.0, length, max(2, int(length / STEP_M) + 1)).tolist():
            at = SE3.from_xy_yaw(x - back * np.cos(yaw), y - back * np.sin(yaw), yaw)
            touch = self._touch(
                scene, at @ X_SB, q_body, side, q, finger, clearance_m=clearance_m, rest=back == 0.0
            )
            if touch is not None:
                return touch
        return None

    def _leaning(
        self,
        scene: Scene,
        candidate: Candidates,
        side: Side,
        q_chain: Array,
        finger: float,
    ) -> str | None:
        """What is touched while the trunk leans, or straightens up, with the arm still."""
        lean = LEANS[int(candidate.lean[0])]
        if lean == LEANS[0]:
            return None
        body, arm = self.body, self.body.arms[side]
        waist = [i for i in range(len(q_chain)) if i not in arm.free]
        S = SE3.from_xy_yaw(*candidate.stance_of(0))
        X0, q0 = body.standing(LEANS[0].posture(side))
        X1, q1 = body.standing(lean.posture(side))
        from_waist, to_waist = q0[arm.motors][waist], q1[arm.motors][waist]
        for share in (0.35, 0.7, 1.0):
            q = q_chain.copy()
            q[waist] = (1 - share) * from_waist + share * to_waist
            p = (1 - share) * np.array(X0.p) + share * np.array(X1.p)
            X_SB = SE3((float(p[0]), float(p[1]), float(p[2])))
            touch = self._touch(
                scene, S @ X_SB, (1 - share) * q0 + share * q1, side, q, finger,
                clearance_m=TOUCH_CLEARANCE_M, rest=share == 1.0,
            )  # fmt: skip
            if touch is not None:
                return touch
        return None
