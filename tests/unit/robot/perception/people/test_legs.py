"""Clusters of a scan, their shapes, and which of them are legs."""

import numpy as np
import pytest

from benchmarks.people.scenes import NOBODY, a_laser, a_room, seen
from robot.perception.people.clusters import clusters
from robot.perception.people.forest import leg_forest
from robot.perception.people.legs import legs
from robot.perception.people.scan import PlanarScan
from robot.perception.people.shape import NAMES, WIDEST_M, shape
from robot.perception.people.standing import UNKNOWN, StandingThings
from tests.fakes.walkers import furnished, recorded

STEP_RAD = np.radians(0.5)


def a_scan(ranges_m, **more) -> PlanarScan:
    ranges_m = np.asarray(ranges_m, dtype=float)
    begin_rad = -0.5 * STEP_RAD * (len(ranges_m) - 1)
    return PlanarScan(
        t_s=0.0, ranges_m=ranges_m, angle_min_rad=begin_rad, angle_step_rad=STEP_RAD, **more
    )


def test_points_go_to_the_place_and_back():
    scan = a_scan([1.0, 2.0, 0.0, np.inf, np.nan, 3.0], pose=(1.0, -2.0, 0.7))
    assert scan.points_m.shape == (3, 2)
    assert scan.in_laser(scan.in_place(scan.points_m)) == pytest.approx(scan.points_m)
    ahead = scan.in_place(np.array([[1.0, 0.0]]))[0]
    assert ahead == pytest.approx([1.0 + np.cos(0.7), -2.0 + np.sin(0.7)])


def test_clusters_are_runs_of_neighbours():
    # Two things before a wall; what has two returns is nothing; a lost beam does not cut.
    ranges_m = [4.0] * 5 + [2.0] * 4 + [4.0] * 6 + [1.0, 0.0, 1.0, 1.0] + [4.0] * 5 + [3.0] * 2
    found = clusters(a_scan(ranges_m))
    assert [len(cluster.points_m) for cluster in found] == [5, 4, 6, 3, 5]
    assert clusters(a_scan([0.0, np.nan, np.inf])) == []


def test_a_shape_does_not_depend_on_where_it_is_seen():
    def of(turn: int) -> np.ndarray:
        ranges_m = np.full(60, 4.0)
        ranges_m[20 + turn : 27 + turn] = [2.03, 2.01, 2.0, 1.995, 2.0, 2.01, 2.03]
        scan = a_scan(ranges_m)
        return next(shape(scan, one) for one in clusters(scan) if len(one.points_m) == 7)

    assert of(0) == pytest.approx(of(12), abs=1e-9)
    assert len(of(0)) == len(NAMES)
    assert of(0)[NAMES.index("bulge_m")] > 0.0
    assert of(0)[NAMES.index("in_front_before_m")] == pytest.approx(1.97)


def test_the_forest_tells_legs_from_clutter_in_rooms_it_never_saw():
    random = np.random.default_rng(987)
    shapes, are_legs = [], []
    for _ in range(80):
        scan, whose = seen(a_room(random), a_laser(random), random)
        for cluster in clusters(scan):
            share = float((whose[cluster.begin : cluster.end] != NOBODY).mean())
            far = np.linalg.norm(cluster.points_m[-1] - cluster.points_m[0])
            if far <= WIDEST_M and not 0.1 < share < 0.7:
                shapes.append(shape(scan, cluster))
                are_legs.append(share >= 0.7)
    found, truth = leg_forest().probability(np.array(shapes)), np.array(are_legs)
    assert (found[truth] > 0.5).mean() > 0.85
    assert (found[~truth] > 0.5).mean() < 0.15


def test_what_stands_is_known_after_a_while_also_where_somebody_walked_by():
    scans, places = recorded([[(3.0, -1.0), (3.0, 1.2)]], seconds=12.0)
    standing = StandingThings()
    pole, way = np.array([[1.145, -1.145]]), places[::10, 0]
    assert standing.share(scans[0], pole)[0] == UNKNOWN
    for scan in scans:
        standing.look(scan)
    assert standing.share(scans[0], pole)[0] > 0.8
    assert standing.share(scans[0], way).max() < 0.4


def test_what_stands_is_known_from_wherever_the_laser_is():
    standing = StandingThings()
    scans, _ = recorded([], seconds=1.0)
    for scan in scans:
        standing.look(scan)
    moved = PlanarScan(
        t_s=2.0, ranges_m=scans[0].ranges_m, angle_min_rad=0.0, angle_step_rad=0.01,
        pose=(0.5, 0.3, 1.0),
    )  # fmt: skip
    pole = moved.in_laser(np.array([[1.145, -1.145]]))
    assert standing.share(moved, pole)[0] > 0.7


def test_legs_are_likelier_where_nothing_stands():
    scans, places = recorded([[(2.6, -0.9), (2.6, 1.0)]], seconds=10.0)
    standing = StandingThings()
    for scan in scans:
        standing.look(scan)
    at = np.array([(leg.x_m, leg.y_m) for leg in legs(scans[50], standing)])
    scores = np.array([leg.score for leg in legs(scans[50], standing)])
    near = np.linalg.norm(at - places[50, 0], axis=1) < 0.45
    assert near.any()
    assert scores[near].min() > 0.8
    pole = np.linalg.norm(at - (1.2, -1.2), axis=1) < 0.15
    assert scores[pole].max() < 0.3


def test_a_scan_without_returns_has_no_legs():
    assert legs(a_scan(np.zeros(100)), StandingThings()) == []
    assert furnished().ellipses  # the room of these tests is not an empty one
