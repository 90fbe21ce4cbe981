"""World files: what is right is read, every mistake is named by line with the nearest name."""

import math
from pathlib import Path

import pytest

from robot.errors import ConfigError
from sim import atlas, placing, world
from sim.footprint import Footprint
from sim.furniture import KINDS, form, size_m
from sim.world_schema import Furniture

GOOD = """\
name: test
rooms:
  - {id: study, at_m: [0, 0], size_m: [4, 4], walls: [north], floor: wood}
furniture:
  - id: desk
    kind: table
    at_m: [1.0, 0.0]
  - {id: rack, kind: shelf, at_m: [-1.8, 0], boards_m: [0.6, 0.9]}
objects:
  - id: mug
    category: cup
    color: red
    shape: cylinder
    size_m: [0.08, 0.08, 0.1]
    mass_kg: 0.3
    on: desk
    at_m: [0.0, 0.0]
  - {id: pen, category: pen, color: blue, shape: box, size_m: [0.02, 0.1, 0.02],
     mass_kg: 0.05, on: rack_lower}
people:
  - {id: bob, at_m: [0, 1.5]}
categories: {cup: cups, pen: pens}
start: {at_m: [-0.5, -1.0], yaw_deg: 90}
"""


@pytest.fixture
def read(tmp_path: Path):
    def read_text(text: str) -> world.World:
        path = tmp_path / "test.yaml"
        path.write_text(text, encoding="utf-8")
        return world.load(str(path))

    return read_text


def test_a_good_world_is_read(read):
    loaded = read(GOOD)
    assert loaded.bounds_m == (-2.0, -2.0, 2.0, 2.0)
    assert atlas.world_map(loaded).start_X_WS.yaw_rad == pytest.approx(math.pi / 2)


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("kind: table", "kind: tabel", 6, "unknown kind 'tabel' (did you mean 'table'?)"),
        ("kind: table", "kinds: table", 6, "unknown key 'kinds' (did you mean 'kind'?)"),
        ("on: desk", "on: desc", 16, "unknown place 'desc' (did you mean 'desk'?)"),
        ("color: red", "color: rad", 12, "unknown color 'rad' (did you mean 'red'?)"),
        ("shape: cylinder", "shape: cilinder", 13, "(did you mean 'cylinder'?)"),
        ("category: cup", "category: cop", 11, "unknown category 'cop' (did you mean 'cup'?)"),
        ("floor: wood", "floor: wod", 3, "unknown floor 'wod' (did you mean 'wood'?)"),
        (
            "[0.08, 0.08, 0.1]",
            "[0.08, -0.08, 0.1]",
            14,
            "size_m[1] is -0.08, and must be from 0.001 to 100 m",
        ),
        ("[0.08, 0.08, 0.1]", "[0.08, 0.09, 0.1]", 14, "not round"),
        ("[0.08, 0.08, 0.1]", "[0.08, 0.08]", 14, "size_m has 2 values, and must have 3"),
        ("mass_kg: 0.3", "mass_kg: 0", 15, "mass_kg is 0, and must be from 0.001 to 50 kg"),
        ("mass_kg: 0.3", "mass_kg: 1e999", 15, "and must be a number"),
        ("mass_kg: 0.3", "mass_kg: .nan", 15, "and must be a number"),
        ("mass_kg: 0.3", "mass_kg: heavy", 15, "and must be a number"),
        ("at_m: [0.0, 0.0]", "at_m: [0.0, 0.7]", 17, "does not fit there on the desk"),
        ("at_m: [1.0, 0.0]", "at_m: [1.9, 0.0]", 7, "desk reaches outside the rooms"),
        ("at_m: [1.0, 0.0]", "at_m: [-1.5, 0.0]", 8, "rack overlaps the desk"),
        ("id: mug", "id: desk", 10, "id 'desk' is taken (see furniture[0])"),
        ("id: mug", "id: My Mug", 10, "cannot be an id"),
        ("boards_m: [0.6, 0.9]", "boards_m: [0.9, 0.6]", 8, "from the lowest up"),
        ("at_m: [0, 1.5]", "at_m: [0, 2.5]", 21, "bob is outside every room"),
        ("at_m: [-0.5, -1.0]", "at_m: [1.0, 0.1]", 23, "the robot would start in the desk"),
        ("walls: [north]", "walls: [nort]", 3, "did you mean 'north'?"),
        ("walls: [north]", "walls: [north], doors: [{wall: east}]", 3, "has no east wall"),
    ],
)
def test_a_mistake_is_named_by_line_with_its_cure(read, old, new, line, message):
    assert GOOD.count(old) == 1
    with pytest.raises(ConfigError) as caught:
        read(GOOD.replace(old, new))
    assert f"test.yaml:{line}:" in str(caught.value)
    assert message in str(caught.value)


