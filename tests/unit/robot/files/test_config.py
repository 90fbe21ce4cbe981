"""YAML into frozen types: every mistake by file, line and nearest valid name; hostile files end."""

import msgspec
import pytest

from robot.errors import ConfigError
from robot.files import config, yaml_nodes


class Inner(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    height_m: float
    tags: tuple[str, ...] = ()


class Outer(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    name: str
    parts: dict[str, Inner] = {}
    rows: tuple[Inner, ...] = ()
    extra: Inner | None = None


@pytest.fixture
def load(tmp_path):
    def load(text, kind=Outer):
        path = tmp_path / "robot.yaml"
        path.write_text(text)
        return config.load(path, kind)

    return load


def problems(load, text):
    with pytest.raises(ConfigError) as caught:
        load(text)
    return caught.value.problems


def test_a_good_file_becomes_the_type(load):
    outer = load("name: a\nparts: {leg: {height_m: 1}}\nrows: [{height_m: 2.5, tags: [x, y]}]\n")
    assert outer == Outer("a", {"leg": Inner(1.0)}, (Inner(2.5, ("x", "y")),))


@pytest.mark.parametrize(
    ("text", "line", "key", "hint"),
    [
        ("nmae: a\n", 1, "nmae", "'name'"),
        ("name: a\nparts:\n  leg:\n    hieght_m: 1\n", 4, "hieght_m", "'height_m'"),
        ("name: a\nrows:\n  - height_m: 1\n  - heigth_m: 2\n", 4, "heigth_m", "'height_m'"),
        ("name: a\nextra:\n  height: 1\n", 3, "height", "'height_m'"),
        ("name: a\nzzzz: 1\n", 2, "zzzz", "valid: "),
    ],
)
def test_an_unknown_key_is_named_with_line_and_nearest(load, text, line, key, hint):
    (problem,) = problems(load, text)
    assert problem.line == line
    assert problem.file.endswith("robot.yaml")
    assert repr(key) in problem.message
    assert hint in problem.suggestion


def test_every_unknown_key_is_reported_at_once(load):
    found = problems(load, "nmae: a\nparts: {leg: {height: 1}}\nrows: [{tag: []}]\n")
    assert [problem.line for problem in found] == [1, 2, 3]


def test_a_wrong_type_is_named_with_its_line(load):
    (problem,) = problems(load, "name: a\nrows:\n  - height_m: 1\n  - height_m: tall\n")
    assert problem.line == 4
    assert "rows[1].height_m" in problem.message


def test_a_missing_key_is_named(load):
    (problem,) = problems(load, "parts: {}\n")
    assert "name" in problem.message


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "empty"),
        ("name: [a\n", "not valid YAML"),
        ("name: *x\n", "aliases"),
        ("name: &x a\nrows: *x\n", "anchors"),
        ("name: " + "[" * 60 + "]" * 60 + "\n", "deeper"),
        ("name: " + "[" * 5000 + "]" * 5000 + "\n", "deeper"),
        ("name: a\n" + "#" * (yaml_nodes.MAX_BYTES + 1), "larger"),
        ("name: a\nname: b\n", "twice"),
    ],
)
def test_hostile_files_end_in_one_sentence(load, text, words):
    (problem,) = problems(load, text)
    assert words in problem.message


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(ConfigError, match=r"nowhere\.yaml: there is no such file"):
        config.load(tmp_path / "nowhere.yaml", Outer)


def test_a_file_that_is_not_text_is_refused(tmp_path):
    path = tmp_path / "picture.yaml"
    path.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(ConfigError, match="no UTF-8 text"):
        config.load(path, Outer)


def test_nearest_falls_back_to_what_is_valid():
    assert config.nearest("kitchn", ["kitchen", "empty"]) == "did you mean 'kitchen'?"
    assert config.nearest("qqqqq", ["kitchen", "empty"]) == "valid: empty, kitchen"
    many = [f"room {number:02}" for number in range(20)]
    assert config.nearest("qqqqq", many).endswith("room 10, room 11 and 8 more")
