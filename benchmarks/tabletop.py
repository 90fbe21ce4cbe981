"""How well things on surfaces are found and measured in one depth image (nothing is named).

Views of homes and of the kitchen that are made from seeds: the robot stands before a thing and
looks at it. The camera's pose is known exactly. Truth is what each pixel's ray meets.

    python -m benchmarks.tabletop --first 1000 --views 60 --reality real
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated, Any

import mujoco
import numpy as np
import typer
from numpy.typing import NDArray

from robot.messages import RgbdImage
from robot.model import description
from robot.model.description import RobotDescription
from robot.perception.tabletop.cloud import cloud
from robot.perception.tabletop.things import Thing, things
from robot.se3 import SE3
from sim.camera.scene_view import Pinhole
from sim.rays import SEEN, STATIC
from sim.simulation import Simulation

WORLDS = ("kitchen", "flat", "office", "clinic")
NEAR_M, FAR_M = 0.5, 2.5
LEAST_PX = 100
LEAST_SHARE = 0.5
TRIES = 12
app = typer.Typer(add_completion=False)


@dataclass
class View:
    """A picture, where it was taken from, and the body that each pixel shows, -1 for none."""

    image: RgbdImage
    X_WC: SE3
    bodies: NDArray[np.int32]
    noise_per_m: float
    p_W: dict[int, NDArray[np.float64]]


@dataclass
class Score:
    """What came of the views."""

    seen: int = 0
    found: int = 0
    alarms: int = 0
    errors_m: list[float] = field(default_factory=list)
    flat_m: list[float] = field(default_factory=list)
    sigmas: list[float] = field(default_factory=list)
    ms: list[float] = field(default_factory=list)

    def told(self) -> dict[str, float]:
        """Figures, in cm."""

        def at(values: list[float], share: float) -> float:
            return round(float(np.percentile(values, share)), 2) if values else math.nan

        cm = [100.0 * one for one in self.errors_m]
        flat = [100.0 * one for one in self.flat_m]
        return {
            "seen": self.seen, "recall": round(self.found / max(1, self.seen), 3),
            "alarms": self.alarms, "median_cm": at(cm, 50), "p95_cm": at(cm, 95),
            "across_floor_median_cm": at(flat, 50), "across_floor_p95_cm": at(flat, 95),
            "within_2_sigma": round(float(np.mean(np.array(self.sigmas) < 2.0)), 2)
            if self.sigmas else math.nan,
            "ms": at(self.ms, 50),
        }  # fmt: skip


def views(robot: RobotDescription, seed: int, *, reality: str) -> Iterator[tuple[View, float]]:
    """A view of a thing of a world that the seed chooses, and how far away it is."""
    rng = np.random.default_rng(seed)
    name = WORLDS[seed % len(WORLDS)]
    world = Simulation(reality).world(
        name if name == "kitchen" else f"{name}:{seed}",
        vary_seed=seed if name == "kitchen" else None,
    )
    plant = world.plant(robot, seed=seed)
    model, data = plant.model, plant.data
    targets = sorted(world.objects())
    bodies = {int(model.body(f"object/{one}").id) for one in targets}
    pinhole = Pinhole.of(robot)
    with plant.camera(renderer="rays") as camera:
        for _ in range(TRIES):
            target = np.array(plant.where(f"object/{targets[rng.integers(len(targets))]}").p)
            distance_m, bearing = rng.uniform(NEAR_M, FAR_M), rng.uniform(-math.pi, math.pi)
            x = target[0] - distance_m * math.cos(bearing)
            y = target[1] - distance_m * math.sin(bearing)
            plant.stand(SE3.from_xy_yaw(x, y, bearing + rng.uniform(-0.3, 0.3)))
            site = data.site(robot.sensors.camera.site)
            pitch = math.atan2(site.xpos[2] - target[2], distance_m) + rng.uniform(-0.15, 0.15)
            plant.pose({"head_pitch": min(max(pitch, -0.3), 0.8)})
            image = camera.take(float(seed))
            seen = who(model, data, robot, pinhole)
            X_WC = SE3.from_rotation(site.xmat.reshape(3, 3), site.xpos)
            if not any(np.sum(seen == one) >= LEAST_PX for one in bodies):
                continue
            where = {one: data.xpos[one].copy() for one in bodies}
            seen[~np.isin(seen, list(bodies))] = -1
            yield View(image, X_WC, seen, plant.profile.camera.noise_per_m, where), distance_m
            return


def who(model: Any, data: Any, robot: RobotDescription, pinhole: Pinhole) -> NDArray[np.int32]:
    """The body that each pixel's ray meets, shape (height, width)."""
    site = data.site(robot.sensors.camera.site)
    rays = pinhole.rays_C().reshape(-1, 3)
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    rays = rays @ site.xmat.reshape(3, 3).T
    own = int(model.site_bodyid[model.site(robot.sensors.camera.site).id])
    geoms, distances = np.empty(len(rays), np.int32), np.empty(len(rays))
    mujoco.mj_multiRay(
        model, data, site.xpos, rays.reshape(-1), SEEN, STATIC, own, geoms, distances, None,
        len(rays), 30.0,
    )  # fmt: skip
    found = np.where(geoms >= 0, model.geom_bodyid[geoms], -1).astype(np.int32)
    return found.reshape(pinhole.height, pinhole.width)


