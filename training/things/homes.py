"""Pictures of homes that the world generator makes: other rooms than those that are learnt from.

A robot stands in them and looks at a thing, as `benchmarks.tabletop` has it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from robot.model import description
from robot.se3 import SE3
from sim.camera.scene_view import Pinhole
from sim.homes.home import home
from sim.rays import SEEN, STATIC
from sim.simulation import SimulatedWorld
from training.things.frames import Frame, Truth
from training.things.scenes import REALITY

KINDS = ("flat", "office", "clinic", "workshop")
NEAR_M, FAR_M = 0.45, 2.4
TRIES = 40
CAMERA, FAR_SIGHT_M = "head_camera", 30.0
LEAST_PX = 60


def looked_at(seed: int, *, pictures: int) -> Iterator[Frame]:
    """Pictures of one home."""
    rng = np.random.default_rng(seed)
    kind = KINDS[seed % len(KINDS)]
    robot = description.load("juno")
    entries = home(kind, seed, has_forms=True).world
    plant = SimulatedWorld(
        entries, name=f"{kind}:{seed}", vary_seed=None, profile=REALITY
    ).plant(robot, seed=seed)  # fmt: skip
    model, data, things = plant.model, plant.data, entries.objects
    bodies = [int(model.body(f"object/{one.id}").id) for one in things]
    item_of_body = np.full(model.nbody + 1, -1, dtype=np.int8)
    item_of_body[bodies] = np.arange(len(bodies))
    pinhole = Pinhole.of(robot)
    taken = 0
    with plant.camera(renderer="rays") as camera:
        for number in range(TRIES * pictures):
            target = int(rng.integers(len(bodies)))
            p = data.xpos[bodies[target]].copy()
            distance_m, bearing = rng.uniform(NEAR_M, FAR_M), rng.uniform(-math.pi, math.pi)
            x, y = p[0] - distance_m * math.cos(bearing), p[1] - distance_m * math.sin(bearing)
            plant.stand(SE3.from_xy_yaw(x, y, bearing + rng.uniform(-0.3, 0.3)))
            site = data.site(CAMERA)
            pitch = math.atan2(site.xpos[2] - p[2], distance_m) + rng.uniform(-0.15, 0.15)
            plant.pose({"head_pitch": min(max(pitch, -0.3), 0.8)})
            if not _is_free(model, data, camera.X_WC(), p, bodies[target]):
                continue
            image = camera.take(float(number))
            who = item_of_body[_bodies(model, data, camera.X_WC(), pinhole)]
            counts = np.bincount(who[who >= 0].ravel(), minlength=len(things))
            if counts[target] < LEAST_PX:
                continue
            truth = Truth(
                tuple(one.kind for one in things), tuple(one.color for one in things),
                data.xpos[bodies].copy(), data.xmat[bodies].reshape(-1, 3, 3).copy(),
                np.array([one.size_m for one in things]), counts,
            )  # fmt: skip
            yield Frame(image, camera.X_WC(), who, truth, target)
            taken += 1
            if taken == pictures:
                return


def _is_free(model: Any, data: Any, X_WC: SE3, p_W: np.ndarray, body: int) -> bool:
    """Whether a thing is before the camera, with nothing between."""
    eye = np.array(X_WC.p)
    sight = p_W - eye
    hit = np.full(1, -1, dtype=np.int32)
    own = int(model.site_bodyid[model.site(CAMERA).id])
    mujoco.mj_ray(model, data, eye, sight / np.linalg.norm(sight), SEEN, STATIC, own, hit)
    return bool(hit[0] >= 0 and model.geom_bodyid[hit[0]] == body)


def _bodies(model: Any, data: Any, X_WC: SE3, pinhole: Pinhole) -> np.ndarray:
    """The body that each pixel's ray meets, -1 for none, shape (height, width)."""
    rays = pinhole.rays_C().reshape(-1, 3)
    rays = rays / np.linalg.norm(rays, axis=1, keepdims=True) @ X_WC.rotation().T
    own = int(model.site_bodyid[model.site(CAMERA).id])
    geoms, distances = np.empty(len(rays), np.int32), np.empty(len(rays))
    mujoco.mj_multiRay(
        model, data, np.array(X_WC.p), rays.reshape(-1), SEEN, STATIC, own, geoms, distances, None,
        len(rays), FAR_SIGHT_M,
    )  # fmt: skip
    found = np.where(geoms >= 0, model.geom_bodyid[geoms], -1)
    return found.reshape(pinhole.height, pinhole.width)
