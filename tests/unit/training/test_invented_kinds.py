"""Kinds that nobody has a name for: none of the catalogue, and none like one that is there."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from sim.things import catalogue
from sim.things.making import made, make
from training.things.invented import NUMBERS, invented, name
from training.things.likes import are_alike
from training.things.naming import CLASSES
from training.things.scenes import ODD, Scene
from training.things.splits import family

SOME = range(40)


def test_a_number_makes_the_same_kind_again() -> None:
    first = [invented(number) for number in SOME]
    invented.cache_clear()
    assert [invented(number) for number in SOME] == first
    assert len({repr(kind.of) for kind in first}) == len(first)


def test_none_is_like_a_kind_of_the_catalogue() -> None:
    for number in SOME:
        assert not any(are_alike(invented(number), kind) for kind in catalogue.kinds().values())


def test_every_kind_is_like_itself_and_a_can_is_not_like_a_plate() -> None:
    for kind in catalogue.kinds().values():
        assert are_alike(kind, kind)
    assert not are_alike(catalogue.kind("soup_can"), catalogue.kind("dinner_plate"))


@pytest.mark.parametrize("number", SOME)
def test_each_can_be_made(number: int) -> None:
    kind = invented(number)
    thing = make(kind, name(kind), number)
    assert all(0.0 < side_m < 0.5 for side_m in thing.size_m)
    assert all(np.isfinite(look.mesh.points).all() for look in thing.looks)


def test_no_split_has_a_kind_of_another() -> None:
    spans = sorted(NUMBERS.values())
    assert all(before[1] <= after[0] for before, after in itertools.pairwise(spans))


def test_in_a_scene_they_have_no_name_that_a_network_could_give() -> None:
    frame = next(one for k in range(6) if (one := Scene("judge", 5, ODD).frame(k)) is not None)
    kinds = [kind for kind in frame.truth.kinds if kind not in CLASSES and not family(kind)]
    assert len([kind for kind in kinds if kind.startswith("invented")]) == ODD.invented


def test_a_kind_of_the_catalogue_is_made_as_before() -> None:
    again, before = make(catalogue.kind("mug"), "mug", 3), made("mug", 3)
    assert (again.name, again.size_m, again.mass_kg) == (before.name, before.size_m, before.mass_kg)
    for one, other in zip(again.looks, before.looks, strict=True):
        assert np.array_equal(one.mesh.points, other.mesh.points)
