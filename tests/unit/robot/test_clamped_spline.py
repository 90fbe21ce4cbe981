"""The spline of trajectories: at rest at both ends, smooth, the same one by one or many at once."""

import numpy as np
import pytest

from robot.kinematics.spline import ClampedSpline


@pytest.fixture(params=[2, 3, 7])
def spline(request):
    rng = np.random.default_rng(request.param)
    times_s = np.cumsum(rng.uniform(0.1, 1.0, request.param))
    return ClampedSpline(times_s, rng.standard_normal((request.param, 4)))


def test_many_times_at_once_are_the_same_as_one_by_one(spline):
    first, last = spline.times_s[[0, -1]]
    times_s = np.linspace(first, last, 23)
    for derivative in range(3):
        many = spline.sample(times_s, derivative=derivative)
        for time_s, value in zip(times_s, many, strict=True):
            np.testing.assert_allclose(value, spline.at(float(time_s))[derivative], atol=1e-12)


def test_it_rests_at_its_ends(spline):
    ends = spline.sample(spline.times_s[[0, -1]], derivative=1)
    np.testing.assert_allclose(ends, 0.0, atol=1e-12)


@pytest.mark.parametrize("derivative", [0, 1])
def test_derivatives_are_those_of_the_values(spline, derivative):
    first, last = spline.times_s[[0, -1]]
    times_s, h = np.linspace(first + 1e-3, last - 1e-3, 17), 1e-6
    after = spline.sample(times_s + h, derivative=derivative)
    before = spline.sample(times_s - h, derivative=derivative)
    slope = spline.sample(times_s, derivative=derivative + 1)
    np.testing.assert_allclose((after - before) / (2 * h), slope, atol=1e-3 * np.abs(slope).max())
