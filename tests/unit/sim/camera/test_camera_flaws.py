"""What a real camera loses, and where: holes, noise, bad light, blur, pictures that do not come."""

import numpy as np
import pytest

from sim.camera.flaws import CameraFlaws, blurred, half_occluded
from sim.camera.scene_view import Pinhole, SceneView
from sim.realities import Camera, profile

PINHOLE = Pinhole(160, 120, 104.0)
SHAPE = (120, 160)
STILL = np.zeros(3)


def view(depth_m=1.0, light=0.6, facing=1.0, gloss=0.0) -> SceneView:
    def full(value):
        return np.broadcast_to(np.asarray(value, np.float32), SHAPE).copy()

    return SceneView(
        np.repeat(full(light)[..., None], 3, axis=2), full(depth_m), full(facing), full(gloss)
    )


def shot(reality: Camera, seen: SceneView, *, seed=1, stamp_s=0.0, turning_C=STILL):
    flaws = CameraFlaws(reality, PINHOLE, seed=seed)
    return flaws.shoot(seen, stamp_s=stamp_s, turning_C=turning_C)


def test_noise_grows_with_the_square_of_the_depth():
    reality = Camera(noise_per_m=0.004)
    spread = [shot(reality, view(depth_m=z)).depth_m.std() for z in (1.0, 2.0, 4.0)]
    assert spread == pytest.approx([0.004, 0.016, 0.064], rel=0.05)


@pytest.mark.parametrize(
    ("name", "bad", "good"),
    [("dark", {"light": 0.02}, {"light": 0.5}), ("shiny", {"gloss": 1.0}, {"gloss": 0.2}),
     ("grazing", {"facing": 0.02}, {"facing": 0.5})],
)  # fmt: skip
def test_depth_is_lost_where_little_light_comes_back(name, bad, good):
    reality = Camera(**{name: 0.6})
    assert (shot(reality, view(**bad)).depth_m == 0.0).mean() == pytest.approx(0.6, abs=0.05)
    assert (shot(reality, view(**good)).depth_m > 0.0).all()


def test_what_is_too_near_or_not_there_has_no_depth():
    assert (shot(Camera(least_m=0.3), view(depth_m=0.29)).depth_m == 0.0).all()
    assert (shot(Camera(), view(depth_m=np.inf)).depth_m == 0.0).all()


def test_edges_are_ragged_and_flat_things_are_not():
    depth_m = np.ones(SHAPE, np.float32)
    depth_m[:, 80:] = 2.0
    lost = shot(Camera(ragged=1.0), view(depth_m=depth_m)).depth_m == 0.0
    assert lost[:, 79:81].all()
    assert not lost[:, :78].any()
    assert not lost[:, 82:].any()


def test_the_shadow_of_what_is_near_lies_to_its_left_as_wide_as_the_disparities_differ():
    shift_px = np.full((4, 100), 5.0, np.float32)
    shift_px[:, 50:60] = 15.0
    hidden = half_occluded(shift_px)
    assert hidden[:, 41:50].all()
    assert not hidden[:, :41].any()
    assert not hidden[:, 50:].any()


def test_exposure_makes_up_for_bad_light_and_has_an_end():
    def dim(brightness: float, longest_ms: float = 33.0):
        reality = Camera(
            brightness=(brightness, brightness), exposure_ms=8.0, longest_exposure_ms=longest_ms,
            grain=0.01,
        )  # fmt: skip
        return shot(reality, view(light=0.5))

    good, dusk, night = dim(1.0), dim(0.3), dim(0.02)
    assert good.exposure_s == pytest.approx(0.008)
    assert dusk.exposure_s > 2 * good.exposure_s
    assert dusk.colours.mean() == pytest.approx(good.colours.mean(), rel=0.05)
    assert night.colours.mean() < 0.5 * good.colours.mean()
    assert night.colours.std() > good.colours.std()  # gain makes grain


def test_what_the_camera_turns_past_is_blurred_along_the_turn():
    light = np.zeros((*SHAPE, 3), np.float32)
    light[:, 80:] = 1.0
    to_the_side, up, still = (
        blurred(light, np.array(w), focal_px=104.0, exposure_s=0.03)
        for w in ((0.0, 2.0, 0.0), (2.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    )
    between = ((to_the_side > 0.05) & (to_the_side < 0.95)).any(axis=2)
    assert 4 <= between[60].sum() <= 10  # 104 px * 0.03 s * 2 rad/s = 6 px
    assert np.array_equal(still, light)
    assert np.allclose(up, light, atol=1e-5)


def test_a_cameras_cast_is_its_own_and_its_pictures_come_late_or_not_at_all():
    reality = Camera(colour_cast=0.1, drops=0.2, late_ms=(30.0, 60.0))
    gains = {tuple(CameraFlaws(reality, PINHOLE, seed=seed).gain.tolist()) for seed in range(5)}
    assert len(gains) == 5
    flaws = CameraFlaws(reality, PINHOLE, seed=0)
    stamps_s = [0.1 * k for k in range(500)]
    late = [flaws.late_s(stamp_s) for stamp_s in stamps_s]
    assert late.count(None) == pytest.approx(100, abs=30)
    assert all(0.03 <= late_s <= 0.06 for late_s in late if late_s is not None)
    assert late == [flaws.late_s(stamp_s) for stamp_s in stamps_s]


def test_the_worse_a_reality_the_worse_its_pictures():
    rng = np.random.default_rng(0)
    blocks = np.kron(rng.uniform(0.8, 3.0, (12, 16)), np.ones((10, 10)))
    seen = view(depth_m=blocks, light=0.3, facing=0.4)
    lost = [(shot(profile(name).camera, seen).depth_m == 0.0).mean() for name in ("real", "harsh")]
    assert 0.05 < lost[0] < lost[1] < 0.6
