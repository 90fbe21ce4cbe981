"""Things on surfaces are nobody, by whatever sense and however near: nobody is inside furniture."""

import math

import msgspec
import mujoco
import numpy as np
import pytest

from robot.messages import Place
from robot.model import description
from robot.perception.company.company import Company
from robot.perception.company.mapped import SEAT_M, MappedSolids
from robot.se3 import SE3
from sim import world
from sim.simulation import SimulatedWorld
from sim.world_schema import Furniture, Object

ROBOT = description.load("juno")
CASE = Furniture(
    id="bookcase", kind="shelf", at_m=(-1.6, -1.1), yaw_deg=180.0, size_m=(0.30, 0.90, 1.20),
    boards_m=(0.62, 0.92),
)  # fmt: skip
TEA = Object(
    id="tea", category="box", color="green", shape="box", size_m=(0.07, 0.07, 0.09), mass_kg=0.1,
    on="bookcase_lower", at_m=(0.02, -0.15),
)  # fmt: skip


def told_before(company: Company, plant, seconds: float) -> set[str]:
    """Who is told, or may be somebody, when a robot has stood there for a while."""
    data, found = plant.data, set()
    eye, laser = (data.site(site) for site in (ROBOT.sensors.camera.site, ROBOT.sensors.lidar.site))
    for k in range(round(10 * seconds)):
        mujoco.mj_kinematics(plant.model, data)
        company.feel(plant.oracle.X_WB(), ())
        X_WL = SE3.from_rotation(laser.xmat.reshape(3, 3), laser.xpos)
        company.scan(plant.sending.lidar.scan(0.1 * k), X_WL)
        X_WC = SE3.from_rotation(eye.xmat.reshape(3, 3), eye.xpos)
        company.see_depth(plant.sending.camera.capture(0.1 * k), X_WC)
        around = company.around(0.1 * k)
        found |= {t.id for t in around.tracks if not t.missing and math.isfinite(t.seen_s)}
        found |= {"maybe" for _ in around.unsure}
    return found


@pytest.mark.parametrize("away_m", [0.55, 0.9])
def test_a_box_in_a_bookcase_is_nobody_who_stands_in_it(away_m: float):
    entries = world.load("bench")
    entries = msgspec.structs.replace(
        entries, people=(), furniture=(*entries.furniture, CASE), objects=(TEA,)
    )
    there = SimulatedWorld(entries, profile="real", eyes="camera", localisation="lidar")
    plant = there.plant(ROBOT, seed=3)
    plant.stand(SE3.from_xy_yaw(-1.6 - away_m, -0.95, 0.0))
    plant.pose({"head_pitch": 0.5})
    company = Company()
    company.know(there.map)
    assert told_before(company, plant, 2.0) == set()


def strange(z_m: float, point: tuple[float, float, float]) -> bool:
    top = Place(id="top", name="top", X_WP=SE3.from_xy_yaw(1.0, 0.0, 0.5) @ SE3((0, 0, z_m)),
                size_m=(0.6, 1.2))  # fmt: skip
    solids = MappedSolids((), (top,))
    return bool(solids.strange(np.array([point]), np.array([1.0]))[0])


def test_people_sit_on_seats_and_stand_beside_tables():
    assert not strange(0.74, (1.0, 0.0, 0.85))
    assert strange(SEAT_M - 0.05, (1.0, 0.0, 0.85))
    assert strange(0.74, (1.5, 0.0, 0.85))
    assert strange(0.74, (1.0, 0.0, 0.3)), "under a table somebody may lie"
