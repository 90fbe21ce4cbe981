"""Key frames and what is known between them: the best poses, whatever a wrong loop says."""

from __future__ import annotations

import numpy as np

from robot.fusion.slam.planar import between, compose
from robot.fusion.slam.pose_graph import PoseGraph
from robot.se3 import Array

INFORMATION = np.diag([1 / 0.03**2, 1 / 0.03**2, 1 / 0.01**2])


def _circle(count: int = 60) -> Array:
    angles = np.linspace(0.0, 2 * np.pi, count, endpoint=False)
    return np.column_stack([5 * np.sin(angles), 5 - 5 * np.cos(angles), angles])


def _drifted(true: Array, *, bias_rad: float) -> tuple[PoseGraph, Array]:
    graph, poses = PoseGraph(), [true[0]]
    for k in range(1, len(true)):
        step = np.add(between(true[k - 1], true[k]), [0.0, 0.0, bias_rad])
        graph.add(k - 1, k, step, INFORMATION, robust=False, length_m=0.5)
        poses.append(compose(poses[-1], step))
    return graph, np.array(poses)


def _loop(graph: PoseGraph, begin: int, end: int, measured: Array) -> None:
    graph.add(begin, end, measured, INFORMATION, robust=True, length_m=0.3)


def test_a_loop_takes_the_drift_out_of_the_whole_way():
    true = _circle()
    graph, drifted = _drifted(true, bias_rad=0.01)
    for k in range(5):
        _loop(graph, k, 55 + k, between(true[k], true[55 + k]))
    found = graph.optimised(drifted)
    worst = np.hypot(*(found - true)[:, :2].T).max()
    assert np.hypot(*(drifted - true)[:, :2].T).max() > 1.0
    assert worst < 0.15


def test_wrong_loops_lose_their_say():
    true = _circle()
    graph, drifted = _drifted(true, bias_rad=0.004)
    for k in range(6):
        _loop(graph, k, 54 + k, between(true[k], true[54 + k]))
    clean = graph.optimised(drifted)
    _loop(graph, 10, 40, np.zeros(3))
    _loop(graph, 3, 30, np.array([1.0, -2.0, 1.0]))
    bent = graph.optimised(drifted)
    assert np.hypot(*(bent - clean)[:, :2].T).max() < 0.1


def test_without_loops_nothing_moves():
    graph, drifted = _drifted(_circle(), bias_rad=0.01)
    np.testing.assert_allclose(graph.optimised(drifted)[:, :2], drifted[:, :2], atol=1e-6)


def test_the_way_between_two_key_frames_is_short_across_a_loop():
    graph, _ = _drifted(_circle(), bias_rad=0.0)
    before = graph.way_from(59, 60)
    _loop(graph, 0, 59, np.zeros(3))
    after = graph.way_from(59, 60)
    assert before[0] > 25.0
    assert after[0] < 1.0
    assert np.all(after <= before)
