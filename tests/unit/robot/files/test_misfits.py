"""What does not fit a type is told all at once, by name, with range, unit and cure."""

from typing import Annotated, Literal

import msgspec
import pytest

from robot.errors import ConfigError
from robot.files import config, quantities, yaml_nodes
from robot.files.misfits import misfits, nearest
from robot.model.description import RobotDescription
from robot.reality import faults
from sim.world_schema import World


class Leaf(msgspec.Struct, forbid_unknown_fields=True):
    torque_nm: quantities.Torque
    count: quantities.Quota = 1
    side: Literal["left", "right"] = "left"
    sign: Literal[1, -1] = 1
    sizes_m: tuple[quantities.Size, quantities.Size] | None = None
    several: quantities.Several[float] = ()
    on: bool = False
    name: Annotated[str, msgspec.Meta(max_length=9)] = ""


class Tree(msgspec.Struct, forbid_unknown_fields=True):
    leaves: dict[str, Leaf]


@pytest.mark.parametrize(
    ("leaf", "message"),
    [
        ({"torque_nm": 1e12}, "leaves.a.torque_nm is 1e+12, and must be from 0.01 to 2000 N m"),
        ({"torque_nm": float("nan")}, "leaves.a.torque_nm is not a finite number"),
        ({"torque_nm": "much"}, "leaves.a.torque_nm is 'much', and must be a number"),
        ({"torque_nm": True}, "leaves.a.torque_nm is True, and must be a number"),
        ({"torque_nm": None}, "leaves.a.torque_nm is nothing, and must be a number"),
        ({"torque_nm": [1]}, "leaves.a.torque_nm is a list, and must be a number"),
        ({"count": 1}, "leaves.a.torque_nm is missing"),
        ({"torque_nm": 1, "name": "x" * 10}, "leaves.a.name has 10 letters, at most 9 are taken"),
        ({"torque_nm": 1, "count": 2.5}, "leaves.a.count is 2.5, and must be a whole number"),
        ({"torque_nm": 1, "count": 0}, "leaves.a.count is 0, and must be from 1 to 10000"),
        ({"torque_nm": 1, "side": "lefd"}, "leaves.a.side cannot be 'lefd'"),
        ({"torque_nm": 1, "sign": True}, "leaves.a.sign cannot be True"),
        ({"torque_nm": 1, "sign": 1.0}, "leaves.a.sign cannot be 1.0"),
        ({"torque_nm": 1, "sign": [1]}, "leaves.a.sign cannot be a list"),
        ({"torque_nm": 1, "sizes_m": [1, -1]}, "leaves.a.sizes_m[1] is -1, and must be from 0.001"),
        ({"torque_nm": 1, "sizes_m": 3}, "leaves.a.sizes_m is 3, and must be a list"),
        ({"torque_nm": 1, "several": [1.0] * 33}, "leaves.a.several has 33 entries, at most 32"),
        ({"torque_nm": 1, "on": "yes"}, "leaves.a.on is 'yes', and must be true or false"),
        ({"torque_nm": 1, "name": 3}, "leaves.a.name is 3, and must be a text"),
        ({"torque_nm": 10**400}, "leaves.a.torque_nm is not a finite number"),
        ([], "leaves.a is a list, and must be a mapping"),
    ],
)
def test_a_misfit_is_told_in_the_words_of_the_file(leaf, message):
    (found,) = misfits({"leaves": {"a": leaf}}, Tree)
    assert found.message.startswith(message)


def test_all_misfits_are_found():
    data = {"leaves": {"a": {"torque_nm": -1}, "b": {"torque_nm": 1, "count": 0}, "c": {}}}
    assert [found.path for found in misfits(data, Tree)] == [
        ("leaves", "a", "torque_nm"), ("leaves", "b", "count"), ("leaves", "c"),
    ]  # fmt: skip


def test_what_fits_is_no_misfit():
    data = {"leaves": {"a": {"torque_nm": 3, "sizes_m": None, "several": [1, 2.5]}}}
    assert not list(misfits(data, Tree))


