# pyright: reportPrivateUsage=false
# Truth is what the sensors' own rays meet.
"""How well people are found and followed by lidar and depth camera, beside the truth.

Homes and kitchens made from seeds, in which people stand, sit, lie and walk, and some pieces of
furniture that the robot's map does not know. The robot goes from point to point and looks about;
it is put there by hand, swaying, and believes to be where it is but for a wandering error. There
is no physics, so it is fast.

    python -m benchmarks.company --first 1000 --worlds 20 --reality real
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated, Any

import msgspec
import mujoco
import numpy as np
import typer

from robot.messages import WorldMap
from robot.model import description
from robot.perception.company.company import Company
from robot.se3 import SE3, Array, wrap_angle
from sim.homes.ground import Ground
from sim.simulation import SimulatedWorld, Simulation
from sim.world_schema import Person, Posture, World

WORLDS = ("kitchen", "flat", "office", "clinic")
PERIOD_S, JUDGE_S = 0.1, 0.5
WALKS_M_S = 0.4
WITHIN_M, ZONE_M = 5.0, 1.0
SAME_M, LYING_M = 0.6, 1.0
"""Found is who is told to be so near; of somebody who lies it may be the head or the legs."""
START_APART_M = 0.9
SWAY_RAD = math.radians(0.8)
PLACE_M, PLACE_RAD = 0.015, math.radians(0.7)
"""1 sigma of the wandering error of the robot's belief where it is."""
KINDS: tuple[str, ...] = ("stands", "walks", "sits", "lies", "walks", "stands")
app = typer.Typer(add_completion=False)


@dataclass
class Score:
    """What came of it; counts are of looks at the truth, two a second."""

    hits: dict[str, int] = field(default_factory=dict[str, int])
    misses: dict[str, int] = field(default_factory=dict[str, int])
    false: int = 0
    looks: int = 0
    in_zone: int = 0
    missed_in_zone: int = 0
    unsensed_in_zone: int = 0
    false_in_zone: int = 0
    errors_m: list[float] = field(default_factory=list[float])
    sigmas: list[float] = field(default_factory=list[float])
    postures: list[bool] = field(default_factory=list[bool])
    false_tracks: set[tuple[int, str]] = field(default_factory=set[tuple[int, str]])
    first_s: list[float] = field(default_factory=list[float])
    ms: list[float] = field(default_factory=list[float])

    def told(self) -> dict[str, Any]:
        """Figures."""

        def at(values: list[float], share: float) -> float:
            return round(float(np.percentile(values, share)), 3) if values else math.nan

        hits, misses = sum(self.hits.values()), sum(self.misses.values())
        precision, recall = hits / max(1, hits + self.false), hits / max(1, hits + misses)
        minutes = self.looks * JUDGE_S / 60.0
        return {
            "minutes": round(minutes, 1), "people seen": hits + misses,
            "precision": round(precision, 3), "recall": round(recall, 3),
            "F1": round(2 * precision * recall / max(1e-9, precision + recall), 3),
            "recall by kind": {
                kind: round(found / max(1, found + self.misses.get(kind, 0)), 3)
                for kind in sorted({*self.hits, *self.misses})
                for found in [self.hits.get(kind, 0)]
            },
            "error m, median; 95 %": [at(self.errors_m, 50), at(self.errors_m, 95)],
            "within 2.45 sigma": _share([one < 2.45 for one in self.sigmas]),
            "posture right": _share(self.postures),
            "in zone": self.in_zone, "missed in zone": self.missed_in_zone,
            "not even followed in zone": self.unsensed_in_zone,
            "false in zone, a minute": round(self.false_in_zone / max(minutes, 1e-9), 3),
            "false tracks, a minute": round(len(self.false_tracks) / max(minutes, 1e-9), 3),
            "ms a step, median; 95 %": [at(self.ms, 50), at(self.ms, 95)],
        }  # fmt: skip


def _share(of: list[bool]) -> float:
    return round(sum(of) / max(1, len(of)), 3)


