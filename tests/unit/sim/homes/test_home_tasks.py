"""Tasks of a home speak of what is there, are not done yet, and say what would be."""

import math
import re

import msgspec
import pytest

from robot.files import yaml_nodes
from sim import atlas
from sim.homes import catalogue
from sim.homes.tasks import COUNT, KINDS, tasks
from sim.homes.writing import tasks_yaml
from sim.placing import object_poses
from sim.simulation import Simulation
from tests.fakes.homes import SEEDS, asked

CHECKS = {
    "object", "on", "held", "near", "within_m", "with_person", "not_moved", "robot_in",
    "robot_near", "at", "visited", "passed", "passed_at", "said",
}  # fmt: skip


@pytest.fixture
def wishes(kind, homes):
    """Each home with each of its tasks."""
    return [(home, task) for seed, home in enumerate(homes) for task in asked(kind, seed)]


def item_of(home, name):
    return next(item for item in home.world.objects if item.id == name)


def holds(home, check):
    """Whether a check is fulfilled at the start; one of what happens on the way is not."""
    poses = object_poses(home.world)
    places = {person.id: person.at_m for person in home.world.people}
    start = home.world.start.at_m
    if "said" in check or "held" in check or "passed_at" in check:
        return False
    if "visited" in check:
        return check["visited"] == [atlas.room_at(home.world, start)]
    if "not_moved" in check:
        return True
    if "at" in check:
        return math.dist(check["at"], start) <= check["within_m"]
    if "robot_in" in check:
        return check["robot_in"] == atlas.room_at(home.world, start)
    if "robot_near" in check:
        return math.dist(places[check["robot_near"]], start) <= check["within_m"]
    at = poses[check["object"]].p[:2]
    if "on" in check:
        return item_of(home, check["object"]).on == check["on"]
    other = places[check["with_person"]] if "with_person" in check else poses[check["near"]].p[:2]
    return math.dist(at, other) <= check["within_m"]


def test_ten_tasks_a_home_always_the_same(homes):
    for seed, home in enumerate(homes[:3]):
        found = tasks(home, seed)
        assert len(found) == COUNT
        assert tasks(home, seed) == found


def test_every_kind_of_home_has_occasion_for_every_kind_of_task(wishes):
    assert {task.kind for _, task in wishes} == set(KINDS)


def test_checks_name_what_is_there(wishes):
    for home, task in wishes:
        places = {surface.place.id for surface in home.surfaces}
        known = {
            "object": {item.id for item in home.world.objects},
            "near": {item.id for item in home.world.objects},
            "not_moved": {item.id for item in home.world.objects},
            "on": places,
            "with_person": {person.id for person in home.world.people},
            "robot_near": {person.id for person in home.world.people},
            "robot_in": {room.id for room in home.world.rooms},
        }
        assert task.truth
        for check in task.truth:
            assert set(check) <= CHECKS
            assert all(check[key] in names for key, names in known.items() if key in check)
            assert set(check.get("visited", ())) <= known["robot_in"]
            if "said" in check:
                re.compile(check["said"])


def test_nothing_is_done_before_it_begins(wishes):
    for home, task in wishes:
        assert not all(holds(home, check) for check in task.truth), task


def test_counts_are_right(wishes):
    for home, task in wishes:
        if task.kind != "count":
            continue
        names = {
            name: place.id
            for place in atlas.places(home.world).values()
            for name in (place.name, *place.synonyms)
        }
        say = re.sub(r"(\w+) board of the ([\w ]+)", r"\1 \2", task.say)
        place = max((name for name in names if name in say), key=len)
        category = next(c for c, plural in home.world.categories.items() if plural in task.say)
        rooms = {surface.place.id: surface.room for surface in home.surfaces}
        there = [
            item
            for item in home.world.objects
            if item.category == category and names[place] in (item.on, rooms[item.on])
        ]
        assert re.search(task.truth[0]["said"], f"There are {len(there)} of them.")
        assert not re.search(task.truth[0]["said"], f"There are {len(there) + 1} of them.")


def test_all_are_all_there_are(wishes):
    for home, task in wishes:
        if task.kind == "all":
            wanted = {check["object"] for check in task.truth}
            category = item_of(home, task.truth[0]["object"]).category
            same = {item.id for item in home.world.objects if item.category == category}
            sources = {item_of(home, name).on for name in same - wanted}
            assert wanted <= same
            assert sources.isdisjoint(item_of(home, name).on for name in wanted)
            assert ("both" in task.say or "the two" in task.say) <= (len(wanted) == 2)


def test_what_is_described_by_what_is_beside_it_is_one_of_several(wishes):
    for home, task in wishes:
        if task.kind == "relative":
            item = item_of(home, task.truth[0]["object"])
            same = [one for one in home.world.objects if one.category == item.category]
            assert len(same) > 1
            assert sum(one.on == item.on for one in same) == 1
            assert (
                item.color
                not in task.say.split(" on ")[0].split()[: task.say.find(item.category)][:3]
            )


def test_conditions_are_sometimes_true_and_sometimes_not():
    every = [task for kind in catalogue.names() for seed in SEEDS for task in asked(kind, seed)]
    found = [task for task in every if task.kind == "conditional"]
    untrue = [task for task in found if "not_moved" in task.truth[0]]
    assert 0 < len(untrue) < len(found)
    assert all(re.search(r"otherwise|else|if not|is not", task.say) for task in untrue)


def test_there_is_room_for_what_is_brought(wishes):
    for home, task in wishes:
        surfaces = {surface.place.id: surface for surface in home.surfaces}
        for place in {check["on"] for check in task.truth if "on" in check}:
            brought = [
                item_of(home, check["object"])
                for check in task.truth
                if check.get("on") == place and item_of(home, check["object"]).on != place
            ]
            others = [item for item in home.world.objects if item.on == place]
            assert surfaces[place].free_spots(brought, others) == len(brought)


def test_a_person_needs_a_plausible_time(wishes):
    for _, task in wishes:
        assert 5 <= task.person_s <= 240
    longest = max((task for _, task in wishes), key=lambda task: task.person_s)
    assert longest.kind in ("all", "two", "search", "patrol", "conditional")


def test_the_same_is_asked_for_in_many_ways(wishes):
    says = [task.say for _, task in wishes]
    assert len({say.split()[0].casefold() for say in says}) > 12


@pytest.mark.parametrize("seed", [0, 5])
def test_the_file_holds_the_tasks(kind, homes, seed):
    text = Simulation().home(kind, seed=seed, file="over/there.yaml").tasks
    data = yaml_nodes.parse(text, "tasks").plain_data
    assert data["world"] == "over/there.yaml"
    found = tasks(homes[seed], seed)
    for entry, task in zip(data["tasks"], found, strict=True):
        assert entry.pop("expect") == []
        assert entry.pop("or_code", "") == task.or_code
        assert entry == {
            name: value for name, value in msgspec.to_builtins(task).items() if name != "or_code"
        }
    assert tasks_yaml(found, world="over/there.yaml", head=text[2:].split("\n", 1)[0]) == text
