"""What stands between the networks and the words: masks, crops, colours, names, votes."""

import math

import numpy as np
import pytest

from robot.messages import RgbdImage
from robot.perception.things import colours
from robot.perception.things.crops import SIDE_PX, crop
from robot.perception.things.eyes import SeenThing
from robot.perception.things.inputs import point_W, sight
from robot.perception.things.instances import REACH_PX, instances
from robot.perception.things.naming import Classes, Name, Sure, chances
from robot.perception.things.votes import LEAST_LOOKS, Votes
from robot.se3 import SE3

CLASSES = Classes(
    ("mug", "tea_cup", "apple", "", "nothing"), ("cups", "cups", "fruit", "", "nothing")
)
SURE = Sure(0.9, 0.8)


def answers(*middles: tuple[float, float], half_px: int = 5) -> np.ndarray:
    """What a perfect finder says of squares, later ones before earlier ones."""
    said = np.zeros((3, 60, 80), dtype=np.float32)
    said[0] = -9.0
    for u, v in middles:
        rows, columns = np.mgrid[
            int(v) - half_px : int(v) + half_px, int(u) - half_px : int(u) + half_px
        ]
        said[0, rows, columns] = 9.0
        said[1, rows, columns] = (u - columns) / REACH_PX
        said[2, rows, columns] = (v - rows) / REACH_PX
    return said


def test_two_things_that_touch_are_two():
    found = instances(answers((20, 30), (30, 30)), (120, 160))
    assert len(found) == 2
    middles = sorted(float(np.nonzero(one.pixels)[1].mean()) for one in found)
    assert middles == pytest.approx([39.5, 59.5], abs=1.0)
    assert not (found[0].pixels & found[1].pixels).any()


def test_where_nothing_is_nothing_is_found():
    assert instances(answers(), (120, 160)) == []


def picture(depth_m: np.ndarray, colour: tuple[int, int, int] = (40, 160, 60)) -> RgbdImage:
    height, width = depth_m.shape
    pixels = np.tile(np.array(colour, np.uint8), (height, width, 1))
    return RgbdImage(
        stamp_s=0.0, width=width, height=height, focal_px=(208.0, 208.0),
        centre_px=((width - 1) / 2, (height - 1) / 2), frame="head_camera",
        colours=pixels.tobytes(), depth_m=depth_m.astype(np.float32).tobytes(),
    )  # fmt: skip


AHEAD = SE3.from_rpy(-math.pi / 2, 0.0, -math.pi / 2, (0.0, 0.0, 1.2))
"""X_WC: looks along x, level."""


def test_a_point_of_a_pixel_is_where_its_ray_goes():
    seen = sight(picture(np.full((120, 160), 2.0)), AHEAD)
    assert seen is not None
    assert point_W(seen, 79.5, 59.5, 2.0) == pytest.approx([2.0, 0.0, 1.2])
    assert point_W(seen, 79.5 + 104.0, 59.5, 2.0) == pytest.approx([2.0, -1.0, 1.2])
    assert seen.height_m[59:61].mean() == pytest.approx(1.2, abs=1e-5)
    assert seen.height_m[0, 0] == pytest.approx(1.2 + 2.0 * 59.5 / 208.0, abs=1e-5)


def test_a_camera_without_depth_sees_no_places():
    image = RgbdImage(
        stamp_s=0.0, width=2, height=2, focal_px=(2.0, 2.0), centre_px=(0.5, 0.5),
        frame="head_camera", colours=bytes(12),
    )  # fmt: skip
    assert sight(image, AHEAD) is None


def block(near_m: float, far_m: float, box: tuple[int, int, int, int]) -> tuple:
    """A picture of a level block before a wall, and its pixels."""
    left, top, right, bottom = box
    depth = np.full((120, 160), far_m)
    pixels = np.zeros(depth.shape, dtype=np.bool_)
    pixels[top:bottom, left:right] = True
    depth[pixels] = near_m
    seen = sight(picture(depth), AHEAD)
    assert seen is not None
    return seen, pixels


