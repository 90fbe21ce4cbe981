"""People by lidar and depth, in scans and images of simulated worlds: who is told, who is not."""

import math

import msgspec
import mujoco
import numpy as np
import pytest

from robot.model import description
from robot.perception.company.company import Company
from robot.se3 import SE3
from sim import world
from sim.simulation import SimulatedWorld
from sim.world_schema import Furniture, Person

ROBOT = description.load("juno")
START = SE3.from_xy_yaw(-2.4, -1.1, 0.0)


class Scene:
    """A robot that stands in the bench, and its company."""

    def __init__(self, *people, furniture=(), told=None, look_rad=0.15):
        entries = world.load("bench")
        entries = msgspec.structs.replace(
            entries, people=people, furniture=(*entries.furniture, *furniture), objects=()
        )
        there = SimulatedWorld(entries, profile="real", eyes="camera", localisation="lidar")
        self.plant = there.plant(ROBOT, seed=3)
        self.plant.stand(START)
        self.plant.pose({"head_pitch": look_rad})
        unknown = {item.id for item in furniture}
        known = tuple(one for one in there.map.obstacles if one.id not in unknown)
        known_map = msgspec.structs.replace(there.map, obstacles=known)
        if told is not None:  # nor do outlines of people tell of them
            ids = {one.id for one in people}
            known = tuple(one for one in known if one.id not in ids)
            known_map = msgspec.structs.replace(there.map, obstacles=known, people=told)
        self.company = Company()
        self.company.know(known_map)
        self.now_s = 0.0

    def look(self, duration_s, *, camera=True, lidar=True):
        """Let time pass; the tracks that are told by then."""
        plant, data = self.plant, self.plant.data
        eye, laser = (
            data.site(site) for site in (ROBOT.sensors.camera.site, ROBOT.sensors.lidar.site)
        )
        for _ in range(round(duration_s / 0.1)):
            mujoco.mj_kinematics(plant.model, data)
            self.company.feel(plant.oracle.X_WB(), ())
            if lidar:
                X = SE3.from_rotation(laser.xmat.reshape(3, 3), laser.xpos)
                self.company.scan(plant.sending.lidar.scan(self.now_s), X)
            if camera:
                X = SE3.from_rotation(eye.xmat.reshape(3, 3), eye.xpos)
                self.company.see_depth(plant.sending.camera.capture(self.now_s), X)
            self.now_s += 0.1
        return self.told()

    def told(self):
        tracks = self.company.around(self.now_s).tracks
        return {t.id: t for t in tracks if not t.missing and math.isfinite(t.seen_s)}

    def put(self, id, x, y):
        self.plant.put(f"person/{id}", SE3.from_xy_yaw(x, y, 0.0))


def person(id="anna", at=(-0.4, -1.0), **more):
    return Person(id=id, at_m=at, **more)


def near(track, at, within_m):
    return math.dist(track.X_WO.p[:2], at) < within_m


@pytest.mark.parametrize("at", [(-1.2, -1.1), (-0.4, -1.0), (0.6, -1.6)])
def test_who_stands_in_view_is_found_where_they_are_and_has_their_covariance(at):
    scene = Scene(person(at=at))
    track = scene.look(1.5)["anna"]
    assert near(track, at, 0.15)
    assert track.posture == "stands"
    spread = np.linalg.eigvalsh(np.array(track.covariance).reshape(2, 2))
    assert 0.0 < spread[0] <= spread[1] < 0.15**2


def test_who_comes_is_told_at_once_though_no_head_is_in_view():
    scene = Scene(person(at=(2.4, 1.8)), look_rad=0.5)
    scene.look(1.5)
    scene.put("anna", -1.65, -1.1)
    assert near(scene.look(0.3)["anna"], (-1.65, -1.1), 0.2)


def test_a_shelf_that_the_map_does_not_know_is_nobody():
    shelf = Furniture(id="new_shelf", kind="shelf", at_m=(-0.2, -1.1), yaw_deg=180.0)
    assert Scene(furniture=(shelf,), told=()).look(3.0) == {}


def test_a_chair_that_was_pushed_there_is_nobody():
    chair = Furniture(id="new_chair", kind="chair", at_m=(-0.6, -1.1), size_m=(0.42, 0.42, 0.85))
    assert Scene(furniture=(chair,), told=()).look(3.0) == {}


def test_whose_place_is_seen_to_be_empty_has_gone():
    scene = Scene(person())
    scene.look(1.5)
    scene.put("anna", 8.0, 8.0)
    assert "anna" not in scene.look(1.5)


def test_who_is_no_told_one_is_a_stranger():
    scene = Scene(person(at=(-0.4, -1.6)), person("bob", at=(-0.4, -0.3)), told=())
    scene.look(2.0)
    strangers = scene.company.around(scene.now_s).strangers
    assert len(strangers) == 2 and {one.name for one in strangers} == {"a person"}


def test_what_the_simulator_knows_of_people_changes_nothing_but_what_is_sensed():
    """The same scans and images give the same tracks whoever they are of."""
    one, other = (Scene(person(id), told=()) for id in ("anna", "somebody_else"))
    found, again = one.look(1.5), other.look(1.5)
    assert [t.X_WO for t in found.values()] == [t.X_WO for t in again.values()] != []
