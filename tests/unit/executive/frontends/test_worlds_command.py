"""`humanoid worlds new`: a home on the screen or in files that were not there."""

import json
from pathlib import Path

import pytest

from executive.frontends.composition_root import REALITY
from executive.frontends.worlds import commands
from robot.errors import ConfigError
from robot.files import yaml_nodes


def test_a_home_is_printed(capsys):
    assert commands.new("flat", seed=7, output=None, tasks=None) == 0
    assert capsys.readouterr().out == REALITY.home("flat", seed=7, file="").world
    assert commands.new("flat", seed=7, output=Path("-"), tasks=None) == 0
    assert capsys.readouterr().out == REALITY.home("flat", seed=7, file="").world


def test_a_home_and_its_tasks_are_written_down(tmp_path):
    (tmp_path / "asked").mkdir()
    world, tasks = tmp_path / "home.yaml", tmp_path / "asked" / "tasks.yaml"
    commands.new("office", seed=3, output=world, tasks=tasks)
    assert REALITY.world(str(world)).map.name == "office_3"
    named = yaml_nodes.read(tasks).plain_data["world"]
    assert (tasks.parent / named).resolve() == world.resolve()


def test_a_home_is_as_large_as_is_wanted(tmp_path):
    path = tmp_path / "large.yaml"
    commands.new("clinic", seed=1, output=path, tasks=None, rooms=12, things=300)
    made = REALITY.world(str(path)).map
    assert len(made.objects) == 300
    assert sum(place.floor and place.id == place.room for place in made.places) == 12
    assert "--rooms 12 --things 300" in path.read_text().splitlines()[0]


def test_a_home_is_a_world_by_its_kind_and_seed():
    world = REALITY.world("clinic:2")
    assert (world.name, world.map.name) == ("clinic:2", "clinic_2")
    with pytest.raises(ConfigError, match="did you mean 'clinic'"):
        REALITY.world("klinic:2")


@pytest.mark.parametrize(
    ("world", "tasks", "wrong"),
    [
        (None, "tasks.yaml", "the tasks need the file of their world"),
        ("-", "tasks.yaml", "the tasks need the file of their world"),
        ("home.yaml", "./home.yaml", "world and tasks are two files"),
        ("there.yaml", None, "the file is there already"),
        ("home.yaml", "there.yaml", "the file is there already"),
        ("home.txt", None, "call it home.txt.yaml"),
        ("nowhere/home.yaml", None, "cannot be written"),
    ],
)
def test_what_cannot_be_written_is_refused_and_nothing_is(
    tmp_path, monkeypatch, world, tasks, wrong
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there.yaml").write_text("mine")
    with pytest.raises(ConfigError, match=wrong):
        commands.new("flat", seed=1, output=world and Path(world), tasks=tasks and Path(tasks))
    assert [path.name for path in tmp_path.iterdir()] == ["there.yaml"]
    assert (tmp_path / "there.yaml").read_text() == "mine"


def test_the_list_says_what_can_be_made(capsys):
    commands.list_all()
    said = capsys.readouterr().out
    assert "kitchen" in said
    assert all(kind in said for kind in REALITY.home_kinds())


def test_the_worlds_are_listed_for_programs_too(capsys):
    assert commands.list_all(as_json=True) == 0
    found = json.loads(capsys.readouterr().out)
    assert [world["name"] for world in found["worlds"]] == list(REALITY.names())
    kitchen = next(world for world in found["worlds"] if world["name"] == "kitchen")
    assert {"id": "red_cup", "name": "red cup"} in kitchen["objects"]
    assert {"id": "anna", "name": "anna"} in kitchen["people"]
    assert "table" in [place["id"] for place in kitchen["places"]]
    assert found["kinds"] == list(REALITY.home_kinds())


def test_the_things_are_listed_and_drawn(tmp_path, capsys):
    drawn = tmp_path / "things.png"
    assert commands.things(picture=drawn, variant=2, as_json=False) == 0
    said = capsys.readouterr().out
    assert "wine_bottle" in said
    assert "kind: mug" in said
    assert drawn.read_bytes().startswith(b"\x89PNG")


def test_the_things_are_listed_for_programs(capsys):
    assert commands.things(picture=None, variant=0, as_json=True) == 0
    found = json.loads(capsys.readouterr().out)["things"]
    assert {"name", "family", "size_m", "mass_kg", "colors", "source"} <= set(found[0])


def test_a_sheet_that_is_no_picture_is_refused(tmp_path):
    with pytest.raises(ConfigError, match="pictures are written as"):
        commands.things(picture=tmp_path / "things.txt", variant=0, as_json=False)
