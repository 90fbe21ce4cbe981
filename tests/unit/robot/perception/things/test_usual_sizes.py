"""What looks as a kind does and is of another size is of no kind."""

from __future__ import annotations

import numpy as np
import pytest

from robot.perception.things import usual_sizes
from robot.perception.things.naming import Classes, Sure

NAMES, FAMILIES = ("bean_can", "mug", "", "nothing"), ("cans", "cups", "", "nothing")
CAN_M = (0.076, 0.076, 0.11)
LINE = usual_sizes.written({"bean_can": (CAN_M, (0.03, 0.03, 0.04))})
SIZES = usual_sizes.read(LINE, NAMES)
CLASSES = Classes(NAMES, FAMILIES, SIZES)
LOOKS = np.array([0.98, 0.01, 0.005, 0.005])
SURE = Sure(0.9, 0.95)


def times(factor: float) -> tuple[float, float, float]:
    return CAN_M[0] * factor, CAN_M[1] * factor, CAN_M[2] * factor


@pytest.mark.parametrize("factor", [0.97, 1.0, 1.03])
def test_a_size_that_such_things_have_takes_nothing_away(factor: float) -> None:
    weighed = SIZES.weighed(LOOKS, times(factor), NAMES.index(""))
    assert weighed == pytest.approx(LOOKS, abs=0.01)
    assert CLASSES.name(LOOKS, SURE, times(factor)).kind == "bean_can"


@pytest.mark.parametrize("factor", [0.8, 1.2, 2.0])
def test_a_tin_of_another_size_is_no_tin_of_beans_and_no_tin(factor: float) -> None:
    weighed = SIZES.weighed(LOOKS, times(factor), NAMES.index(""))
    assert weighed.sum() == pytest.approx(1.0)
    assert weighed[NAMES.index("")] > 0.5
    assert CLASSES.name(LOOKS, SURE, times(factor))[:2] == ("", "")
    assert CLASSES.name(LOOKS, SURE).kind == "bean_can"  # whose size is not known


def test_the_further_off_the_less() -> None:
    told = [SIZES.weighed(LOOKS, times(one), 2)[0] for one in np.linspace(1.0, 1.6, 7)]
    assert told == sorted(told, reverse=True)


def test_of_what_no_size_is_known_looks_decide() -> None:
    mug = LOOKS[[1, 0, 2, 3]]
    assert CLASSES.name(mug, SURE, times(3.0)).kind == "mug"
    assert SIZES.weighed(mug, times(3.0), 2)[1] == pytest.approx(0.98)