def test_a_cylinder_may_lie_and_a_box_may_not(read):
    lies = read(GOOD.replace("mass_kg: 0.3", "mass_kg: 0.3\n    lies: true\n    yaw_deg: 90"))
    X_WO = placing.object_poses(lies)["mug"]
    assert X_WO.rotation()[:, 2] == pytest.approx([0.0, 1.0, 0.0])
    assert X_WO.p[2] == pytest.approx(atlas.places(lies)["desk"].X_WP.p[2] + 0.04)
    with pytest.raises(ConfigError, match="pen is a box, and only cylinders lie"):
        read(GOOD.replace("mass_kg: 0.05", "mass_kg: 0.05, lies: true"))


def test_all_mistakes_are_named_at_once(read):
    text = GOOD.replace("kind: table", "kind: tabel").replace("color: red", "color: rad")
    with pytest.raises(ConfigError) as caught:
        read(text)
    assert [problem.line for problem in caught.value.problems] == [6, 12]


MISTAKES = """\
name: test
rooms:
  - {id: study, at_m: [0, 0], size_m: [6, 6], walls: [north], floor: wod}
  - {id: hall, at_m: [4, 0], size_m: [4, 4]}
furniture:
  - {id: desk, kind: table, at_m: [1.0, 0.0]}
  - {id: rack, kind: shelv, at_m: [-1.8, 0], boards_m: [0.6, 0.9]}
  - {id: desk, kind: table, at_m: [1.2, 0.0], mass_kg: heavy}
objects:
  - {id: Mug, category: cup, color: rad, shape: box, size_m: [0.1, 0.1, 0.1], mass_kg: -1, on: dsk}
  - {id: pen, category: pen, color: blue, shape: box, size_m: [0.02, 0.1], mass_kg: 1, on: rack_low}
  - {id: box, category: box, color: blue, shape: box, size_m: [0.1, 0.1, 0.1], mass_kg: 1, on: desk,
     at_m: [3, 0], weight: 3}
  - {id: tin, category: box, color: blue, shape: box, size_m: [0.1, 0.1, 0.1], mass_kg: 1, on: desk,
     at_m: [3, 0]}
people:
  - {id: bob, at_m: [0, 15], color: gren}
start: {at_m: [50, 0], yaw: 3}
"""


def test_mistakes_of_all_kinds_are_named_at_once_without_what_only_follows(read):
    with pytest.raises(ConfigError) as caught:
        read(MISTAKES)
    found = [(problem.line, problem.message) for problem in caught.value.problems]
    wanted = [
        (3, "unknown floor 'wod'"),
        (4, "hall overlaps study"),
        (7, "unknown kind 'shelv'"),
        (8, "id 'desk' is taken"),
        (8, "the desk overlaps the desk"),
        (8, "furniture[2].mass_kg is 'heavy'"),
        (10, "'Mug' cannot be an id"),
        (10, "unknown color 'rad'"),
        (10, "objects[0].mass_kg is -1"),
        (10, "Mug is on unknown place 'dsk'"),
        (11, "objects[1].size_m has 2 values"),
        (13, "unknown key 'weight'"),
        (15, "tin does not fit there on the desk"),
        (17, "bob is outside every room"),
        (17, "unknown color 'gren'"),
        (18, "unknown key 'yaw'"),
    ]
    for (line, message), (wanted_line, words) in zip(found, wanted, strict=True):
        assert line == wanted_line
        assert words in message


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("at_m: [1.0, 0.0]", "at_m: here"),
        ("kind: table", "kind: [1]"),
        ("boards_m: [0.6, 0.9]", "boards_m: high"),
        ("size_m: [4, 4]", "size_m: [4]"),
        ("walls: [north]", "walls: [nort], doors: [{wall: north}]"),
        ("start: {at_m: [-0.5, -1.0]", "start: {at_m: [9]"),
        ("id: desk", "id: 3"),
        ("id: desk", "ids: desk"),
        ("furniture:", "furnitures:"),
        ("name: test", "named: test"),
    ],
)
def test_one_mistake_is_one_problem_though_others_depend_on_it(read, old, new):
    assert GOOD.count(old) == 1
    with pytest.raises(ConfigError) as caught:
        read(GOOD.replace(old, new))
    assert len(caught.value.problems) == 1


def test_two_objects_in_one_spot_are_a_mistake(read):
    line = "  - {id: jug, category: cup, color: red, shape: box, size_m: [0.1, 0.1, 0.1],\n"
    text = GOOD.replace("people:", line + "     mass_kg: 1, on: desk, at_m: [0.05, 0]}\npeople:")
    with pytest.raises(ConfigError, match="jug overlaps mug"):
        read(text)


