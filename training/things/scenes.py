"""Scenes made from seeds: a room, things that stand in it, and pictures of them.

A scene is compiled once and looked at several times: for each picture its things are put elsewhere,
the light is another one, and so are the camera's faults. Renders come from the camera code that
ships (`sim.camera`), by rays.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.messages import RgbdImage
from robot.se3 import SE3, Array, Vector3
from sim import person_body, thing_bodies
from sim.camera.by_rays import Tracer
from sim.camera.flaws import CameraFlaws
from sim.camera.scene_view import Pinhole
from sim.paint import Paint
from sim.palette import COLORS
from sim.realities import profile
from sim.things.catalogue import Closed, Packet
from sim.things.making import made, make
from sim.things.thing import Thing
from sim.world_schema import Person
from training.things import invented, rooms
from training.things.frames import Frame, Truth
from training.things.splits import ROOMS, Split, family, kinds
from training.things.strangers import stranger

PINHOLE = Pinhole(320, 240, 120.0 / math.tan(math.radians(30.0)))
"""As Juno's camera has it."""
REALITY = "real"
SHOWN = (4, 12)
"""Things of a picture, at least and at most."""
LIES_SHARE = 0.08
LYING = ("bottles", "cans", "boxes")
PERSON, PEOPLE_SHARE = "somebody", 0.35
"""Somebody stands in so many pictures, whom nobody should take for a thing."""
STANDING_M = ((-1.2, 1.3), (-1.6, 2.6))
AWAY_M = -50.0
EYE_M, NEAR_M, FAR_M = (1.0, 1.35), 0.35, 2.6
BEARING = (-1.9, 1.9)
"""From the side without a wall, mostly."""
END_M = 0.7
"""Where a walk to a thing ends."""
TRIES = 25
SPLITS: tuple[Split, ...] = ("train", "choose", "judge")


class Mix(NamedTuple):
    """How many things of a scene are of kinds, put together anyhow, and of invented kinds."""

    known: int = 11
    strangers: int = 3
    invented: int = 0


USUAL, ODD = Mix(), Mix(known=7, strangers=1, invented=6)


@dataclass
class Item:
    """A thing of a scene."""

    kind: str
    color: str
    size_m: Vector3
    radius_m: float
    body: int = -1
    can_lie: bool = False


