"""How well things of a home get their names by the robot's own eyes: no robot walks, it only looks.

In each home it is put before one surface after the other, ever nearer, and looks at what is there,
a little wrong about where it is itself. What its world model says in the end is compared with the
simulator: names on the right thing, on a wrong one, on nothing, and things that got no name.

    python -m benchmarks.own_eyes flat:1 office:2 kitchen
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator
from typing import Annotated, Any, NamedTuple

import mujoco
import numpy as np
import typer

from robot.messages import ObjectInfo, Place, RgbdImage, WorldMap
from robot.model import description
from robot.model.description import RobotDescription
from robot.perception.sight.seer import Seer
from robot.perception.sight.tracking import Seen
from robot.se3 import SE3
from sim.rays import SEEN, STATIC
from sim.simulation import Simulation

STAND_M = (1.5, 0.85, 0.45)
"""From the edge of a surface, ever nearer."""
SPREAD_M = 0.8
"""Of a long surface one stance after the other."""
LOOKS, AGAIN_S = 3, 0.2
PLACE_M, TURN_RAD = 0.01, math.radians(0.5)
"""1 sigma of what the robot is wrong about where it is, in one stance."""
SWAY_M = 0.002
RIGHT_M = 0.08
"""A name so near to its thing is on it."""
app = typer.Typer(add_completion=False)


class Picture(NamedTuple):
    """A picture, and where the robot believes that it was taken."""

    image: RgbdImage
    X_WC: SE3


class Named(NamedTuple):
    """What became of one told thing that was looked at."""

    told: ObjectInfo
    verdict: str
    what: str


class Home:
    """A home with a robot that is put here and there."""

    def __init__(self, name: str, *, reality: str, robot: RobotDescription, seed: int) -> None:
        """Build it. Raises ConfigError as `Simulation.world`."""
        self.world = Simulation(reality).world(name)
        self.robot = robot
        self.map: WorldMap = self.world.map
        self.plant = self.world.plant(robot, seed=seed)
        self._rng = np.random.default_rng(seed)
        self._time_s = 0.0

    def pictures(self) -> Iterator[Picture]:
        """All of a walk past everything that something can stand on."""
        with self.plant.camera(renderer="rays") as camera:
            for place in self.map.places:
                if not place.floor:
                    yield from self._before(place, camera)

    def _before(self, place: Place, camera: Any) -> Iterator[Picture]:
        front = self._front(place)
        if front is None:
            return
        x, y = front
        half_m = 0.5 * (place.size_m[0] if x else place.size_m[1])
        wide_m = place.size_m[1] if x else place.size_m[0]
        stances = max(1, round(wide_m / SPREAD_M))
        for away_m in STAND_M:
            for number in range(stances):
                along_m = ((number + 0.5) / stances - 0.5) * wide_m
                eye_m = half_m + away_m + 0.15
                at_P = (x * eye_m - y * along_m, y * eye_m + x * along_m, 0.0)
                to_P = (x * 0.3 * half_m - y * along_m, y * 0.3 * half_m + x * along_m, 0.0)
                yield from self._stance(place.X_WP.apply(at_P), place.X_WP.apply(to_P), camera)

    def _front(self, place: Place) -> tuple[int, int] | None:
        """The side of a surface with room before it, in its own axes; its own front if there is."""
        free = {side: self._free_m(place, side) for side in ((1, 0), (-1, 0), (0, 1), (0, -1))}
        wanted_m = STAND_M[1] + 0.3
        for side, free_m in free.items():
            if free_m > wanted_m:
                return side
        return None

    def _free_m(self, place: Place, side: tuple[int, int]) -> float:
        x, y = side
        model, data = self.plant.model, self.plant.data
        half_m = 0.5 * (place.size_m[0] if x else place.size_m[1]) - 0.02
        start = np.array(place.X_WP.apply((x * half_m, y * half_m, 0.0)))
        start[2] += 0.06
        way = place.X_WP.rotation() @ np.array([float(x), float(y), 0.0])
        geom = np.zeros(1, np.int32)
        own = int(model.body("pelvis").id)
        free_m = mujoco.mj_ray(model, data, start, way, SEEN, STATIC, own, geom)
        return math.inf if free_m < 0.0 else float(free_m)

    def _stance(self, at_W: Any, to_W: Any, camera: Any) -> Iterator[Picture]:
        robot, rng, plant = self.robot, self._rng, self.plant
        yaw = math.atan2(to_W[1] - at_W[1], to_W[0] - at_W[0])
        plant.stand(SE3.from_xy_yaw(float(at_W[0]), float(at_W[1]), yaw))
        site = plant.data.site(robot.sensors.camera.site)
        flat_m = math.hypot(to_W[0] - site.xpos[0], to_W[1] - site.xpos[1])
        pitch = math.atan2(float(site.xpos[2]) - to_W[2] - 0.05, flat_m)
        plant.pose({"head_pitch": min(max(pitch, -0.3), 0.8)})
        dx_m, dy_m = rng.normal(0.0, PLACE_M, 2).tolist()
        error = SE3.from_xy_yaw(dx_m, dy_m, float(rng.normal(0.0, TURN_RAD)))
        middle = SE3((float(at_W[0]), float(at_W[1]), 0.0))
        off = middle @ error @ middle.inverse()
        for _ in range(LOOKS):
            self._time_s += AGAIN_S
            X_WC = SE3.from_rotation(site.xmat.reshape(3, 3), site.xpos)
            sway = SE3(tuple(rng.normal(0.0, SWAY_M, 3).tolist()))
            yield Picture(camera.take(self._time_s), sway @ off @ X_WC)

    def named(self, named: dict[str, Seen]) -> list[Named]:
        """What became of every told thing."""
        truth = {
            one.id: np.array(self.plant.where(f"object/{one.id}").p) for one in self.map.objects
        }
        found: list[Named] = []
        for info in self.map.objects:
            track = named.get(info.id)
            if track is None:
                found.append(Named(info, "none", ""))
                continue
            away = {id: float(np.linalg.norm(p_W - track.p_W)) for id, p_W in truth.items()}
            nearest = min(away, key=lambda id: away[id])
            if away[info.id] < RIGHT_M:
                found.append(Named(info, "right", ""))
            else:
                verdict = "wrong" if away[nearest] < RIGHT_M else "ghost"
                found.append(Named(info, verdict, nearest if verdict == "wrong" else ""))
        return found


def walked(home: Home, pictures: Iterator[Picture], seer: Seer) -> set[str]:
    """Look at all pictures; names that were ever on a wrong thing or on nothing."""
    seer.tell(home.map)
    ever: set[str] = set()
    for picture in pictures:
        own = np.zeros((picture.image.height, picture.image.width), dtype=np.bool_)
        seer.look(picture.image, picture.X_WC, own=own, held={})
        ever |= {one.told.id for one in home.named(seer.named) if one.verdict in ("wrong", "ghost")}
    return ever


@app.command()
def main(
    homes: Annotated[list[str], typer.Argument(help="Worlds by name, file or kind:seed.")],
    reality: Annotated[str, typer.Option(help="ideal, real or harsh.")] = "real",
    robot: Annotated[str, typer.Option(help="By name.")] = "juno",
    seed: Annotated[int, typer.Option(help="Of all that is random.")] = 0,
    tells: Annotated[bool, typer.Option("--tell", help="Name all that went wrong.")] = False,
) -> None:
    body = description.load(robot)
    total: Counter[str] = Counter()
    for name in homes:
        home = Home(name, reality=reality, robot=body, seed=seed)
        seer = Seer()
        ever = walked(home, home.pictures(), seer)
        verdicts = home.named(seer.named)
        counted = Counter(one.verdict for one in verdicts) + Counter(ever=len(ever))
        total += counted
        print(json.dumps({"home": name, **counted}), flush=True)
        for one in verdicts if tells else ():
            if one.verdict != "right":
                print(f"   {one.told.full_name}: {one.verdict} {one.what}", flush=True)
    print(json.dumps({"all": dict(total)}))


if __name__ == "__main__":
    app()