def test_a_misspelt_key_is_not_told_as_missing_too():
    (found,) = misfits({"leaves": {"a": {"torque": 3}}}, Tree)
    assert found.message == "unknown key 'torque'"
    assert found.cure == "did you mean 'torque_nm'?"


def test_a_file_that_is_all_wrong_gets_a_bounded_answer():
    text = "leaves:\n" + "".join(f"  k{index}: {'x' * 9000}\n" for index in range(200))
    with pytest.raises(ConfigError) as caught:
        config.convert(yaml_nodes.parse(text, "f.yaml"), Tree)
    assert len(caught.value.problems) == config.MOST_PROBLEMS + 1
    assert len(str(caught.value)) < 10_000
    assert [problem.line for problem in caught.value.problems[:2]] == [2, 3]


def numbers_of(kind, path=()):
    """Every number that a type holds, with its constraints."""
    match kind:
        case msgspec.inspect.StructType():
            for field in kind.fields:
                yield from numbers_of(field.type, (*path, field.name))
        case msgspec.inspect.DictType():
            yield from numbers_of(kind.value_type, path)
        case msgspec.inspect.VarTupleType() | msgspec.inspect.ListType():
            yield from numbers_of(kind.item_type, path)
        case msgspec.inspect.TupleType():
            for item in kind.item_types:
                yield from numbers_of(item, path)
        case msgspec.inspect.UnionType():
            for member in kind.types:
                yield from numbers_of(member, path)
        case msgspec.inspect.Metadata():
            yield from numbers_of(kind.type, path)
        case msgspec.inspect.FloatType() | msgspec.inspect.IntType():
            yield ".".join(path), kind


@pytest.mark.parametrize("kind", [RobotDescription, World])
def test_every_number_of_a_strangers_file_has_a_range(kind):
    without = [
        name
        for name, number in numbers_of(msgspec.inspect.type_info(kind))
        if number.ge is None or number.le is None
    ]
    assert without == []


@pytest.mark.parametrize("kind", faults.KINDS.values(), ids=faults.KINDS)
def test_every_number_of_a_fault_has_a_range_or_may_last_for_ever(kind):
    found = dict(numbers_of(msgspec.inspect.type_info(kind)))
    for name, number in found.items():
        if not name.startswith("X_WO"):
            assert number.ge is not None, name
            assert number.le is not None or name == "duration_s"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a: " + "x" * 10_001, "a text of 10001 characters"),
        ("'" + "x" * 10_001 + "'", "a text of 10001 characters"),
        ('a: "' + "x" * 1_000_000 + '"', "a text of 1000000 characters"),
    ],
)
def test_what_nobody_can_mean_is_refused_by_the_reader(text, words):
    with pytest.raises(ConfigError, match=words) as caught:
        yaml_nodes.parse(text, "f.yaml")
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize("opening", ["[", "{", "? ", "- ", "[? ", "[a: ", "[[]: ", '["a" '])
def test_nesting_is_refused_after_a_bounded_number_of_events(opening, monkeypatch):
    seen = 0

    def counted(text):
        nonlocal seen
        for event in events(text):
            seen += 1
            yield event

    events = yaml_nodes._events
    monkeypatch.setattr(yaml_nodes, "_events", counted)
    with pytest.raises(ConfigError):
        yaml_nodes.parse(opening * 100_000, "f.yaml")
    assert seen < 5 * yaml_nodes.MAX_DEPTH


def test_what_a_file_of_another_kind_holds_is_not_repeated(tmp_path):
    path = tmp_path / "shadow"
    path.write_text("root:secret:0\n")
    with pytest.raises(ConfigError) as caught:
        config.load(path, Tree)
    (problem,) = caught.value.problems
    assert problem.message == "the whole is a text, and must be a mapping of keys to values"


def test_a_quantity_without_its_unit_is_asked_for_with_every_one_that_it_may_have():
    """For `yaw: 90` only `yaw_rad` was named."""
    assert nearest("yaw", ["x_m", "yaw_deg", "yaw_rad"]) == "did you mean 'yaw_deg' or 'yaw_rad'?"
    assert nearest("turn", ["turn_rad", "x_m"]) == "did you mean 'turn_rad'?"
