"""Whether a thing is round or has corners, from points of the side that is seen."""

import numpy as np
import pytest

from robot.perception.sight.form import roundness

EYE = np.array([-0.8, 0.0])


def side(thing: str, *, turn_rad: float = 0.0, noise_m: float = 0.001, seed: int = 1) -> np.ndarray:
    """Points of the near side of a cup of 8 cm, or of a box of 7 x 8 cm, shape (n, 3)."""
    rng = np.random.default_rng(seed)
    across = rng.uniform(-0.05, 0.05, 900)
    found = []
    for y in across.tolist():
        x = cup(y) if thing == "cup" else box(y, turn_rad)
        if x is not None:
            found.append((x + rng.normal(0.0, noise_m), y, rng.uniform(0.71, 0.80)))
    return np.array(found)


def cup(y: float) -> float | None:
    return None if abs(y) > 0.04 else -float(np.sqrt(0.04**2 - y**2))


def box(y: float, turn_rad: float) -> float | None:
    """Where a ray along x enters a rectangle that is turned, None if it passes."""
    c, s = np.cos(turn_rad), np.sin(turn_rad)
    enter, leave = -np.inf, np.inf
    for half, ahead, off in ((0.035, c, s * y), (0.04, -s, c * y)):
        if abs(ahead) < 1e-9:
            if abs(off) > half:
                return None
            continue
        low, high = sorted(((-half - off) / ahead, (half - off) / ahead))
        enter, leave = max(enter, low), min(leave, high)
    return float(enter) if enter < leave else None


@pytest.mark.parametrize("seed", range(5))
def test_a_cup_is_round(seed):
    assert roundness(side("cup", seed=seed), EYE, noise_m=0.001) > 1.0


@pytest.mark.parametrize("turn_deg", [0, 10, 30, 45, 60, 80])
def test_a_box_has_corners_however_it_is_turned(turn_deg):
    points = side("box", turn_rad=np.radians(turn_deg))
    assert roundness(points, EYE, noise_m=0.001) < -1.0


@pytest.mark.parametrize("thing", ["cup", "box"])
def test_from_so_far_away_that_noise_hides_it_nothing_is_said(thing):
    assert roundness(side(thing, noise_m=0.008), EYE, noise_m=0.008) == 0.0


def test_a_few_points_say_nothing():
    assert roundness(side("cup")[:30], EYE, noise_m=0.001) == 0.0