class Walker:
    """Goes from one free point to the next, on the way that is free, with pauses."""

    def __init__(
        self,
        points: np.ndarray,
        rng: np.random.Generator,
        *,
        speed_m_s: float,
        away: np.ndarray | None = None,
    ) -> None:
        """Begin at a point, not near where somebody is."""
        self._points, self._rng, self._speed = points, rng, speed_m_s
        self.at = points[rng.integers(len(points))].copy()
        while away is not None and len(points) > 1 and np.hypot(*(self.at - away)) < START_APART_M:
            self.at = points[rng.integers(len(points))].copy()
        self.yaw_rad = float(rng.uniform(-math.pi, math.pi))
        self._goal, self._pause_s = self.at.copy(), 0.0

    def X_W(self) -> SE3:
        """Where it stands."""
        return SE3.from_xy_yaw(float(self.at[0]), float(self.at[1]), self.yaw_rad)

    def step(self, away: list[np.ndarray]) -> None:
        """Go on for a period, not into others."""
        if self._pause_s > 0.0:
            self._pause_s -= PERIOD_S
            return
        off = self._goal - self.at
        far_m = float(np.hypot(*off))
        if far_m < 0.05:
            self._next()
            return
        turn = wrap_angle(math.atan2(off[1], off[0]) - self.yaw_rad)
        self.yaw_rad += max(-1.0 * PERIOD_S, min(1.0 * PERIOD_S, turn))
        if abs(turn) > 0.5:
            return
        there = self.at + off / far_m * min(far_m, self._speed * PERIOD_S)
        blocked = any(np.hypot(*(there - one)) < 0.55 for one in away)
        free = np.min(np.hypot(*(self._points - there).T)) < 0.08
        if blocked or not free:
            self._next()
        else:
            self.at = there

    def _next(self) -> None:
        near = self._points[np.hypot(*(self._points - self.at).T) < 2.5]
        self._goal = near[self._rng.integers(len(near))]
        self._pause_s = float(self._rng.choice([0.0, 0.0, 2.0]))


def made(seed: int, rng: np.random.Generator) -> tuple[World, list[str]]:
    """A world with other people in it, and how each of them is."""
    name = WORLDS[seed % len(WORLDS)]
    there = Simulation().world(
        name if name == "kitchen" else f"{name}:{seed}",
        vary_seed=seed if name == "kitchen" else None,
    )
    assert isinstance(there, SimulatedWorld)
    ground = Ground(there.entries)
    points = ground.points(np.argwhere(ground.home))
    kinds = [KINDS[int(rng.integers(len(KINDS)))] for _ in range(3)]
    people: list[Person] = []
    for number, kind in enumerate(kinds):
        far = [p for p in points if all(math.dist(p, one.at_m) > 1.0 for one in people)]
        at = (far or list(points))[int(rng.integers(len(far or points)))]
        posture: Posture = "sits" if kind == "sits" else "lies" if kind == "lies" else "stands"
        people.append(
            Person(
                id=f"p{number}", at_m=(float(at[0]), float(at[1])), posture=posture,
                yaw_deg=float(rng.uniform(-180, 180)), height_m=float(rng.uniform(1.52, 1.92)),
                color=str(rng.choice(["blue", "red", "green", "white", "gray"])),
            )
        )  # fmt: skip
    return msgspec.structs.replace(there.entries, people=tuple(people)), kinds


def without(world_map: WorldMap, rng: np.random.Generator, count: int) -> WorldMap:
    """A map that does not know some of the furniture."""
    people = {one.id for one in world_map.people}
    pieces = [
        one.id for one in world_map.obstacles if one.id not in people and "wall" not in one.id
    ]
    lost = set(rng.permutation(pieces)[:count].tolist())
    kept = tuple(one for one in world_map.obstacles if one.id not in lost | people)
    return msgspec.structs.replace(world_map, obstacles=kept, people=())


def _towards(me: Walker, unsure: tuple[tuple[float, float], ...]) -> tuple[float, float] | None:
    """How the head turns to the nearest of what may be somebody."""
    near: list[tuple[float, float]] = []
    for point in unsure:
        off = np.array(point) - me.at
        aside_rad = wrap_angle(math.atan2(off[1], off[0]) - me.yaw_rad)
        if np.hypot(*off) < 3.5 and abs(aside_rad) < 1.3:
            near.append((float(np.hypot(*off)), aside_rad))
    return (min(near)[1], 0.1) if near else None