class Scene:
    """A room with things, as a seed makes it."""

    def __init__(self, split: Split, seed: int, mix: Mix = USUAL) -> None:
        """Make and compile it."""
        self._rng = rng = np.random.default_rng([SPLITS.index(split), seed])
        self._seed = seed
        spec = mujoco.MjSpec()
        paint = Paint(spec)
        self._places = rooms.furnish(spec, paint, ROOMS[split], rng)
        self._items = [
            *(self._known(spec, paint, number, split) for number in range(mix.known)),
            *(self._stranger(spec, paint, mix.known + number) for number in range(mix.strangers)),
            *(self._invented(spec, paint, mix.known + mix.strangers + number, split)
              for number in range(mix.invented)),
        ]  # fmt: skip
        colors = sorted(COLORS)
        somebody = Person(id=PERSON, at_m=(0.0, 0.0), height_m=float(rng.uniform(1.5, 1.95)),
                          color=colors[int(rng.integers(len(colors)))])  # fmt: skip
        person_body.add_person(spec, somebody, paint)
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        names = [f"thing/{number}" for number in range(len(self._items))]
        for item, body in zip(self._items, names, strict=True):
            item.body = int(self._model.body(body).id)
        self._item_of_body = np.full(self._model.nbody + 1, -1, dtype=np.int8)
        for number, item in enumerate(self._items):
            self._item_of_body[item.body] = number
        self._paints = self._model.mat_rgba.copy()
        self._lamps = self._model.light_diffuse.copy()
        self._headlight = (self._model.vis.headlight.ambient.copy(),
                           self._model.vis.headlight.diffuse.copy())  # fmt: skip
        self._names = names

    def frame(self, number: int) -> Frame | None:
        """A picture; None if no thing could be looked at."""
        shown = self._arranged()
        for _ in range(TRIES if shown else 0):
            target = shown[int(self._rng.integers(len(shown)))]
            distance_m = NEAR_M + (FAR_M - NEAR_M) * float(self._rng.random()) ** 1.5
            X_WC = self._look_at(target, distance_m, float(self._rng.uniform(*BEARING)))
            if X_WC is not None:
                return self._taken(X_WC, number, target)
        return None

    def walk(self, count: int) -> list[Frame]:
        """Pictures of one arrangement on the way to a thing; none if that is hidden from afar."""
        shown = self._arranged()
        for _ in range(TRIES if shown else 0):
            target = shown[int(self._rng.integers(len(shown)))]
            start_m, bearing = (
                float(self._rng.uniform(1.6, 2.4)),
                float(self._rng.uniform(*BEARING)),
            )
            ways = [
                (
                    away_m,
                    self._look_at(target, away_m, bearing + float(self._rng.normal(0.0, 0.06))),
                )
                for away_m in np.linspace(start_m, END_M, count).tolist()
            ]
            if all(X_WC is not None for _, X_WC in ways):
                return [self._taken(X_WC, number, target)
                        for number, (_, X_WC) in enumerate(ways) if X_WC is not None]  # fmt: skip
        return []

    def _arranged(self) -> list[int]:
        """Put things and lamps elsewhere; the things that are shown."""
        shown = self._place()
        self._put_person()
        mujoco.mj_kinematics(self._model, self._data)
        self._light()
        mujoco.mj_camlight(self._model, self._data)
        return shown

    def _known(self, spec: mujoco.MjSpec, paint: Paint, number: int, split: Split) -> Item:
        rng, names = self._rng, kinds(split)
        name = names[int(rng.integers(len(names)))]
        thing: Thing = made(name, int(rng.integers(*ROOMS[split].variants)))
        body = spec.worldbody.add_body(name=f"thing/{number}", mocap=True)
        thing_bodies.shape(body, spec, thing, paint)
        return Item(name, thing.color, thing.size_m, thing.radius_m,
                    can_lie=family(name) in LYING)  # fmt: skip

    def _invented(self, spec: mujoco.MjSpec, paint: Paint, number: int, split: Split) -> Item:
        rng = self._rng
        kind = invented.invented(int(rng.integers(*invented.NUMBERS[split])))
        thing = make(kind, invented.name(kind), int(rng.integers(1, 1000)))
        body = spec.worldbody.add_body(name=f"thing/{number}", mocap=True)
        # Two of them have the same name where they are of one form: each has its own here.
        thing_bodies.shape(body, spec, thing._replace(name=f"{number}/{thing.name}"), paint)
        return Item(invented.name(kind), thing.color, thing.size_m, thing.radius_m,
                    can_lie=isinstance(kind.of, Closed | Packet))  # fmt: skip

    def _stranger(self, spec: mujoco.MjSpec, paint: Paint, number: int) -> Item:
        name = f"thing/{number}"
        body = spec.worldbody.add_body(name=name, mocap=True)
        size_m, radius_m = stranger(body, spec, name, paint, self._rng)
        return Item("", "", size_m, radius_m)

    def _place(self) -> list[int]:
        """Put some things onto one or two places, the others away; those that found room."""
        rng, data = self._rng, self._data
        data.mocap_pos[:] = (0.0, 0.0, AWAY_M)
        on_floor = rng.random() < 0.08
        last = len(self._places) - 1
        used = [last] if on_floor or not last else rng.integers(last, size=2).tolist()
        count = int(rng.integers(SHOWN[0], SHOWN[1] + 1))
        gap_m = float(rng.choice((0.005, 0.03, 0.08)))
        taken: list[tuple[Array, float]] = []
        shown: list[int] = []
        for number in rng.permutation(len(self._items)).tolist()[:count]:
            item = self._items[number]
            lies = item.can_lie and rng.random() < LIES_SHARE
            high = item.size_m[0] if lies else item.size_m[2]
            radius = float(np.hypot(item.size_m[2], item.size_m[1]) / 2) if lies else item.radius_m
            for _ in range(TRIES):
                place = self._places[used[int(rng.integers(len(used)))]]
                half = np.array(place.size_m) / 2 - 0.7 * radius
                if high > place.clearance_m - 0.01 or half.min() <= 0.0:
                    continue
                xy = rng.uniform(-half, half)
                p_W = place.X_WP.apply((float(xy[0]), float(xy[1]), high / 2))
                if all(np.linalg.norm(p_W - p) > radius + r + gap_m for p, r in taken):
                    yaw = SE3.from_rpy(0.0, math.pi / 2 if lies else 0.0, 0.0, (0.0, 0.0, 0.0))
                    turn = SE3.from_xy_yaw(0.0, 0.0, float(rng.uniform(-math.pi, math.pi))) @ yaw
                    mocap = int(self._model.body_mocapid[item.body])
                    data.mocap_pos[mocap], data.mocap_quat[mocap] = p_W, turn.quat_wxyz
                    taken.append((p_W, radius))
                    shown.append(number)
                    break
        return shown

    def _put_person(self) -> None:
        rng = self._rng
        if rng.random() < PEOPLE_SHARE:
            mocap = int(self._model.body_mocapid[self._model.body(f"person/{PERSON}").id])
            x, y = (float(rng.uniform(*limits)) for limits in STANDING_M)
            turn = SE3.from_xy_yaw(x, y, float(rng.uniform(-math.pi, math.pi)))
            self._data.mocap_pos[mocap], self._data.mocap_quat[mocap] = turn.p, turn.quat_wxyz

    def _light(self) -> None:
        """Another light: lamps from elsewhere, of another strength and temperature."""
        rng, model = self._rng, self._model
        tint = np.exp(rng.normal(0.0, 0.10, 3))
        for lamp in range(model.nlight):
            direction = np.array([*rng.normal(0.0, 0.6, 2), -1.0])
            model.light_dir[lamp] = direction / np.linalg.norm(direction)
            model.light_diffuse[lamp] = self._lamps[lamp] * tint * rng.uniform(0.3, 1.8)
        ambient, diffuse = self._headlight
        model.vis.headlight.ambient[:] = ambient * tint * rng.uniform(0.6, 1.2)
        model.vis.headlight.diffuse[:] = diffuse * rng.uniform(0.3, 1.5)
        model.mat_rgba[:, :3] = np.clip(
            self._paints[:, :3] * np.exp(rng.normal(0.0, 0.08, (model.nmat, 3))), 0.0, 1.0
        )

    def _look_at(self, number: int, distance_m: float, bearing: float) -> SE3 | None:
        """Where the camera is when it looks at a thing; None if that is hidden."""
        rng = self._rng
        target = self._data.xpos[self._items[number].body]
        x, y = (float(target[0]) + distance_m * math.cos(bearing),
                float(target[1]) + distance_m * math.sin(bearing))  # fmt: skip
        eye = np.array([x, y, rng.uniform(*EYE_M)])
        sight = target - eye
        away_m = float(np.linalg.norm(sight))
        hit = np.full(1, -1, dtype=np.int32)
        mujoco.mj_ray(self._model, self._data, eye, sight / away_m, None, 1, -1, hit)
        if hit[0] < 0 or self._model.geom_bodyid[hit[0]] != self._items[number].body:
            return None
        yaw = math.atan2(sight[1], sight[0]) + float(rng.uniform(-0.35, 0.35))
        pitch = math.atan2(-sight[2], math.hypot(sight[0], sight[1]))
        pitch += float(rng.uniform(-0.25, 0.25))
        X_WE = SE3.from_rpy(float(rng.normal(0.0, 0.03)), pitch, yaw, (0.0, 0.0, 0.0))
        R_EC = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
        return SE3.from_rotation(X_WE.rotation() @ R_EC, eye)

    def _taken(self, X_WC: SE3, number: int, target: int) -> Frame:
        rng = self._rng
        tracer = Tracer(self._model, self._data, PINHOLE)
        view = tracer.look(np.array(X_WC.p), X_WC.rotation())
        seed = 1000 * self._seed + number
        flaws = CameraFlaws(profile(REALITY).camera, PINHOLE, seed=seed)
        shot = flaws.shoot(view, stamp_s=0.0, turning_C=rng.normal(0.0, 0.1, 3))
        image = RgbdImage(
            stamp_s=0.0, width=PINHOLE.width, height=PINHOLE.height,
            focal_px=(PINHOLE.focal_px, PINHOLE.focal_px), centre_px=PINHOLE.centre_px,
            frame="head_camera", colours=shot.colours.tobytes(),
            depth_m=shot.depth_m.tobytes(), exposure_s=shot.exposure_s,
        )  # fmt: skip
        bodies = np.where(tracer.met >= 0, self._model.geom_bodyid[tracer.met], -1)
        who: NDArray[np.int8] = self._item_of_body[bodies]
        return Frame(image, X_WC, who, self._truth(who), target)

    def _truth(self, who: NDArray[np.int8]) -> Truth:
        bodies = [item.body for item in self._items]
        return Truth(
            tuple(item.kind for item in self._items),
            tuple(item.color for item in self._items),
            self._data.xpos[bodies].copy(),
            self._data.xmat[bodies].reshape(-1, 3, 3).copy(),
            np.array([item.size_m for item in self._items]),
            np.bincount(who[who >= 0].ravel(), minlength=len(bodies)),
        )
