"""Every home that is made is a right world, in which all can be reached."""

import itertools
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from robot.errors import ConfigError
from robot.planning.floor import Floor
from robot.planning.requests import Surroundings
from robot.planning.solids import solids_of
from robot.reality.contract import Reality
from sim import atlas, world
from sim.footprint import Footprint, overlapping
from sim.furniture import size_m
from sim.homes import catalogue
from sim.homes.furnishing import DEEPEST_M, HIGHEST_M, LOWEST_M
from sim.homes.ground import outlines
from sim.homes.home import PASSING_M, home
from sim.placing import nudged, object_poses, radius_m
from sim.simulation import Simulation
from sim.world_checks import check

HANDS_M = 0.085
HALF_BODY_M = 0.27


def read(text, tmp_path):
    path = tmp_path / "home.yaml"
    path.write_text(text, encoding="utf-8")
    return world.load(str(path))


def test_a_home_is_read_as_it_was_made(kind, homes, tmp_path):
    reality: Reality = Simulation()
    for seed, made in enumerate(homes[:3]):
        text = reality.home(kind, seed=seed, file="").world
        assert read(text, tmp_path) == made.world


def test_a_kind_and_a_seed_are_always_the_same_home(kind, homes):
    again = home(kind, 3)
    assert again.world == homes[3].world
    assert all(one.world != other.world for one, other in itertools.combinations(homes, 2))


def test_worlds_are_right(homes):
    for made in homes:
        assert check(made.world) == []


def test_homes_are_of_many_shapes(kind, homes):
    assert len({len(made.world.rooms) for made in homes}) > 1
    assert len({made.world.bounds_m for made in homes}) > len(homes) // 2
    assert all(2 <= len(made.world.rooms) <= 12 for made in homes)


def test_the_planner_too_finds_a_way_to_every_room_spot_and_person(homes):
    for made in homes[:2]:
        world_map = atlas.world_map(made.world)
        floor = Floor(solids_of(Surroundings(map=world_map, objects=())), world_map.bounds_m)
        labels = floor.regions(HALF_BODY_M)
        start = floor.home(labels, *made.world.start.at_m)
        assert start
        for spot in made.world.spots:
            assert floor.label_at(labels, np.array([spot.at_m])).tolist() == [start]
        for room in made.world.rooms:
            (x, y), (length, width) = room.at_m, room.size_m
            grid = np.mgrid[-0.5:0.5:20j, -0.5:0.5:20j].reshape(2, -1).T
            inside = floor.label_at(labels, np.array((x, y)) + grid * (length, width))
            assert (inside == start).any(), room.id
        for person in made.world.people:
            angles = np.linspace(-math.pi, math.pi, 24)
            circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
            near = floor.label_at(labels, np.array(person.at_m) + (PASSING_M + 0.15) * circle)
            assert (near == start).any()


def test_doors_are_as_wide_as_doors_and_lead_from_room_to_room(homes):
    for made in homes:
        for room, door in ((r, d) for r in made.world.rooms for d in r.doors):
            assert 0.80 <= door.width_m <= 1.0
            along = 0 if door.wall in ("north", "south") else 1
            sign = 1.0 if door.wall in ("north", "east") else -1.0
            for side in (-door.width_m / 2, 0.0, door.width_m / 2):
                point = list(room.at_m)
                point[along] += door.at_m + side
                point[1 - along] += sign * (room.size_m[1 - along] / 2 + atlas.WALL_M + 0.02)
                beyond = atlas.room_at(made.world, (point[0], point[1]))
                assert beyond not in ("", room.id)


def test_nothing_leads_out(homes):
    """Whoever walks on from any room without meeting a wall is in a room."""
    for made in homes:
        walls = outlines(world.World(name="", rooms=made.world.rooms))
        for room in made.world.rooms:
            for along, sign in itertools.product((0, 1), (-1.0, 1.0)):
                for share in np.linspace(-0.5, 0.5, 41).tolist():
                    point = list(room.at_m)
                    point[along] += share * room.size_m[along]
                    point[1 - along] += sign * (room.size_m[1 - along] / 2 + atlas.WALL_M / 2)
                    at = (point[0], point[1])
                    if not any(wall.distance_m(at) <= 1e-9 for wall in walls):
                        point[1 - along] += sign * atlas.WALL_M
                        assert atlas.room_at(made.world, (point[0], point[1])), room.id


