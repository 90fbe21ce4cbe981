"""From when on a name is believed that several looks agree on; and what a thing may be called."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

pytest.importorskip("jax", reason="the extra `train` is not installed")

from robot.perception.things.naming import Classes, Name, Sure
from training.things import judging
from training.things.walking import Walk, sure_voted, told

SURE = Sure(0.97, 0.99)
CLASSES = Classes(("mug", "bowl", "", "nothing"), ("cups", "bowls", "", "nothing"))


def walk(kind: str, named: str, score: float) -> Walk:
    """A thing with what it was taken for where that is sure enough."""

    def name(_: Classes, sure: Sure) -> Name:
        return Name(named if score >= sure.kind else "", "", score)

    return Walk(kind, cast(Any, SimpleNamespace(name=name)), 0.003)


def test_nothing_wrong_needs_no_more_than_one_look_does() -> None:
    some = [walk("mug", "mug", 0.98), walk("vase", "mug", 0.90), Walk("mug", None, 0.0)]
    assert sure_voted(some, CLASSES, SURE, most_wrong=0.0) == SURE.kind


@pytest.mark.parametrize("kind", ["bowl", "", "vase", "invented vessel"])
def test_what_is_wrong_is_not_named_from_there_on(kind: str) -> None:
    some = [walk("mug", "mug", 0.999), walk(kind, "mug", 0.99), walk("mug", "mug", 0.98)]
    least = sure_voted(some, CLASSES, SURE, most_wrong=0.0)
    assert 0.99 < least <= 0.999
    assert "right 0.333" in told(some[:1] + some[2:] * 2, CLASSES, SURE._replace(kind=least))
    assert sure_voted(some, CLASSES, SURE, most_wrong=0.5) == SURE.kind


def test_what_should_get_no_name_is_told_by_its_sort() -> None:
    sorts = [judging.sort(kind) for kind in ("mug", "", "vase", "invented vessel")]
    assert sorts == [judging.KNOWN, *judging.UNKNOWN]
    line = told([walk("vase", "mug", 0.99), walk("vase", "mug", 0.5)], CLASSES, SURE)
    assert "kinds never learnt 1 of 2" in line