def judge(view: View, found: list[Thing], near: Score, far: Score) -> None:
    """Compare what was found with what is on the picture."""
    claimed: dict[int, Thing] = {}
    eye = np.array(view.X_WC.p)
    for thing in found:
        values, counts = np.unique(view.bodies[thing.pixels], return_counts=True)
        body = int(values[counts.argmax()])
        if body < 0:
            score = near if np.linalg.norm(thing.p_W - eye) < 1.2 else far
            score.alarms += 1
        elif body not in claimed or thing.pixels.sum() > claimed[body].pixels.sum():
            claimed[body] = thing
    depth_m = view.image.depth()
    assert depth_m is not None
    for body, truth in view.p_W.items():
        mask = view.bodies == body
        if mask.sum() < LEAST_PX or mask[0].any() or mask[-1].any() or mask[:, [0, -1]].any():
            continue
        distance_m = float(np.linalg.norm(truth - eye))
        if distance_m > FAR_M:
            continue
        there = mask & (depth_m > 0.0)
        if there.sum() < LEAST_SHARE * mask.sum():
            continue  # too near, or too dark for this camera
        score = near if distance_m < 1.2 else far
        score.seen += 1
        thing = claimed.get(body)
        if thing is None or (thing.pixels & there).sum() < LEAST_SHARE * there.sum():
            continue
        score.found += 1
        error = thing.p_W - truth
        score.errors_m.append(float(np.linalg.norm(error)))
        score.flat_m.append(float(np.linalg.norm(error[:2])))
        mahalanobis = math.sqrt(
            float(error[:2] @ np.linalg.solve(thing.covariance_W[:2, :2], error[:2]))
        )
        score.sigmas.append(mahalanobis)


@app.command()
def main(
    first: Annotated[int, typer.Option(help="The first seed.")] = 1000,
    count: Annotated[int, typer.Option("--views", help="How many seeds.")] = 40,
    reality: Annotated[str, typer.Option(help="ideal, real or harsh.")] = "real",
) -> None:
    robot = description.load("juno")
    near, far = Score(), Score()
    for seed in range(first, first + count):
        for view, _ in views(robot, seed, reality=reality):
            begin = time.process_time()
            points = cloud(view.image, view.X_WC, noise_per_m=view.noise_per_m)
            assert points is not None
            found = things(points, rng=np.random.default_rng(0))
            near.ms.append(1e3 * (time.process_time() - begin))
            judge(view, found, near, far)
    print(json.dumps({"within 1.2 m": near.told(), "1.2 to 2.5 m": far.told()}, indent=1))


if __name__ == "__main__":
    app()
