"""Tracks of people: what is hidden stays, what is seen through goes, a flicker is nobody."""

import math

import numpy as np
import pytest

from robot.perception.company.figures import CLEARLY, HARDLY, Figure
from robot.perception.company.returns import Returns, Sweep
from robot.perception.company.tracking import LARGEST_M, Everybody

AT = np.array([2.0, 0.0])
BEARINGS = np.radians(np.arange(-180.0, 180.0, 2.0))


def swept(now_s, *places, reach_m=6.0):
    clusters = tuple(
        Returns(np.array(p), 0.06, 3, 0.3, math.hypot(*p), is_free=True) for p in places
    )
    ranges = np.full(len(BEARINGS), reach_m)
    return Sweep(now_s, np.zeros(2), BEARINGS, ranges, clusters, np.zeros(0))


def figure(p=AT, evidence=CLEARLY):
    return Figure(np.array(p), 0.05**2 * np.eye(2), 1.7, evidence, "stands", raises_hand=False)


def somebody(*, nearest=AT):
    """Everybody, with one who is believed."""
    everybody = Everybody()
    for k in range(10):
        everybody.scan(swept(0.1 * k, nearest))
        everybody.look([figure(nearest)], [], 0.1 * k)
    assert len(everybody.believed()) == 1
    return everybody


def test_who_is_hidden_stays_where_they_were_less_and_less_sure():
    everybody = somebody()
    sure = np.trace(everybody.believed()[0].covariance[:2, :2])
    for k in range(40):
        everybody.scan(swept(1.0 + 0.1 * k, reach_m=1.0))
    track = everybody.believed()[0]
    spread = track.covariance[:2, :2]
    assert np.linalg.norm(track.p_W - AT) < 0.3
    assert np.trace(spread) > 4.0 * sure
    assert np.linalg.eigvalsh(spread)[-1] <= LARGEST_M**2 * 1.001


def test_whose_place_beams_go_through_has_gone():
    everybody = somebody()
    for k in range(6):
        everybody.scan(swept(1.0 + 0.1 * k))
    assert not everybody.believed()
    assert len(everybody.take_gone()) == 1 and not everybody.take_gone()


def test_what_goes_to_and_fro_along_a_wall_is_nobody():
    everybody = Everybody()
    rng = np.random.default_rng(0)
    for k in range(60):
        everybody.scan(swept(0.1 * k, (2.0, 0.4 * rng.uniform(-1.0, 1.0)), reach_m=2.1))
    assert not everybody.believed()


@pytest.mark.parametrize("speed_m_s", [0.4, 0.8, 1.2])
def test_what_walks_is_somebody_with_that_speed(speed_m_s):
    everybody = Everybody()
    for k in range(25):
        everybody.scan(swept(0.1 * k, (3.0, -1.5 + 0.1 * k * speed_m_s)))
    (track,) = everybody.believed()
    assert track.state[3] == pytest.approx(speed_m_s, abs=0.15)


def test_looks_that_speak_against_it_take_it_back():
    everybody = somebody()
    for k in range(20):
        everybody.scan(swept(1.0 + 0.1 * k, AT))
        everybody.look([figure(evidence=HARDLY)], [], 1.0 + 0.1 * k)
    assert not everybody.believed()


def test_what_stands_where_the_floor_was_free_has_come_and_what_always_did_has_not():
    came, stood = Everybody(), Everybody()
    for k in range(10):
        came.scan(swept(0.1 * k))
        stood.scan(swept(0.1 * k, AT))
    for k in range(10, 13):
        came.scan(swept(0.1 * k, AT))
        stood.scan(swept(0.1 * k, AT))
    assert len(came.believed()) == 1 and not stood.believed()


@pytest.mark.parametrize("seed", range(5))
def test_covariances_stay_symmetric_and_positive_however_measurements_come(seed):
    everybody, rng = Everybody(), np.random.default_rng(seed)
    for k in range(300):
        at = AT + rng.normal(0.0, 0.1, 2)
        if rng.random() < 0.7:
            everybody.scan(swept(0.1 * k, at))
        if rng.random() < 0.5:
            everybody.look([figure(at, float(rng.normal(0.5, 1.0)))], [], 0.1 * k)
    for track in everybody.tracks:
        assert np.allclose(track.covariance, track.covariance.T)
        assert np.linalg.eigvalsh(track.covariance)[0] > 0.0