class Stage:
    """A world, the robot in it, and what it has found out."""

    def __init__(self, seed: int, *, reality: str, unknown: int) -> None:
        """Make it all from a seed."""
        self.seed, self.rng = seed, np.random.default_rng(seed)
        world, kinds = made(seed, self.rng)
        self.robot = description.load("juno")
        there = SimulatedWorld(world, profile=reality, eyes="camera", localisation="lidar")
        self.plant = there.plant(self.robot, seed=seed)
        self.people = list(zip(world.people, kinds, strict=True))
        ground = Ground(world)
        ground.keep_from([one.at_m for one, kind in self.people if kind != "walks"], 0.6)
        points = ground.points(np.argwhere(ground.home & (ground.clearance_m > 0.45)))
        self.me = Walker(points, self.rng, speed_m_s=WALKS_M_S)
        self.walkers: dict[str, Walker] = {}
        for person, kind in self.people:
            if kind == "walks":
                speed_m_s = float(self.rng.uniform(0.4, 1.2))
                self.walkers[person.id] = Walker(
                    points, self.rng, speed_m_s=speed_m_s, away=self.me.at
                )
        self.company = Company()
        self.company.know(without(there.map, self.rng, unknown))
        self.around = self.company.around(0.0)
        self.seen_s: dict[str, float] = {}
        self._off, self._gaze, self._gaze_until_s = np.zeros(3), (0.0, 0.3), 0.0
        self._looks_aside = False

    def where(self, id: str) -> Array:
        """Where somebody is, shape (2,)."""
        return np.array(self.plant.where(f"person/{id}").p[:2])

    def go_on(self, now_s: float) -> float:
        """Let a period pass, and the robot sense; the time that its company took [ms]."""
        everybody = {one.id: self.where(one.id) for one, _ in self.people}
        self.me.step(list(everybody.values()))
        for id, walker in self.walkers.items():
            others = [p_W for other, p_W in everybody.items() if other != id]
            walker.step([self.me.at, *others])
            self.plant.put(f"person/{id}", walker.X_W())
        self._look_about(now_s)
        X_WB = self._sway()
        walk = self.rng.normal(0.0, 1.0, 3) * np.array([PLACE_M, PLACE_M, PLACE_RAD])
        self._off = 0.98 * self._off + 0.2 * walk
        x, y, _ = X_WB.p
        X_off = SE3.from_xy_yaw(x + self._off[0], y + self._off[1], self._off[2])
        X_off @= SE3((-x, -y, 0.0))
        sensors, sending = self.robot.sensors, self.plant.sending
        X_WC, X_WL = (
            X_off @ self._pose(site) for site in (sensors.camera.site, sensors.lidar.site)
        )
        scan, image = sending.lidar.scan(now_s), sending.camera.capture(now_s)
        image.pixels()
        for id in self._visible():
            self.seen_s[id] = now_s
        begin = time.process_time()
        self.company.feel(X_off @ X_WB, ())
        self.company.scan(scan, X_WL)
        self.company.see_depth(image, X_WC)
        self.around = self.company.around(now_s)
        return 1e3 * (time.process_time() - begin)

    def _look_about(self, now_s: float) -> None:
        """Turn the head; as who walks does, every other time to what may be somebody."""
        self.plant.stand(self.me.X_W())
        if now_s >= self._gaze_until_s:
            self._gaze_until_s = now_s + float(self.rng.uniform(0.5, 2.0))
            yaw, pitch = self.rng.choice([0.0, 0.0, 0.6, -0.6]), self.rng.choice([0.1, 0.35, 0.55])
            self._looks_aside = not self._looks_aside
            towards = _towards(self.me, self.around.unsure) if self._looks_aside else None
            self._gaze = towards or (float(yaw), float(pitch))
        self.plant.pose({"head_pitch": self._gaze[1], "head_yaw": self._gaze[0]})

    def _sway(self) -> SE3:
        """Lean a little, as who walks does; where the base is then."""
        model, data = self.plant.model, self.plant.data
        roll, pitch = self.rng.normal(0.0, SWAY_RAD, 2).tolist()
        X_WB = self.plant.oracle.X_WB() @ SE3.from_rpy(roll, pitch, 0.0, (0.0, 0.0, 0.0))
        at = model.jnt_qposadr[model.body_jntadr[model.body(self.robot.base_body).id]]
        data.qpos[at : at + 7] = (*X_WB.p, *X_WB.quat_wxyz)
        mujoco.mj_kinematics(model, data)
        return X_WB

    def _pose(self, site: str) -> SE3:
        there = self.plant.data.site(site)
        return SE3.from_rotation(there.xmat.reshape(3, 3), there.xpos)

    def _visible(self) -> set[str]:
        """Who has two beams of the lidar, or eight pixels, on them."""
        model, sensors = self.plant.model, self.robot.sensors
        camera, lidar = self.plant.sending.camera, self.plant.sending.lidar
        found: set[int] = set()
        for rays, name, directions, range_m, least in (
            (lidar._rays, sensors.lidar.site, lidar._beams, sensors.lidar.range_m, 2),
            (camera._rays, sensors.camera.site, camera._rays_C, sensors.camera.range_m, 8),
        ):
            site = self.plant.data.site(name)
            along = directions @ site.xmat.reshape(3, 3).T
            _, geoms = rays.cast(site.xpos, along, range_m=range_m)
            ids, counts = np.unique(model.geom_bodyid[geoms[geoms >= 0]], return_counts=True)
            found |= set(ids[counts >= least].tolist())
        return {one.id for one, _ in self.people if model.body(f"person/{one.id}").id in found}


