"""Collision checks of every pose that a candidate for picking or placing will take."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from robot.messages import Side
from robot.planning import reach
from robot.planning.grasps import HandOption
from robot.planning.handling_problem import HandlingProblem
from robot.planning.reach import Targets
from robot.planning.requests import Held
from robot.planning.robot_body import UPRIGHT, Body
from robot.planning.scene import HELD, Scene
from robot.planning.solids import grasped, piece_id
from robot.planning.stances import Candidates, posture_of
from robot.se3 import SE3, Array

STAND_CLEARANCE_M = 0.03
APPROACH_CLEARANCE_M = 0.012  # as on the way there, see `arm_path`
TOUCH_CLEARANCE_M = 0.004
LEAN_CLEARANCE_M = 0.02
SWEEP_CLEARANCE_M = (0.03, 0.02, 0.012)  # tried in turn: as much as there is room for
OVER_SWEEP_CLEARANCE_M = (0.05, 0.03)
OVER_CLEARANCE_M = 0.015
"""Of the arm without its hand, over an edge: the feet end 2 cm off, and the hand goes on lines that
the elbow follows by itself. With 4 mm the forearm rubbed on the edge and pushed the robot up."""
ROOMS_M = (0.03, 0.02)
"""What the hand and the arm are liked to keep from everything but the thing, the most first: a
laden arm sags by 1 cm, and an IMU that is askew has it lower still."""
STEP_M = 0.05
SWAY_CLEARANCE_M = 0.005
FROM_REST_M = 0.03
"""Steps that begin and end standing sway the pelvis further aside than a walk's `sway_m` of 0.06 m:
by 0.090 m in 90 % of 31 steps in to a thing or a place, by 0.098 m at most, and back by 0.089 m.
Without this a raised forearm met the wall beside a corner."""
END = "the end of its reach"
BESIDE_SAMPLES, BESIDE_SPREADS_RAD = 100, (0.3, 0.5, 0.8)
"""Arms that are sampled about a pose beside an edge: so many, off by so much a joint, each."""


class Checker:
    """Checks one candidate: `prepare` it, then ask about its poses.

    Answers are the name of what is touched first, None if nothing is.
    """

    def __init__(self, body: Body, problem: HandlingProblem) -> None:
        """For one problem."""
        self.body = body
        self.problem = problem
        self._reaching = body.description.handy.reaching

    def prepare(self, candidate: Candidates, side: Side, main: Targets) -> None:
        """Set up its scenes: the object in its place, or held."""
        problem, scenes = self.problem, self.body.scenes
        self.side: Side = side
        self.arm = self.body.arms[side]
        self.candidate = candidate
        self.lean = self._reaching.leans[int(candidate.lean[0])]
        option: HandOption = problem.options[int(candidate.option[0])]
        self.option = option
        self._grasped = frozenset({piece_id(problem.object_id, option.piece)})
        at = main.pose(0) @ option.X_GO @ problem.shape.X_BodyShape
        self.free = scenes.get(problem.others, thing=grasped(problem.object_id, problem.shape))
        self.free.move_thing(at)
        self._thing = frozenset(one.id for one in grasped(problem.object_id, problem.shape))
        hand = self.body.description.hands[side]
        self._hand_names = (hand.body, *hand.finger_bodies, HELD)
        self.opened = hand.max_opening_m / hand.opening_per_motor
        self.closed = option.opening_m / hand.opening_per_motor

    def at_main(self, q_main: Array) -> str | None:
        """What the hand around the object touches, or the body standing there."""
        return self._touch(
            self.free,
            q_main,
            self.opened,
            clearance_m=TOUCH_CLEARANCE_M,
            allowed=self._grasped,
            rest=True,
        )

    def on_line(self, q_middle: Array, q_back: Array) -> str | None:
        """What is touched on the way to or from the object."""
        return self._touch(self.free, q_back, self.opened) or self._touch(
            self.free,
            q_middle,
            self.opened,
            clearance_m=TOUCH_CLEARANCE_M,
            allowed=self._grasped,
        )

    @property
    def held(self) -> Scene:
        """The scene with the object in the hand."""
        held = Held(id=self.problem.object_id, shape=self.problem.shape, X_GO=self.option.X_GO)
        return self.body.scenes.get(self.problem.others, (self.side, held))

    def lifted(self, q_up: Array) -> str | None:
        """What is touched with the object raised."""
        return self._touch(self.held, q_up, self.closed, clearance_m=TOUCH_CLEARANCE_M)

    def leaving(self, q: Array) -> str | None:
        """What is touched while standing up straight and stepping back, the arm as it is."""
        scene, finger = self._after()
        # The trunk goes down as it stands up from over an edge: a mug brushed the edge, and tilted.
        clearance_m = OVER_SWEEP_CLEARANCE_M[-1] if self.lean.last else TOUCH_CLEARANCE_M
        return self._leaning(scene, q, finger) or self._sweep(scene, q, finger, clearance_m)

    def ready(self, target: Targets, q_near: Array) -> tuple[str | None, Array | None]:
        """Joints with the hand raised before `target`, free on the way from the standoff."""
        laden = self.problem.kind == "place"
        return self._raised_before(target, q_near, *self._before(), laden=laden)

    def away(self, target: Targets, q_near: Array) -> tuple[str | None, Array | None]:
        """Joints with the hand raised before `target`, free on the way back to the standoff."""
        laden = self.problem.kind == "pick"
        return self._raised_before(target, q_near, *self._after(), laden=laden)

    def _raised_before(
        self, target: Targets, q_near: Array, scene: Scene, finger: float, *, laden: bool
    ) -> tuple[str | None, Array | None]:
        """Joints with the hand raised before `target`, free between stance and standoff.

        The hand is raised and pulled back by what is free; the trunk is upright, and leans only
        at the stance.
        """
        upright = reach.trunks_of(self.body, self.side, self.candidate, upright=True)
        touch: str | None = END
        if self.lean.hand_rad:
            return self._raised(self._beside(target, q_near, laden=laden), scene, finger)
        for targets in self._pulled(target):
            q0, row = np.tile(q_near, (len(targets.p), 1)), np.zeros(len(targets.p), dtype=int)
            reached = reach.reach(self.arm, upright.take(row), targets, q0, iterations=16)
            touch, q_ready = self._raised(reached.q[reached.ok], scene, finger)
            if q_ready is not None:
                return None, q_ready
        return touch, None

    def _pulled(self, target: Targets) -> Iterator[Targets]:
        """Raised hands before `target`, pulled back by more and more."""
        x, y, yaw = self.candidate.stance_of(0)
        forward = np.array([np.cos(yaw), np.sin(yaw), 0.0])
        ahead = float((target.p[0, :2] - np.array([x, y])) @ forward[:2])
        over, how = self.lean.last, self._reaching.raising
        raises, turns = (how.over_up_m, how.over_turns_rad) if over else (how.up_m, (0.0,))
        up_m, turn = (np.array(part) for part in zip(*product(raises, turns), strict=True))
        R = reach.rotations_z(turn) @ target.R[np.zeros(len(turn), dtype=int)]
        up = np.outer(up_m, [0.0, 0.0, 1.0])
        for pull in how.over_back_m if over else how.back_m:
            back = (max(0.0, ahead - self._reaching.upright_m) + pull) * forward
            yield Targets(R, target.p[0] - back + up)

    def _beside(self, target: Targets, q_near: Array, *, laden: bool) -> Array:
        """Joints with the hand raised beside an edge, the nearest to `q_near` first, shape (n, k).

        Back along the feet's heading is along the edge there, and the way up is narrow: they are
        sampled. A hand that holds something keeps its tilt.
        """
        rng = np.random.default_rng(0)
        spread = np.repeat(BESIDE_SPREADS_RAD, BESIDE_SAMPLES)[:, None]
        q = q_near + spread * rng.standard_normal((len(spread), len(q_near)))
        q = np.clip(q, self.arm.lower, self.arm.upper)
        X_ST = self.body.standing(UPRIGHT, self.side).X_ST[self.side]
        R_TG, p_TG = self.arm.chain.forward(q)
        R_SG, p_SG = X_ST.rotation() @ R_TG, p_TG @ X_ST.rotation().T + np.array(X_ST.p)
        high = p_SG[:, 2] > target.p[0, 2]
        q = q[high]
        if laden:
            turn = np.arctan2(R_SG[high, 1, 0], R_SG[high, 0, 0]) - self.candidate.heading[0]
            tilted = X_ST.rotation().T @ reach.rotations_z(turn) @ target.R
            solved = self.arm.chain.solve(tilted, p_TG[high], q)
            q = solved.q[solved.ok()]
        return q[np.argsort(np.linalg.norm(q - q_near, axis=1), kind="stable")]

    def _raised(
        self, raised: Array, scene: Scene, finger: float
    ) -> tuple[str | None, Array | None]:
        """The first of some joints, shape (n, k), with room on the way; else with less room."""
        touch: str | None = END
        for clearance in OVER_SWEEP_CLEARANCE_M if self.lean.last else SWEEP_CLEARANCE_M:
            for q in raised:
                touch = self._sweep(scene, q, finger, clearance)
                touch = touch or self._leaning(scene, q, finger)
                touch = touch or (self._face(scene, q) if self.lean.last else None)
                if touch is None:
                    return None, q
        return touch, None

    def _face(self, scene: Scene, q: Array) -> str | None:
        """What an arm that is up beside the head touches as the head looks elsewhere."""
        model, motors = self.body.model, self.body.nominal.copy()
        head = self.body.description.indices("head")
        lower, upper = model.lower_rad[head], model.upper_rad[head]
        looks = np.stack([lower, 0.5 * lower, motors[head], 0.5 * upper, upper], axis=1).tolist()
        motors[self.arm.motors] = q
        X_WB = SE3.from_xy_yaw(*self.candidate.stance_of(0)) @ self._standing(0.0)[0]
        scene.set_clearance(0.0)
        for look in product(*looks):
            motors[head] = look
            scene.pose(X_WB, motors)
            scene.update()
            touches = scene.touches(scene.arm_geoms(self.side), allowed=frozenset(scene.solids))
            if touches:
                return touches[0].second
        return None

    def swaying(self, q_ready: Array, q_leaving: Array) -> str | None:
        """What arm or body touch as the steps in and out sway the body; the hand is left out."""
        sway_m = self.body.description.walking.sway_m + FROM_REST_M
        for q, (scene, finger) in ((q_ready, self._before()), (q_leaving, self._after())):
            hand = self.body.description.hands[self.side]
            hands = {hand.body, *hand.finger_bodies, HELD}
            links = ~scene.solid_geoms & np.array([name not in hands for name in scene.names])
            scene.set_clearance(SWAY_CLEARANCE_M)
            for X_WS in self._on_the_way_in(aside_m=(-sway_m, sway_m)):
                self._pose(scene, q, finger, X_WS=X_WS, share=0.0)
                touches = scene.touches(links, solids_only=True)
                if touches:
                    return touches[0].second
        return None

    def room_m(self, q_back: Array, q_up: Array) -> float:
        """What the arm keeps from things: one of `ROOMS_M`, else `APPROACH_CLEARANCE_M`.

        With the open hand at its back, with the thing raised, and on the steps away from there.
        """
        scene, finger = self._after()
        leaving = q_up if self.problem.kind == "pick" else q_back
        for room_m in ROOMS_M:
            near = self._touch(
                self.free, q_back, self.opened, clearance_m=room_m, allowed=self._thing
            )
            near = near or self._touch(self.held, q_up, self.closed, clearance_m=room_m)
            near = near or self._sweep(scene, leaving, finger, room_m)
            if near is None:
                return room_m
        return APPROACH_CLEARANCE_M

    def _on_the_way_in(self, *, aside_m: tuple[float, ...] = (0.0,)) -> Iterator[SE3]:
        """Stances from the one wanted back to its standoff, so far to the left of the line."""
        X_WS = SE3.from_xy_yaw(*self.candidate.stance_of(0))
        length = float(self.candidate.standoff_m[0])
        for back in np.linspace(0.0, length, max(2, int(length / STEP_M) + 1)).tolist():
            for aside in aside_m:
                yield X_WS @ SE3((-back, aside, 0.0))

    def _before(self) -> tuple[Scene, float]:
        """Scene and fingers on the way to the object, or with it to its place."""
        return (self.free, self.opened) if self.problem.kind == "pick" else (self.held, self.closed)

    def _after(self) -> tuple[Scene, float]:
        """Scene and fingers on the way back."""
        return (self.held, self.closed) if self.problem.kind == "pick" else (self.free, self.opened)

    def _touch(
        self,
        scene: Scene,
        q_arm: Array,
        finger: float,
        *,
        X_WS: SE3 | None = None,
        share: float = 1.0,
        clearance_m: float = APPROACH_CLEARANCE_M,
        allowed: frozenset[str] = frozenset(),
        rest: bool = False,
    ) -> str | None:
        """What the arm (with `rest`: and the rest of the body) touches.

        The trunk leans by `share` of the candidate's posture; X_WS is the stance unless given.
        """
        self._pose(scene, q_arm, finger, X_WS=X_WS, share=share)
        slack: dict[tuple[str, str], float] = {}
        if self.lean.last and clearance_m < OVER_CLEARANCE_M:
            slack = dict.fromkeys(product(self._hand_names, scene.solids), clearance_m)
        scene.set_clearance(OVER_CLEARANCE_M if slack else clearance_m)
        touches = scene.touches(scene.arm_geoms(self.side), allowed=allowed, slack=slack)
        if not touches and rest:
            scene.set_clearance(STAND_CLEARANCE_M)
            touches = scene.touches(scene.rest_geoms(self.side), solids_only=True)
        return touches[0].second if touches else None

    def _pose(
        self, scene: Scene, q_arm: Array, finger: float, *, X_WS: SE3 | None, share: float
    ) -> None:
        stance = X_WS or SE3.from_xy_yaw(*self.candidate.stance_of(0))
        X_SB, motors = self._standing(share)
        motors[self.arm.motors] = q_arm
        motors[self.body.motor(self.body.description.hands[self.side].motor)] = finger
        scene.pose(stance @ X_SB, motors)
        scene.update()

    def _standing(self, share: float) -> tuple[SE3, Array]:
        """X_SB and all motors between upright (0) and the posture (1)."""
        leaning = self.body.standing(posture_of(self.lean, self.side), self.side)
        if share == 1.0:
            return leaning.X_SB, leaning.q.copy()
        upright = self.body.standing(UPRIGHT, self.side)
        X_SB = upright.X_SB.towards(leaning.X_SB, share)
        return X_SB, (1 - share) * upright.q + share * leaning.q

    def _sweep(self, scene: Scene, q: Array, finger: float, clearance_m: float) -> str | None:
        """What is touched between the stance and the standoff, upright."""
        for k, X_WS in enumerate(self._on_the_way_in()):
            touch = self._touch(
                scene, q, finger, X_WS=X_WS, share=0.0, clearance_m=clearance_m, rest=k == 0
            )
            if touch is not None:
                return touch
        return None

    def _leaning(self, scene: Scene, q: Array, finger: float) -> str | None:
        """What is touched while the trunk leans, or straightens up, with the arm still."""
        if self.lean == self._reaching.leans[0]:
            return None
        for share in (0.35, 0.7, 1.0):
            touch = self._touch(
                scene, q, finger, share=share, clearance_m=LEAN_CLEARANCE_M, rest=True
            )
            if touch is not None:
                return touch
        return None
