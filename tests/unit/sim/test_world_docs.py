"""docs/worlds.md says what is true."""

import re
from pathlib import Path

from sim import atlas, world
from sim.furniture import KINDS
from sim.palette import COLORS, FLOORS

PAGE = Path(__file__).parents[3] / "docs" / "worlds.md"
TEXT = PAGE.read_text(encoding="utf-8")


def test_the_example_is_a_world(tmp_path):
    example = re.search(r"```yaml\n(.*?)```", TEXT, re.DOTALL)
    assert example
    path = tmp_path / "study.yaml"
    path.write_text(example[1], encoding="utf-8")
    loaded = world.load(str(path))
    words = {
        name for place in atlas.world_map(loaded).places for name in (place.name, *place.synonyms)
    }
    assert "lower shelf" in words
    assert "bookcase" in words


def test_every_kind_colour_and_floor_is_listed():
    for kind, known in KINDS.items():
        row = re.search(rf"\| {kind} \| (.*?) \|", TEXT)
        assert row, kind
        depth, width = (f"{value:.2f}" for value in known.size_m[:2])
        assert row[1].startswith(f"{depth}, {width}, ")
    colours = re.search(r"Colours: (.*?)\.\n", TEXT, re.DOTALL)
    assert colours
    listed = set(re.findall(r"\w+", colours[1]))
    assert listed == set(COLORS) - {"skin", "wall"}
    assert ", ".join(FLOORS) in TEXT