def test_furniture_stands_apart_and_off_the_walls(homes):
    for made in homes:
        walls = outlines(world.World(name="", rooms=made.world.rooms))
        pieces = [atlas.footprint(item) for item in made.world.furniture]
        assert list(overlapping(pieces)) == []
        assert not [1 for piece in pieces for wall in walls if piece.overlaps(wall)]
        for item, piece in zip(made.world.furniture, pieces, strict=True):
            room = next(r for r in made.world.rooms if r.id == atlas.room_at(made.world, item.at_m))
            assert atlas.room_footprint(room).contains(piece)


def test_things_lie_where_hands_reach_them(homes):
    for made in homes:
        surfaces = {surface.place.id: surface for surface in made.surfaces}
        poses = object_poses(made.world)
        for item in made.world.objects:
            surface = surfaces[item.on]
            assert LOWEST_M <= surface.place.X_WP.p[2] <= HIGHEST_M
            assert size_m(surface.item)[0] <= DEEPEST_M
            assert min(item.size_m[:2]) <= HANDS_M
            assert item.size_m[2] < surface.place.clearance_m
            stand = surface.standing(item.at_m)
            assert stand is not None
            x, y, _ = poses[item.id].p
            assert math.dist(stand, (x, y)) <= 0.85
            assert atlas.room_at(made.world, stand) == surface.room


def test_things_are_apart_and_some_only_just(homes):
    gaps = []
    for made in homes:
        for one, other in itertools.combinations(made.world.objects, 2):
            if one.on == other.on:
                gaps.append(math.dist(one.at_m, other.at_m) - radius_m(one) - radius_m(other))
    assert min(gaps) >= 0.05 - 1e-9
    assert min(gaps) < 0.10


def test_names_are_nobody_elses(homes):
    for made in homes:
        names = [
            name.casefold()
            for group in ("rooms", "spots", "furniture", "objects", "people")
            for entry in getattr(made.world, group)
            for name in (entry.title, *entry.synonyms)
        ]
        assert len(names) == len(set(names))
        assert len({(o.color, o.category) for o in made.world.objects}) == len(made.world.objects)


def test_some_things_are_several_and_plurals_are_known(homes):
    plurals = {good.category: good.plural for good in catalogue.stock().goods}
    for made in homes:
        counts = [
            sum(item.category == category for item in made.world.objects)
            for category in made.world.categories
        ]
        assert max(counts) >= 2
        assert all(plurals[c] == plural for c, plural in made.world.categories.items())


def test_evaluations_may_move_everything_a_little(homes):
    """Nothing then stands in anything else, or over an edge."""
    for made in homes:
        places = atlas.places(made.world)
        for seed in range(3):
            moved = nudged(made.world, seed)
            for item in moved.objects:
                half = [side / 2 for side in places[item.on].size_m]
                assert all(abs(v) < h for v, h in zip(item.at_m, half, strict=True))
            for one, other in itertools.combinations(moved.objects, 2):
                if one.on == other.on:
                    gap_m = math.dist(one.at_m, other.at_m) - radius_m(one) - radius_m(other)
                    assert gap_m > 0.0


def test_people_stand_free(homes):
    for made in homes:
        assert made.world.people
        for person in made.world.people:
            body = Footprint(person.at_m, (0.25, 0.25))
            assert not [1 for outline in outlines(made.world) if outline.overlaps(body)]


def test_an_unknown_kind_names_the_nearest():
    with pytest.raises(ConfigError, match=r"unknown kind of home 'flet'.*did you mean 'flat'"):
        home("flet", 0)


def test_files_of_kinds_name_each_thing_once():
    goods = {good.category for good in catalogue.stock().goods}
    for name in catalogue.names():
        kind = catalogue.home_kind(name)
        assert set(kind.goods) <= goods
        rooms = {room.id for room in kind.rooms}
        assert all(set(usual) <= rooms for usual in kind.goods.values())
        ids = [piece.id for room in kind.rooms for piece in room.pieces]
        assert len(ids) == len(set(ids))
        for good in catalogue.stock().goods:
            assert min(good.size_m[:2]) <= HANDS_M
            assert good.mass_kg <= 1.0


def test_another_process_makes_the_same_bytes():
    code = (
        "import zlib; from sim.homes.made import made; "
        "home = made('office', 5, file='x.yaml'); print(zlib.crc32(''.join(home).encode()))"
    )
    said = [
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    ]
    assert said[0] == said[1]
