"""Worlds of any size end soon: counts are bounded, and what does not meet is not compared."""

import random

import pytest

from robot.errors import ConfigError
from robot.files.config import MOST_PROBLEMS
from sim import atlas, placing, world
from sim.footprint import Footprint, overlapping
from sim.world_schema import MOST_FURNITURE, MOST_ROOMS, Room

HALL = "name: w\nrooms:\n  - {id: hall, at_m: [0, 0], size_m: [100, 100]}\n"


def read(tmp_path, text):
    path = tmp_path / "w.yaml"
    path.write_text(text)
    return world.load(str(path))


@pytest.mark.parametrize(
    ("group", "entry"),
    [
        ("spots", "{{id: x{0}, at_m: [0, 0]}}"),
        ("furniture", "{{id: x{0}, kind: table, at_m: [0, 0]}}"),
        ("people", "{{id: x{0}, at_m: [0, 0]}}"),
    ],
)
def test_too_many_of_a_kind_are_refused_by_number(tmp_path, group, entry):
    lines = "".join(f"  - {entry.format(index)}\n" for index in range(1001))
    with pytest.raises(ConfigError, match=rf"w\.yaml:4:1: {group} has 1001 entries, at most \d+"):
        read(tmp_path, f"{HALL}{group}:\n{lines}")


def test_too_many_rooms_are_refused_by_number(tmp_path):
    line = "  - {{id: r{0}, at_m: [0, 0], size_m: [1, 1]}}\n"
    lines = "".join(line.format(index) for index in range(MOST_ROOMS + 1))
    with pytest.raises(ConfigError, match=f"rooms has {MOST_ROOMS + 1} entries"):
        read(tmp_path, f"name: w\nrooms:\n{lines}")


def test_a_heap_of_everything_gets_a_bounded_answer(tmp_path):
    line = "  - {{id: t{0}, kind: table, at_m: [0, 0]}}\n"
    lines = "".join(line.format(index) for index in range(MOST_FURNITURE))
    with pytest.raises(ConfigError) as caught:
        read(tmp_path, f"{HALL}furniture:\n{lines}")
    assert len(caught.value.problems) == MOST_PROBLEMS


def scattered(count, *, over_m):
    rng = random.Random(3)
    return [
        Footprint(
            (rng.uniform(0, over_m), rng.uniform(0, over_m)),
            (rng.uniform(0.1, 1.0), rng.uniform(0.1, 1.0)),
            rng.uniform(-3, 3),
        )
        for _ in range(count)
    ]


def test_the_pairs_are_those_of_comparing_all_with_all():
    footprints = scattered(60, over_m=10.0)
    every = [(i, j) for i in range(60) for j in range(i) if footprints[i].overlaps(footprints[j])]
    assert list(overlapping(footprints)) == every
    assert every
    assert list(overlapping([])) == []


def test_what_is_far_apart_is_not_compared(monkeypatch):
    compared = 0
    exact = Footprint.overlaps

    def counted(self, other):
        nonlocal compared
        compared += 1
        return exact(self, other)

    monkeypatch.setattr(Footprint, "overlaps", counted)
    for count in (100, 400):  # as dense
        compared = 0
        list(overlapping(scattered(count, over_m=2.0 * count**0.5)))
        assert compared < 2 * count


def test_walls_are_only_looked_at_where_they_may_be_near(monkeypatch):
    rooms = tuple(
        Room(id=f"r{k}", at_m=(5.0 * k, 0.0), size_m=(4.8, 4.8), walls=("north", "east"))
        for k in range(-9, 10)
    )
    big = world.World(name="w", rooms=rooms)
    looked = []
    walls = atlas.walls
    monkeypatch.setattr(atlas, "walls", lambda room: looked.append(room.id) or walls(room))
    assert placing.clear_of(big, (10.0, 0.0), 0.3) is None
    assert looked == []
    assert placing.clear_of(big, (10.0, 2.3), 0.3) == "the north wall of the r2"
    assert placing.clear_of(big, (12.4, 0.0), 0.3) == "the east wall of the r2"
    assert set(looked) <= {"r2", "r3"}


@pytest.mark.parametrize("group", ["furniture", "rooms", "objects", "people"])
def test_more_than_ten_mistaken_entries_are_told_like_any(tmp_path, group):
    path = tmp_path / "many.yaml"
    path.write_text(f"name: many\n{group}: [{', '.join(['0'] * 12)}]\n")
    with pytest.raises(ConfigError, match=group):
        world.load(path)
