"""Objects are where they were seen; gone only when their place was plainly seen to be empty."""

import math

import numpy as np
import pytest

from robot.fusion.world_model import FRAMES_TO_MISS, WorldModel
from robot.messages import DepthImage, ObjectInfo, Shape, Sighting, Sightings
from robot.se3 import SE3

WIDTH, HEIGHT, FOVY_RAD = 160, 120, math.radians(60)
CUP = ObjectInfo(
    id="cup", name="cup", category="cup", color="red", mass_kg=0.2,
    shape=Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1)),
)  # fmt: skip
# Camera at 1.2 m looking along +x of the world, level.
X_WC = SE3.from_rotation([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], (0.0, 0.0, 1.2))


def depth(
    metres: float = 3.0, *, patch: tuple[int, int, int, int] | None = None, near: float = 0.5
):
    """An image of a wall, with something `near` in columns and rows of the patch."""
    image = np.full((HEIGHT, WIDTH), metres, np.float32)
    if patch:
        left, right, top, bottom = patch
        image[top:bottom, left:right] = near
    return DepthImage(
        stamp_s=0.0, width=WIDTH, height=HEIGHT, fovy_rad=FOVY_RAD, depth_m=image.tobytes()
    )


def seen(stamp_s: float, p_C: tuple[float, float, float] | None) -> Sightings:
    objects = () if p_C is None else (Sighting(id="cup", X_CO=SE3(p_C)),)
    return Sightings(stamp_s=stamp_s, objects=objects)


@pytest.fixture
def model() -> WorldModel:
    model = WorldModel(camera_range_m=4.0)
    model.know((CUP,))
    return model


def cup(model: WorldModel):
    (track,) = model.tracks()
    return track


def test_a_known_object_is_nowhere_before_it_is_seen(model):
    assert cup(model).X_WO is None
    assert cup(model).seen_s == -math.inf
    for k in range(10):
        model.see(seen(k, None), X_WC, depth())
    assert not cup(model).missing


def test_a_sighting_places_it_in_the_world(model):
    model.see(seen(1.0, (0.1, 0.2, 1.5)), X_WC, None)
    assert cup(model).X_WO.p == pytest.approx((1.5, -0.1, 1.0))
    assert cup(model).seen_s == 1.0


def test_it_is_missing_after_three_clear_frames_and_not_before(model):
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, FRAMES_TO_MISS):
        model.see(seen(k, None), X_WC, depth())
        assert not cup(model).missing
    model.see(seen(FRAMES_TO_MISS, None), X_WC, depth())
    assert cup(model).missing
    assert cup(model).seen_s == 0.0
    assert cup(model).X_WO.p == pytest.approx((1.5, 0.0, 1.2))


def test_it_is_found_again(model):
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, 6):
        model.see(seen(k, None), X_WC, depth())
    model.see(seen(6.0, (0.2, 0.0, 1.5)), X_WC, depth())
    assert not cup(model).missing
    assert cup(model).X_WO.p[1] == pytest.approx(-0.2)
    model.see(seen(7.0, None), X_WC, depth())
    assert not cup(model).missing


NOT_CLEAR = {
    "hidden": (X_WC, depth(patch=(70, 90, 50, 70))),
    "half hidden": (X_WC, depth(patch=(80, 90, 50, 70))),
    "behind a wall": (X_WC, depth(1.0)),
    "out of range": (SE3((-3.0, 0.0, 0.0)) @ X_WC, depth(9.0)),
    "looking away": (X_WC @ SE3.from_rpy(0.0, math.pi, 0.0, (0, 0, 0)), depth()),
    "at the edge": (X_WC @ SE3.from_rpy(0.0, 0.62, 0.0, (0, 0, 0)), depth()),
    "too near": (SE3((1.4, 0.0, 0.0)) @ X_WC, depth()),
    "no depth": (X_WC, None),
}


@pytest.mark.parametrize("case", NOT_CLEAR.values(), ids=NOT_CLEAR.keys())
def test_it_is_not_missing_while_its_place_is_not_in_clear_view(model, case):
    X_WCamera, image = case
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, 20):
        model.see(seen(k, None), X_WCamera, image)
    assert not cup(model).missing


def test_nothing_hit_at_all_is_a_clear_view(model):
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, 4):
        model.see(seen(k, None), X_WC, depth(0.0))
    assert cup(model).missing


def test_objects_that_nobody_told_of_are_tracked_too(model):
    model.see(
        Sightings(stamp_s=0.0, objects=(Sighting(id="ball", X_CO=SE3((0.0, 0.0, 1.0))),)),
        X_WC,
        depth(),
    )
    assert [track.id for track in model.tracks()] == ["cup", "ball"]
