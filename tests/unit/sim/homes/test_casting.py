"""What plays the roles of a campaign in a home is there, within reach, and has room."""

import math

import numpy as np
import pytest

from robot.planning import numerics
from sim import atlas
from sim.homes import lanes
from sim.homes.casting import THINGS, cast
from sim.homes.home import home
from sim.placing import object_poses
from tests.fakes.homes import made, played

ROLES = {
    *THINGS, "to", "other", "another", "spot", "spot_too", "goal", "walk", "long_walk", "at_goal",
    "chair", "wide_goal", "wide_walk", "at_wide_goal", "room", "before_door", "doorway", "in_room",
    "person",
}  # fmt: skip


@pytest.fixture
def casts(kind):
    return [(made(kind, seed), played(kind, seed)) for seed in range(3)]


def test_every_role_is_played_or_said_to_be_vacant(casts):
    for _, found in casts:
        assert set(found.roles) | set(found.vacant) == ROLES
        assert not set(found.roles) & set(found.vacant)
        assert all(found.vacant.values())


def test_most_roles_find_somebody(casts):
    """Not all: a clinic and a workshop have no chair that can be pushed."""
    filled = [len(found.roles) / len(ROLES) for _, found in casts]
    assert sum(filled) / len(filled) > 0.75


def test_the_same_seed_casts_the_same(casts):
    for seed, (there, found) in enumerate(casts[:1]):
        assert cast(there, seed) == found


def test_what_is_moved_stays_on_its_surface_and_apart(casts):
    for there, found in casts:
        roles = found.roles
        items = {item.id: item for item in there.world.objects}
        thing = items[roles["thing"]]
        surface = next(s for s in there.surfaces if s.place.id == thing.on)
        others = [o for o in items.values() if o.on == thing.on and o is not thing]
        x, y, _ = object_poses(there.world)[thing.id].p
        for role in ("off_m", "aside_m"):
            if role in roles:
                dx, dy, _ = roles[role]
                X_PO = surface.place.X_WP.inverse().apply((x + dx, y + dy, 0.0))
                at = (float(X_PO[0]), float(X_PO[1]))
                assert surface.takes(thing, at, others, gap_m=0.045), (there.world.name, role)


def test_what_takes_the_place_is_from_elsewhere(casts):
    for there, found in casts:
        roles = found.roles
        on = {item.id: item.on for item in there.world.objects}
        if "other" in roles:
            assert len({roles["thing"], roles["other"], roles["another"]}) == 3
            assert roles["to"] not in (on[roles["other"]], on[roles["another"]])
        if "to" in roles:
            assert roles["to"] != on[roles["thing"]]


def test_starts_are_free_and_ways_straight(casts):
    for there, found in casts:
        ground = there.ground
        for start, goal, (low, high) in (
            ("walk", "at_goal", lanes.WALK_M),
            ("long_walk", "at_goal", lanes.LONG_WALK_M),
            ("wide_walk", "at_wide_goal", lanes.LONG_WALK_M),
        ):
            if start in found.roles:
                x, y, yaw_deg = found.roles[start]
                to = found.roles[goal]["at"]
                assert low - 0.02 <= math.dist((x, y), to) <= high + 0.02
                assert ground.home[ground.cell((x, y))]
                heading = math.degrees(math.atan2(to[1] - y, to[0] - x))
                assert heading == pytest.approx(yaw_deg, abs=0.1)


def test_somebody_in_the_doorway_shuts_the_room_off(casts):
    for there, found in casts:
        if "room" not in found.roles:
            continue
        x, y, _ = found.roles["before_door"]
        assert atlas.room_at(there.world, (x, y)) != found.roles["room"]
        ground = there.ground
        cells = np.argwhere(ground.home)
        far_m = np.hypot(*(ground.points(cells) - np.array(found.roles["doorway"])).T)
        free = ground.home.copy()
        free[tuple(cells[far_m < lanes.IN_DOOR_M].T)] = False
        labels = numerics.regions(free)
        index = [room.id for room in there.world.rooms].index(found.roles["room"])
        inside = labels[ground.home & (ground.room == index)]
        assert labels[ground.cell((x, y))] not in inside


def test_a_home_where_nothing_fits_says_so(monkeypatch):
    monkeypatch.setattr(lanes, "WALK_M", (90.0, 91.0))
    monkeypatch.setattr(lanes, "LONG_WALK_M", (90.0, 91.0))
    found = cast(home("flat", 0), 0)
    assert "goal" not in found.roles
    assert found.vacant["walk"] == "no straight way leads to a spot"