def judge(score: Score, stage: Stage, now_s: float) -> Iterator[str]:
    """Compare what is told with the truth; yields what was wrong, for people to look at."""
    score.looks += 1
    me = stage.me.at
    left = {
        one.id: (one, np.array(one.X_WO.p[:2]))
        for one in stage.around.tracks
        if not one.missing and one.X_WO is not None and math.isfinite(one.seen_s)
    }
    for person, kind in stage.people:
        p_W = stage.where(person.id)
        near = min(left, key=lambda id: math.dist(left[id][1], p_W), default=None)
        within_m = LYING_M if person.posture == "lies" else SAME_M
        hit = near is not None and math.dist(left[near][1], p_W) < within_m
        range_m = math.dist(me, p_W)
        if hit and near is not None:
            one, at = left.pop(near)
            if range_m < WITHIN_M and now_s - one.seen_s < 0.5:
                score.errors_m.append(math.dist(at, p_W))
                spread = np.array(one.covariance).reshape(2, 2)
                score.sigmas.append(float(np.sqrt((at - p_W) @ np.linalg.solve(spread, at - p_W))))
                score.postures.append(one.posture.split(",")[0] == person.posture)
        if range_m > WITHIN_M or now_s - stage.seen_s.get(person.id, -math.inf) > 1.0:
            continue
        counts = score.hits if hit else score.misses
        counts[kind] = counts.get(kind, 0) + 1
        if not hit:
            yield f"{stage.seed} {now_s:.1f} missed {person.id} {kind} at {range_m:.1f} m"
        if range_m < ZONE_M:
            score.in_zone += 1
            score.missed_in_zone += not hit
            followed = (one.p_W for one in stage.company._everybody.tracks)
            score.unsensed_in_zone += all(math.dist(one, p_W) > SAME_M for one in followed)
    for id, (one, at) in left.items():
        range_m = math.dist(me, at)
        if range_m < WITHIN_M and now_s - one.seen_s < 1.0:
            score.false += 1
            score.false_tracks.add((stage.seed, id))
            score.false_in_zone += range_m < ZONE_M
            yield f"{stage.seed} {now_s:.1f} false {id} {one.posture} at {np.round(at, 2)}"


@app.command()
def main(
    *,
    first: Annotated[int, typer.Option(help="The first seed.")] = 1000,
    worlds: Annotated[int, typer.Option(help="How many seeds.")] = 12,
    reality: Annotated[str, typer.Option(help="ideal, real or harsh.")] = "real",
    seconds: Annotated[float, typer.Option(help="In each world.")] = 60.0,
    unknown: Annotated[int, typer.Option(help="Pieces of furniture that the map lacks.")] = 2,
    show: Annotated[bool, typer.Option("--show", help="What was wrong, look by look.")] = False,
) -> None:
    """Measure."""
    score = Score()
    for seed in range(first, first + worlds):
        stage = Stage(seed, reality=reality, unknown=unknown)
        for step in range(round(seconds / PERIOD_S)):
            now_s = step * PERIOD_S
            score.ms.append(stage.go_on(now_s))
            wrong = [] if step % round(JUDGE_S / PERIOD_S) else list(judge(score, stage, now_s))
            if show and wrong:
                print("\n".join(wrong))
    print(json.dumps(score.told(), indent=1))


if __name__ == "__main__":
    app()
