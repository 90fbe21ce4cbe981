"""Rigid transforms: group laws, and the same numbers as matrices give."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.se3 import (
    SE3,
    matrix_to_quat,
    quat_to_matrix,
    rotate,
    rotation_vector,
    rotation_vectors,
    wrap_angle,
)

angles = st.floats(-math.pi, math.pi)
lengths = st.floats(-10.0, 10.0)
poses = st.builds(SE3.from_rpy, angles, angles, angles, st.tuples(lengths, lengths, lengths))


@given(poses, poses)
def test_composition_is_the_product_of_matrices(X_AB, X_BC):
    np.testing.assert_allclose((X_AB @ X_BC).matrix(), X_AB.matrix() @ X_BC.matrix(), atol=1e-12)


@given(poses, poses, poses)
def test_composition_is_associative(X_AB, X_BC, X_CD):
    left, right = (X_AB @ X_BC) @ X_CD, X_AB @ (X_BC @ X_CD)
    np.testing.assert_allclose(left.matrix(), right.matrix(), atol=1e-12)


@given(poses)
def test_the_inverse_undoes_a_pose_from_both_sides(X):
    np.testing.assert_allclose((X @ X.inverse()).matrix(), np.eye(4), atol=1e-12)
    np.testing.assert_allclose((X.inverse() @ X).matrix(), np.eye(4), atol=1e-12)


tilts = st.floats(-1.5, 1.5)


@given(angles, tilts, angles)
def test_roll_pitch_and_yaw_come_back(roll, pitch, yaw):
    X = SE3.from_rpy(roll, pitch, yaw, (1.0, 2.0, 3.0))
    again = SE3.from_rpy(*X.rpy_rad, X.p)
    np.testing.assert_allclose(again.matrix(), X.matrix(), atol=1e-9)


@given(poses, st.tuples(lengths, lengths, lengths))
def test_a_point_goes_there_and_back(X, point):
    np.testing.assert_allclose(X.inverse().apply(X.apply(point)), point, atol=1e-11)


@given(poses, st.tuples(lengths, lengths, lengths))
def test_rotate_is_the_matrix_times_the_vector(X, v):
    np.testing.assert_allclose(rotate(X.quat_wxyz, v), X.rotation() @ v, atol=1e-12)


@given(poses)
def test_a_matrix_gives_its_quaternion_back(X):
    quat = matrix_to_quat(X.rotation())
    assert quat[0] >= 0.0
    assert math.isclose(math.hypot(*quat), 1.0, abs_tol=1e-12)
    np.testing.assert_allclose(quat_to_matrix(quat), X.rotation(), atol=1e-9)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_half_turns_have_no_weak_spot(axis):
    rotation = -np.eye(3)
    rotation[axis, axis] = 1.0
    np.testing.assert_allclose(quat_to_matrix(matrix_to_quat(rotation)), rotation, atol=1e-12)


@given(angles, angles, st.floats(-1.5, 1.5))
def test_roll_pitch_yaw_turn_in_this_order(roll, yaw, pitch):
    def turn(axis, angle):
        c, s = math.cos(angle), math.sin(angle)
        i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        matrix = np.eye(3)
        matrix[i, i] = matrix[j, j] = c
        matrix[i, j], matrix[j, i] = -s, s
        return matrix

    X = SE3.from_rpy(roll, pitch, yaw, (0.0, 0.0, 0.0))
    expected = turn("z", yaw) @ turn("y", pitch) @ turn("x", roll)
    np.testing.assert_allclose(X.rotation(), expected, atol=1e-12)


vectors = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: math.hypot(*v) > 1e-3)


@given(vectors, st.sampled_from([0.0, 1e-9, 1e-7, 1e-5, 0.1, 1.0, 3.0, math.pi - 1e-4, math.pi]))
def test_a_rotation_vector_is_axis_times_angle(axis, angle):
    axis = np.array(axis) / np.linalg.norm(axis)
    quat = (math.cos(angle / 2), *(math.sin(angle / 2) * axis))
    vector = rotation_vector(quat_to_matrix(quat))
    if angle == math.pi and vector @ axis < 0.0:  # the other way round is the same
        vector = -vector
    np.testing.assert_allclose(vector, angle * axis, atol=1e-9)


@given(st.lists(poses, max_size=4))
def test_many_rotation_vectors_are_those_of_each(many):
    rotations = np.array([*(X.rotation() for X in many), np.eye(3), np.diag([-1.0, 1.0, -1.0])])
    each = [rotation_vector(rotation) for rotation in rotations]
    np.testing.assert_allclose(rotation_vectors(rotations), each, atol=1e-6)


@given(poses)
def test_flat_keeps_place_and_heading_on_the_floor(X):
    flat = X.flat()
    assert flat.p == (X.p[0], X.p[1], 0.0)
    assert abs(wrap_angle(flat.yaw_rad - X.yaw_rad)) < 1e-9
    np.testing.assert_allclose(flat.rotation()[:, 2], [0.0, 0.0, 1.0], atol=1e-12)


@given(poses, st.floats(-0.6, 0.6), st.floats(0.0, 1.0))
def test_part_of_the_way_to_a_pose_is_part_of_its_turn_and_of_its_distance(X_AB, turn, share):
    X_AC = X_AB @ SE3.from_xy_yaw(0.3, -0.2, turn)
    X_BD = X_AB.inverse() @ X_AB.towards(X_AC, share)
    assert X_BD.p == pytest.approx((0.3 * share, -0.2 * share, 0.0), abs=1e-9)
    assert X_BD.yaw_rad == pytest.approx(share * turn, abs=2e-3)


@given(st.floats(-1000.0, 1000.0))
def test_wrapping_keeps_the_direction(angle):
    wrapped = wrap_angle(angle)
    assert -math.pi <= wrapped < math.pi
    assert math.isclose(math.cos(wrapped), math.cos(angle), abs_tol=1e-9)
    assert math.isclose(math.sin(wrapped), math.sin(angle), abs_tol=1e-9)