def test_an_unknown_world_names_the_nearest():
    with pytest.raises(ConfigError, match="did you mean 'kitchen'"):
        world.load("kichen")


@pytest.mark.parametrize("name", world.available())
def test_shipped_worlds_are_right(name):
    assert world.load(name).name == name


def test_boards_of_a_shelf_are_places_and_so_is_the_whole(kitchen):
    places = {place.name: place for place in atlas.world_map(kitchen).places}
    boards = [places[f"{level} shelf"] for level in ("lower", "middle", "upper")]
    heights = [board.X_WP.p[2] for board in boards]
    assert heights == sorted(heights)
    assert places["shelf"].X_WP == places["middle shelf"].X_WP
    assert {place.of for place in (*boards, places["shelf"])} == {"shelf"}
    assert boards[0].clearance_m == pytest.approx(heights[1] - heights[0] - 0.02)


@pytest.mark.parametrize(
    ("heights", "top", "bottom"),
    [("0.3, 0.6, 0.9, 1.2", "fourth", "first"), ("0.6, 0.9", "upper", "lower")],
)
def test_the_top_board_is_the_highest_however_many_there_are(tmp_path, heights, top, bottom):
    text = GOOD.replace("boards_m: [0.6, 0.9]", f"boards_m: [{heights}], synonyms: [bookcase]")
    path = tmp_path / "home.yaml"
    path.write_text(text.replace("rack_lower", f"rack_{bottom}"), encoding="utf-8")
    places = atlas.world_map(world.load(str(path))).places
    for words, level in (("upper", top), ("top", top), ("lower", bottom), ("bottom", bottom)):
        for noun in ("rack", "bookcase"):
            called = [p.id for p in places if f"{words} {noun}" in (p.name, *p.synonyms)]
            assert called == [f"rack_{level}"]


@pytest.mark.parametrize("kind", KINDS)
def test_furniture_stays_in_its_footprint_and_offers_its_top(kind):
    item = Furniture(id="x", kind=kind, at_m=(0.0, 0.0))
    size, shape = size_m(item), form(item)
    for part in shape.parts:
        for axis in (0, 1):
            slack = 0.02  # handles stand out a little
            assert abs(part.p[axis]) + part.size_m[axis] / 2 <= size[axis] / 2 + slack
        assert part.p[2] - part.size_m[2] / 2 >= -1e-9
        assert part.p[2] + part.size_m[2] / 2 <= size[2] + 1e-9
    assert shape.surfaces
    for surface in shape.surfaces:
        x, y, z = surface.p
        under = [
            part
            for part in shape.parts
            if abs(part.p[0] - x) < part.size_m[0] / 2
            and abs(part.p[1] - y) < part.size_m[1] / 2
            and abs(part.p[2] + part.size_m[2] / 2 - z) < 1e-9
        ]
        assert under, f"{surface.level or kind} hangs in the air"


def test_variations_are_valid_repeat_and_differ(kitchen):
    first = placing.variation(kitchen, 5)
    assert placing.variation(kitchen, 5) == first
    assert placing.variation(kitchen, 6) != first
    from sim.world_checks import check

    for seed in range(20):
        varied = placing.variation(kitchen, seed)
        assert check(varied) == []
        cups = [o.at_m for o in varied.objects if o.on == "table"]
        assert math.dist(*cups) > 0.16
        others = [o for o in varied.objects if o.on != "table"]
        assert others == [o for o in kitchen.objects if o.on != "table"]


def test_footprints_overlap_as_rectangles_do():
    a = Footprint((0.0, 0.0), (1.0, 0.5))
    assert a.overlaps(Footprint((1.4, 0.9), (0.5, 0.5)))
    assert not a.overlaps(Footprint((1.6, 0.9), (0.5, 0.5)))
    assert not a.overlaps(Footprint((1.5, 1.0), (0.5, 0.5), math.pi / 4))  # only their boxes do
    assert a.distance_m((1.3, 0.9)) == pytest.approx(0.5)
    assert a.distance_m((0.2, -0.1)) == 0.0


def test_a_misspelt_key_that_holds_no_list_hides_no_other_mistake(read):
    """With `strat: 1` neither the unknown place nor what overlaps was named."""
    text = GOOD.replace("on: desk", "on: dsk").replace("furniture:", (
        "  - {id: hall, at_m: [1, 0], size_m: [4, 4]}\nfurniture:"
    )) + "strat: 1\n"  # fmt: skip
    with pytest.raises(ConfigError) as error:
        read(text)
    told = [problem.message for problem in error.value.problems]
    assert [text for text in told if "unknown key 'strat'" in text]
    assert [text for text in told if "unknown place 'dsk'" in text]
    assert [text for text in told if "overlaps" in text]
