"""Files of strangers: refused whole and fast; mutated missions never break the checker."""

from __future__ import annotations

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from executive.missions.load import shipped
from executive.trees import parts as p
from robot.errors import ConfigError
from robot.files import yaml_nodes
from tests.fakes.checked_missions import mission, problems
from tests.fakes.machine import in_paces
from tests.fakes.missions import check, known_settings  # noqa: F401, a fixture

SECOND = 2500
"""In paces, as no test is to fail because the machine is slow or busy (tests/fakes/machine.py)."""


BOMB = "a: &a [x, x]\n" + "".join(
    f"{b}: &{b} [*{a}, *{a}, *{a}, *{a}]\n" for a, b in zip("abcdefgh", "bcdefghi", strict=True)
)


HOSTILE = {
    "nothing": "",
    "comment": "# nothing\n",
    "a bomb of aliases": BOMB,
    "a merge": "name: &x it\nsteps: [<<: *x]\n",
    "10,000 levels": "name: x\nsteps:\n- " + "{do: [" * 10_000,
    "10,000 lists": "[" * 10_000,
    "10,000 dashes": "- " * 10_000,
    "500,000 values": "name: x\nsteps: [" + "a," * 500_000 + "]",
    "a long key": "name: x\n" + "k" * 500_000 + ": 1\nsteps: [say: x]\n",
    "a long text": "name: x\nsteps:\n  - " + "walk " * 100_000,
    "objects": "name: !!python/object/apply:os.system [x]\nsteps: []\n",
    "control characters": "name: \x00\x01\n",
    "many mistakes": "name: x\nsteps:\n" + "  - jump: high\n" * 20_000,
    "10,000 sentences": "name: x\nsteps:\n"
    + "".join(f"  - go {n} metres forward\n" for n in range(10_000)),
    "rounds of rounds": "name: x\nsteps:\n- repeat: 1000\n  do:\n  - repeat: 1000\n"
    "    do:\n    - repeat: 1000\n      do: [say: x, say: y]\n",
    "each of each": "name: x\nsteps:\n" + "".join(
        f"{'    ' * n}- for_each: x{n}\n{'    ' * n}  in: [{', '.join(['table'] * 50)}]\n"
        f"{'    ' * n}  do:\n" for n in range(5)) + " " * 20 + "- say: x\n",
}  # fmt: skip


@pytest.mark.parametrize("name", [n for n in HOSTILE if n not in ("rounds of rounds",)])
def test_hostile_files_are_refused_whole_and_fast(name, write):
    path = write(HOSTILE[name])
    check(shipped()[0])  # what is built once a process is built
    found: list[str] = []
    assert in_paces(lambda: found.extend(problems(path)), tries=1, warm=True) < 3 * SECOND
    assert 1 <= len(found) <= 100
    assert all(len(text) < 600_000 for text in found)


def test_rounds_of_rounds_are_no_steps(write):
    assert check(write(HOSTILE["rounds of rounds"])).task  # built as they come, round by round


def test_a_file_of_100_mb_is_not_read(tmp_path):
    path = tmp_path / "big.yaml"
    with path.open("wb") as file:
        file.truncate(100_000_000)
    assert in_paces(lambda: problems(path), tries=1) < SECOND
    assert "larger than 2 MB" in problems(path)[0]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"\xff\xfen\x00a\x00", "no UTF-8"),
        (b"name: it\nabout: caf\xe9\nsteps: [say: x]\n", "2:11: this is no UTF-8"),
        (bytes(range(256)), "no UTF-8"),
        (b"name: \x07\n", "control character"),
    ],
)
def test_what_is_no_text_is_refused(data, words, tmp_path):
    path = tmp_path / "it.yaml"
    path.write_bytes(data)
    assert words in problems(path)[0]


def test_folders_pipes_and_devices_are_refused(tmp_path):
    for path in (tmp_path, "/dev/zero"):
        with pytest.raises(ConfigError, match="no ordinary file"):
            yaml_nodes.read_text(path)


def test_10_000_steps_are_checked_in_a_second(write):
    goals = ["{pick: red cup}", "{place: {object: it, on: table}}", "{say: hello}",
             "walk to the table", "{go_to: {place: counter}, retry: 1}"]  # fmt: skip
    path = write(mission("".join(f"  - {step}\n" for step in goals * 2000)))
    checked = []
    paces = in_paces(lambda: checked.append(check(path)), tries=2)
    assert len(list(p.errands(checked[-1].task))) == 10_000
    assert paces < 2 * SECOND  # 0.6 s on a quiet machine (docs/missions.md)


SAMPLES = [path.read_text() for path in shipped()]


PIECES = ["{", "}", "[", "]", ":", "- ", "\n", "  ", '"', "'", "{{x}}", "&a ", "*a", "!!int ", "\t",
          "steps:", "do:", "pick: ", "retry: -1", "null", "1e999", "#", "|", ">", "? ", "\x85", "é",
          "mission: bring", "for_each: x", "parallel:", "not:", "---\n", "%YAML 9\n"]  # fmt: skip


@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_mutated_missions_are_checked_or_refused_but_never_break(data, tmp_path):
    text = data.draw(st.sampled_from(SAMPLES))
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(text)))
        end = min(len(text), start + data.draw(st.sampled_from([0, 1, 3, 10, 40])))
        text = text[:start] + data.draw(st.sampled_from(PIECES)) + text[end:]
    path = tmp_path / "it.yaml"
    path.write_text(text, encoding="utf-8")
    try:
        check(path)
    except ConfigError as error:
        assert error.problems
        assert all(problem.message for problem in error.problems)


@settings(
    max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    data=st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
        lambda inner: (
            st.lists(inner, max_size=3)
            | st.dictionaries(
                st.sampled_from(["do", "pick", "if", "then", "retry", "say", "on_fail", "any", "x",
                                 "parallel", "repeat", "at_most", "while", "name", "object"]),
                inner, max_size=4,
            )
        ),
        max_leaves=12,
    )
)  # fmt: skip
def test_any_data_for_steps_is_checked_or_refused(data, tmp_path):
    path = tmp_path / "it.yaml"
    path.write_text(yaml.safe_dump({"name": "it", "steps": data}), encoding="utf-8")
    try:
        check(path)
    except ConfigError as error:
        assert error.problems
