"""Things on the kitchen's table and counter in rendered pictures with a real camera's flaws."""

import numpy as np
import pytest

from robot.perception.tabletop.cloud import cloud
from robot.perception.tabletop.things import things
from robot.se3 import SE3
from sim.simulation import Simulation

NOISE_PER_M = 0.004
"""Of the reality's camera."""


@pytest.mark.parametrize(
    ("at", "pitch_rad", "ids"),
    [
        ((0.75, 0.2, 0.35), 0.7, ("red_cup", "blue_cup")),
        ((0.75, -0.1, 0.55), 0.6, ("red_cup", "blue_cup")),
    ],
)
def test_two_cups_on_a_table_are_found_within_a_centimetre_and_a_half(at, pitch_rad, ids):
    from robot.model import description

    robot = description.load("juno")
    plant = Simulation("real").world("kitchen").plant(robot, seed=21)
    plant.stand(SE3.from_xy_yaw(*at))
    plant.pose({"head_pitch": pitch_rad})
    with plant.camera(renderer="rays") as camera:
        image = camera.take(0.0)
    site = plant.data.site(image.frame)
    X_WC = SE3.from_rotation(site.xmat.reshape(3, 3), site.xpos)
    found = things(cloud(image, X_WC, noise_per_m=NOISE_PER_M), rng=np.random.default_rng(0))
    for name in ids:
        truth = np.array(plant.where(f"object/{name}").p)
        nearest = min(found, key=lambda one, truth=truth: np.linalg.norm(one.p_W - truth))
        assert np.linalg.norm(nearest.p_W - truth) < 0.015
        assert nearest.width_m == pytest.approx(0.07, abs=0.02)
        assert nearest.height_m == pytest.approx(0.10, abs=0.02)
