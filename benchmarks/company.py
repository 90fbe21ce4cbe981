"""How well people are found and followed by lidar and depth camera, beside the truth.

Homes and kitchens made from seeds, in which people stand, sit, lie and walk, and some pieces of
furniture that the robot's map does not know. The robot goes from point to point and looks about; it is
put there by hand, swaying, and believes to be where it is but for a wandering error. No physics, so it is fast.

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
from robot.se3 import SE3, wrap_angle
from sim.homes.ground import Ground
from sim.simulation import SimulatedWorld, Simulation
from sim.world_schema import Person, Posture, World

WORLDS = ("kitchen", "flat", "office", "clinic")
PERIOD_S, JUDGE_S = 0.1, 0.5
WALKS_M_S = 0.4
UNKNOWN_PIECES = 2
WITHIN_M, ZONE_M = 5.0, 1.0
SAME_M, LYING_M = 0.6, 1.0
"""Found is who is told to be so near; of somebody who lies it may be the head or the legs."""
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
                kind: round(self.hits.get(kind, 0) / max(1, self.hits.get(kind, 0) + self.misses.get(kind, 0)), 3)
                for kind in sorted({*self.hits, *self.misses})
            },
            "error m, median; 95 %": [at(self.errors_m, 50), at(self.errors_m, 95)],
            "within 2.45 sigma": round(float(np.mean(np.array(self.sigmas) < 2.45)), 3) if self.sigmas else None,
            "posture right": round(float(np.mean(self.postures)), 3) if self.postures else None,
            "in zone": self.in_zone, "missed in zone": self.missed_in_zone,
            "not even followed in zone": self.unsensed_in_zone,
            "false in zone, a minute": round(self.false_in_zone / max(minutes, 1e-9), 3),
            "false tracks, a minute": round(len(self.false_tracks) / max(minutes, 1e-9), 3),
            "ms a step, median; 95 %": [at(self.ms, 50), at(self.ms, 95)],
        }  # fmt: skip


class Walker:
    """Goes from one free point to the next, on the way that is free, with pauses."""

    def __init__(self, points: np.ndarray, rng: np.random.Generator, *, speed_m_s: float) -> None:
        self._points, self._rng, self._speed = points, rng, speed_m_s
        self.at = points[rng.integers(len(points))].copy()
        self.yaw_rad = float(rng.uniform(-math.pi, math.pi))
        self._goal, self._pause_s = self.at.copy(), 0.0

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


def without(world_map: WorldMap, rng: np.random.Generator) -> WorldMap:
    """A map that does not know some of the furniture."""
    people = {one.id for one in world_map.people}
    pieces = [
        one.id for one in world_map.obstacles if one.id not in people and "wall" not in one.id
    ]
    lost = set(rng.permutation(pieces)[:UNKNOWN_PIECES].tolist())
    kept = tuple(one for one in world_map.obstacles if one.id not in lost | people)
    return msgspec.structs.replace(world_map, obstacles=kept, people=())


def run(seed: int, score: Score, *, reality: str, duration_s: float) -> Iterator[str]:
    """A minute in a world; yields what was wrong, for people to look at."""
    rng = np.random.default_rng(seed)
    world, kinds = made(seed, rng)
    robot = description.load("juno")
    entries = SimulatedWorld(world, profile=reality, eyes="camera", localisation="lidar")
    plant = entries.plant(robot, seed=seed)
    model, data = plant.model, plant.data
    ground = Ground(world)
    ground.keep_from(
        [p.at_m for p, kind in zip(world.people, kinds, strict=True) if kind != "walks"], 0.6
    )
    points = ground.points(np.argwhere(ground.home & (ground.clearance_m > 0.45)))
    me = Walker(points, rng, speed_m_s=WALKS_M_S)
    walkers = {
        person.id: Walker(points, rng, speed_m_s=float(rng.uniform(0.4, 1.2)))
        for person, kind in zip(world.people, kinds, strict=True) if kind == "walks"
    }  # fmt: skip
    bodies = {
        int(model.body(f"person/{p.id}").id): (p, kind)
        for p, kind in zip(world.people, kinds, strict=True)
    }
    company = Company()
    company.know(without(entries.map, rng))
    camera, lidar = plant.sending.camera, plant.sending.lidar
    site_c, site_l = data.site(robot.sensors.camera.site), data.site(robot.sensors.lidar.site)
    seen_s: dict[str, float] = {}
    unsure: tuple[tuple[float, float], ...] = ()
    looks_aside = False
    off, gaze, gaze_until_s = np.zeros(3), (0.0, 0.3), 0.0
    for step in range(round(duration_s / PERIOD_S)):
        now_s = step * PERIOD_S
        everybody = [np.array(plant.where(f"person/{p.id}").p[:2]) for p in world.people]
        me.step(everybody)
        for id, walker in walkers.items():
            walker.step([me.at, *(one for one in everybody if np.hypot(*(one - walker.at)) > 1e-6)])
            plant.put(f"person/{id}", SE3.from_xy_yaw(*walker.at, walker.yaw_rad))
        sway = rng.normal(0.0, math.radians(0.8), 2)
        plant.stand(SE3.from_xy_yaw(*me.at, me.yaw_rad))
        if now_s >= gaze_until_s:
            gaze_until_s = now_s + float(rng.uniform(0.5, 2.0))
            gaze = (float(rng.choice([0.0, 0.0, 0.6, -0.6])), float(rng.choice([0.1, 0.35, 0.55])))
            # As who walks does, every other time to what may be somebody.
            looks_aside = not looks_aside
            gaze = (looks_aside and _towards(me, unsure)) or gaze
        plant.pose({"head_pitch": gaze[1], "head_yaw": gaze[0]})
        base_q = model.jnt_qposadr[model.body_jntadr[model.body(robot.base_body).id]]
        X_WB = plant.oracle.X_WB() @ SE3.from_rpy(
            float(sway[0]), float(sway[1]), 0.0, (0.0, 0.0, 0.0)
        )
        data.qpos[base_q : base_q + 7] = (*X_WB.p, *X_WB.quat_wxyz)
        mujoco.mj_kinematics(model, data)
        off = 0.98 * off + 0.2 * rng.normal(0.0, 1.0, 3) * np.array([PLACE_M, PLACE_M, PLACE_RAD])
        X_off = SE3.from_xy_yaw(X_WB.p[0] + off[0], X_WB.p[1] + off[1], off[2]) @ SE3(
            (-X_WB.p[0], -X_WB.p[1], 0.0)
        )
        X_WC = X_off @ SE3.from_rotation(site_c.xmat.reshape(3, 3), site_c.xpos)
        X_WL = X_off @ SE3.from_rotation(site_l.xmat.reshape(3, 3), site_l.xpos)
        scan, image = lidar.scan(now_s), camera.capture(now_s)
        image.pixels()
        begin = time.process_time()
        company.feel(X_off @ X_WB, ())
        company.scan(scan, X_WL)
        company.see_depth(image, X_WC)
        around = company.around(now_s)
        unsure = around.unsure
        score.ms.append(1e3 * (time.process_time() - begin))
        for body in _visible(model, data, site_c, site_l, camera, lidar) & set(bodies):
            seen_s[bodies[body][0].id] = now_s
        if step % round(JUDGE_S / PERIOD_S):
            continue
        told = {one.id: one for one in around.tracks if not one.missing and one.X_WO is not None}
        yield from _judge(score, seed, now_s, me.at, {
            p.id: (kind, p.posture, np.array(plant.where(f"person/{p.id}").p[:2])) for p, kind in bodies.values()
        }, told, seen_s, [one.p_W for one in company._everybody.tracks])  # fmt: skip


def _towards(me: Walker, unsure: tuple[tuple[float, float], ...]) -> tuple[float, float] | None:
    """How the head turns to the nearest of what may be somebody."""
    near: list[tuple[float, float]] = []
    for point in unsure:
        off = np.array(point) - me.at
        aside_rad = wrap_angle(math.atan2(off[1], off[0]) - me.yaw_rad)
        if np.hypot(*off) < 3.5 and abs(aside_rad) < 1.3:
            near.append((float(np.hypot(*off)), aside_rad))
    return (min(near)[1], 0.1) if near else None


def _visible(model: Any, data: Any, site_c: Any, site_l: Any, camera: Any, lidar: Any) -> set[int]:
    """Bodies with two beams of the lidar, or eight pixels, on them."""
    found: set[int] = set()
    for rays, site, directions, range_m, least in (
        (lidar._rays, site_l, lidar._beams, lidar._range_m, 2), (camera._rays, site_c, camera._rays_C, 4.0, 8),
    ):  # fmt: skip
        _, geoms = rays.cast(site.xpos, directions @ site.xmat.reshape(3, 3).T, range_m=range_m)
        ids, counts = np.unique(model.geom_bodyid[geoms[geoms >= 0]], return_counts=True)
        found |= set(ids[counts >= least].tolist())
    return found


def _judge(
    score: Score,
    seed: int,
    now_s: float,
    me: Any,
    truth: Any,
    told: Any,
    seen_s: Any,
    followed: Any,
) -> Iterator[str]:
    score.looks += 1
    left = dict(told)
    for id, (kind, posture, p_W) in truth.items():
        near = min(left, key=lambda k: math.dist(left[k].X_WO.p[:2], p_W), default=None)
        off_m = math.dist(left[near].X_WO.p[:2], p_W) if near else math.inf
        range_m = math.dist(me, p_W)
        hit = off_m < (LYING_M if posture == "lies" else SAME_M)
        if hit and near:
            one = left.pop(near)
            if range_m < WITHIN_M and now_s - one.seen_s < 0.5:
                score.errors_m.append(off_m)
                error = np.array(one.X_WO.p[:2]) - p_W
                P = np.array(one.covariance).reshape(2, 2)
                score.sigmas.append(float(np.sqrt(error @ np.linalg.solve(P, error))))
                score.postures.append(one.posture.split(",")[0] == posture)
        if range_m > WITHIN_M or now_s - seen_s.get(id, -math.inf) > 1.0:
            continue
        counts = score.hits if hit else score.misses
        counts[kind] = counts.get(kind, 0) + 1
        if not hit:
            yield f"{seed} {now_s:.1f} missed {id} {kind} at {range_m:.1f} m"
        if range_m < ZONE_M:
            score.in_zone += 1
            score.missed_in_zone += not hit
            score.unsensed_in_zone += all(math.dist(one, p_W) > SAME_M for one in followed)
    for id, one in left.items():
        range_m = math.dist(me, one.X_WO.p[:2])
        if range_m < WITHIN_M and now_s - one.seen_s < 1.0:
            score.false += 1
            score.false_tracks.add((seed, id))
            score.false_in_zone += range_m < ZONE_M
            yield f"{seed} {now_s:.1f} false {id} {one.posture} at {np.round(one.X_WO.p[:2], 2)}, {range_m:.1f} m"


@app.command()
def main(
    first: Annotated[int, typer.Option(help="The first seed.")] = 1000,
    worlds: Annotated[int, typer.Option(help="How many seeds.")] = 12,
    reality: Annotated[str, typer.Option(help="ideal, real or harsh.")] = "real",
    seconds: Annotated[float, typer.Option(help="In each world.")] = 60.0,
    show: Annotated[bool, typer.Option("--show", help="What was wrong, look by look.")] = False,
) -> None:
    """Measure."""
    score = Score()
    for seed in range(first, first + worlds):
        for line in run(seed, score, reality=reality, duration_s=seconds):
            if show:
                print(line)
    print(json.dumps(score.told(), indent=1))


if __name__ == "__main__":
    app()