def test_a_crop_is_as_wide_as_its_thing_and_knows_how_far_away_it_is():
    near, its = block(1.0, 2.0, (70, 50, 90, 70))
    far, other = block(2.0, 3.0, (75, 55, 85, 65))
    one, two = crop(near, its, 0.9), crop(far, other, 0.9)
    assert one is not None
    assert two is not None
    # as large, twice as far away: the window and the mask within it are the same
    assert one.numbers[0] == pytest.approx(two.numbers[0], abs=1e-6)
    assert one.planes[..., 3].mean() == pytest.approx(two.planes[..., 3].mean(), abs=0.06)
    assert one.p_W == pytest.approx([1.0, 0.0, 1.2], abs=0.01)
    assert two.p_W == pytest.approx([2.0, 0.0, 1.2], abs=0.01)
    assert one.planes[SIDE_PX // 2, SIDE_PX // 2, 4] == pytest.approx(0.0, abs=1e-5)
    assert one.planes[0, 0, 4] == 3.0  # the wall is further behind than is told
    assert pytest.approx(np.eye(3), abs=0.02) == one.R_WS


def test_a_crop_at_the_border_goes_on_without_depth():
    seen, pixels = block(1.0, 2.0, (0, 50, 20, 70))
    cut = crop(seen, pixels, 0.9)
    assert cut is not None
    assert not cut.planes[:, 0, 6].any()
    assert cut.planes[:, -1, 6].all()
    assert cut.numbers[-1] == 1.0


def test_what_has_no_depth_has_no_crop():
    seen, pixels = block(0.0, 2.0, (70, 50, 90, 70))
    assert crop(seen, pixels, 0.9) is None


@pytest.mark.parametrize(
    ("rgb", "word"),
    [
        ((204, 33, 28), "red"), ((237, 122, 31), "orange"), ((242, 199, 51), "yellow"),
        ((56, 148, 77), "green"), ((51, 120, 128), "teal"), ((33, 87, 191), "blue"),
        ((115, 66, 158), "purple"), ((235, 133, 158), "pink"), ((107, 69, 43), "brown"),
        ((237, 237, 235), "white"), ((120, 122, 125), "gray"), ((26, 26, 28), "black"),
    ],
)  # fmt: skip
def test_colours_have_words(rgb, word):
    pixels = np.tile(np.array(rgb, np.uint8), (4, 4, 1))
    assert colours.words(pixels, np.ones((4, 4), np.bool_)) == (word,)


def test_a_label_is_a_second_colour():
    pixels = np.tile(np.array((204, 33, 28), np.uint8), (10, 10, 1))
    pixels[:, 6:] = 240
    assert colours.words(pixels, np.ones((10, 10), np.bool_)) == ("red", "white")


def test_a_white_thing_in_warm_light_is_white_and_a_red_one_stays_red():
    room = np.random.default_rng(1).uniform(0.35, 0.95, (60, 80, 1)) * np.ones(3)
    room[20:40, 20:40], room[20:40, 50:70] = 0.85, (0.80, 0.13, 0.11)
    white, red = np.zeros((2, 60, 80), dtype=np.bool_)
    white[20:40, 20:40], red[20:40, 50:70] = True, True
    warm = (255.0 * np.clip(room * (1.10, 0.98, 0.78), 0.0, 1.0)).astype(np.uint8)
    assert colours.words(warm, white) != ("white",), "by its pixels alone"
    gain = colours.white_balance(warm)
    assert colours.words(warm, white, gain) == ("white",)
    assert colours.words(warm, red, gain) == ("red",)


def test_cream_is_warmer_than_white_and_a_label_says_nothing_of_that():
    every = np.ones((10, 10), np.bool_)

    def of(rgb) -> np.ndarray:
        return np.tile(np.array(rgb, np.uint8), (10, 10, 1))

    cream, white, steel = of((230, 222, 204)), of((237, 237, 235)), of((150, 155, 163))
    assert colours.warmth(cream, every) > 0.08
    assert abs(colours.warmth(white, every)) < 0.03
    assert colours.warmth(steel, every) < -0.03
    labelled = white.copy()
    labelled[:7] = (237, 122, 31)
    assert abs(colours.warmth(labelled, every)) < 0.03
    assert colours.warmth(of((237, 122, 31)), every) == 0.0, "nothing of it is plain"


def test_a_dark_picture_says_nothing_of_the_light():
    assert colours.white_balance(np.zeros((60, 80, 3), np.uint8)).tolist() == [1.0, 1.0, 1.0]


def test_a_name_is_as_narrow_as_is_certain():
    def name(*shares: float) -> Name:
        return CLASSES.name(np.array(shares), SURE)

    assert name(0.95, 0.02, 0.01, 0.01, 0.01) == Name("mug", "cups", 0.95)
    assert name(0.5, 0.4, 0.04, 0.05, 0.01)[:2] == ("", "cups")
    assert name(0.4, 0.1, 0.3, 0.1, 0.1)[:2] == ("", "")
    assert name(0.0, 0.0, 0.05, 0.95, 0.0)[:2] == ("", "")


def test_heat_makes_it_less_sure():
    odds = np.array([4.0, 0.0, 0.0], np.float32)
    assert chances(odds, 2.0)[0] < chances(odds, 1.0)[0]
    assert chances(odds, 2.0).sum() == pytest.approx(1.0)


def thing(p_W: tuple[float, float, float], shares: tuple[float, ...], sigma_m: float = 0.01):
    likely = np.array(shares)
    return SeenThing(
        CLASSES.name(likely, SURE), likely, ("red",), np.array(p_W), np.eye(3) * sigma_m**2,
        (0.08, 0.08, 0.1), 1.0, np.ones((1, 1), np.bool_), 1.0,
    )  # fmt: skip


LIKELY_MUG = (0.8, 0.1, 0.02, 0.05, 0.03)


def test_looks_that_agree_make_a_name_that_none_of_them_was_sure_of():
    votes = Votes()
    names = []
    for _ in range(8):
        (track,) = votes.add([thing((1.0, 0.0, 0.8), LIKELY_MUG)])
        names.append(track.name(CLASSES, SURE).kind)
    assert names[0] == ""
    assert names[-1] == "mug"
    assert len(votes.things) == 1


def test_one_sure_look_is_not_believed_yet():
    votes = Votes()
    for look in range(LEAST_LOOKS):
        (track,) = votes.add([thing((1.0, 0.0, 0.8), (0.99, 0.01, 0.0, 0.0, 0.0))])
        assert bool(track.name(CLASSES, SURE).kind) == (look + 1 >= LEAST_LOOKS)


def test_looks_that_disagree_make_no_name():
    votes = Votes()
    for look in range(6):
        shares = LIKELY_MUG if look % 2 else (0.02, 0.05, 0.8, 0.1, 0.03)
        (track,) = votes.add([thing((1.0, 0.0, 0.8), shares)])
    assert track.name(CLASSES, SURE)[:2] == ("", "")


def test_two_things_beside_each_other_stay_two_and_places_get_surer():
    votes = Votes()
    for look in range(5):
        off = 0.004 * (-1) ** look
        first, second = votes.add(
            [thing((1.0 + off, 0.0, 0.8), LIKELY_MUG), thing((1.0, 0.08, 0.8), LIKELY_MUG)]
        )
    assert len(votes.things) == 2
    assert first.p_W == pytest.approx([1.0, 0.0, 0.8], abs=0.002)
    assert second.p_W == pytest.approx([1.0, 0.08, 0.8], abs=1e-9)
    assert 0.0 < np.trace(first.covariance_W) < 3 * 0.01**2


def test_what_is_said_of_a_thing():
    assert thing((1.0, 0.0, 0.8), (0.95, 0.02, 0.01, 0.01, 0.01)).words == "red mug"
    assert thing((1.0, 0.0, 0.8), (0.5, 0.4, 0.04, 0.05, 0.01)).words == "red thing of the cups"
    assert thing((1.0, 0.0, 0.8), (0.1, 0.1, 0.1, 0.7, 0.0)).words == "unknown red thing, 10 cm"
