"""What a mission looks at before it decides or begins a round."""

from __future__ import annotations

from executive.skills.inspect import InspectParams
from executive.trees import parts as p
from tests.fakes.checked_missions import mission, problems
from tests.fakes.missions import check, known_settings  # noqa: F401, a fixture


def looks(part: p.Part) -> list[tuple[str, tuple[str, ...]]]:
    """Path of every look that a task has, and what is looked for."""
    return [
        (path, node.params.object_ids)
        for path, node in p.walk(part)
        if isinstance(node, p.Errand) and isinstance(node.params, InspectParams)
    ]


def test_the_places_of_a_condition_are_looked_over_before_it_is_decided(write):
    condition = "{any: [{seen: red cup, on: table}, {not: {seen: box, on: table}}]}"
    text = mission(f"  - say: x\n  - if: {condition}\n    then: [say: y]\n")
    found = looks(check(write(text)).task)
    assert [path for path, _ in found] == ["2.look.1", "2.look.2"]
    assert found[0][1] != found[1][1]


def test_the_places_of_a_loop_are_looked_over_before_every_round(write):
    text = mission("  - while: {seen: red cup, on: table}\n    at_most: 3\n    do: [say: x]\n")
    assert [path for path, _ in looks(check(write(text)).task)] == ["1.1", "1.2#1.2"]


def test_hands_need_no_look(write):
    text = mission("  - if: {holding: red cup}\n    then: [say: x]\n")
    assert looks(check(write(text)).task) == []


def test_a_loop_that_is_wrong_keeps_its_name(write):
    steps = "  - for_each: cup\n    inn: all cups\n    do: [{pick: '{{cup}}'}, {say: '{{cop}}'}]\n"
    found = problems(write(mission(steps)))
    assert not any("parameter 'cup'" in text for text in found)
    assert any("parameter 'cop'" in text for text in found)
