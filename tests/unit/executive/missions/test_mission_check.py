"""Mission files: everything that is wrong is found at once, and hostile files are refused fast."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from executive.frontends.missions import commands
from executive.missions.check import Options
from executive.missions.load import FOLDER, load, shipped
from executive.missions.plan import forecast
from executive.missions.problems import Problems
from executive.missions.template import template
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.say import SayParams
from executive.skills.wait import WaitParams
from executive.trees import parts as p
from robot.errors import ConfigError
from robot.files import yaml_nodes
from tests.fakes.checked_missions import leaves, mission, problems
from tests.fakes.missions import check, known_settings  # noqa: F401, a fixture

# --- what is well -------------------------------------------------------------------------------


@pytest.mark.parametrize("path", shipped(), ids=lambda path: path.stem)
def test_shipped_missions_are_well_and_name_their_schema(path):
    assert check(path).task
    text = path.read_text()
    assert text.startswith("# yaml-language-server: $schema=mission.schema.json\n")
    schema = json.loads((FOLDER / "mission.schema.json").read_text())
    jsonschema.validate(yaml_nodes.parse(text, path.name).plain_data, schema)


def test_there_are_at_least_eight():
    assert len(shipped()) >= 8


def test_the_published_schema_is_current():
    cure = "run: humanoid mission schema -o missions/mission.schema.json"
    assert (FOLDER / "mission.schema.json").read_text() == commands.schema_text(), cure


def test_a_new_mission_is_well(write):
    assert check(write(template("my mission", file="it.yaml", schema="x"))).task


def test_a_text_is_one_line(write):
    checked = check(write('name: "hello\\nDone: all is well"\nsteps:\n- say: "a\\nb"\n'))
    assert checked.mission.record.name == "hello Done: all is well"


def test_parameters_are_filled_in_with_their_types(write):
    path = write(
        mission(
            """  - "pick up the {{thing}}"
  - wait: "{{span}}"
  - say: "{{words}} {{span}}"
  - repeat: "{{count}}"
    do: [{go_to: "{{where}}"}]
""",
            """parameters:
  thing: {type: object, default: red cup}
  span: {type: number, default: 1.5}
  words: {type: text, default: "a {{b}} c"}
  count: {type: integer, default: 2}
  where: {type: place, default: table}
""",
        )
    )
    pick, wait, say, walk = [leaf.params for leaf in p.errands(check(path).task)]
    assert pick == PickParams(object_id="red_cup")
    assert wait == WaitParams(duration_s=1.5)
    assert say == SayParams(text="a {{b}} c 1.5")  # a value is a value, not a text to fill in
    assert walk == NavigateParams(place_id="table")
    changed = check(path, Options(params={"thing": "blue cup", "count": "3"}))
    assert leaves(changed.task)[0].params == PickParams(object_id="blue_cup")


def test_a_parameter_cannot_turn_a_sentence_into_another(write):
    path = write(
        mission(
            '  - "pick up the {{thing}}"\n  - "go to the {{words}}"\n',
            "parameters:\n  thing: {type: object}\n  words: {type: text, default: table}\n",
        )
    )
    found = problems(path, params={"thing": "red cup and then go to the table"})
    assert any("no object 'red cup and then go to the table'" in text for text in found)
    assert any("only names and numbers may stand" in text for text in found)


def test_missions_call_missions_with_arguments(write):
    write(
        'name: inner\nparameters: {what: {type: object}}\nsteps: [{pick: "{{what}}"}]\n',
        "inner.yaml",
    )
    path = write(mission("  - {mission: inner, with: {what: blue cup}}\n"))
    assert leaves(check(path).task)[0].params == PickParams(object_id="blue_cup")


def test_steps_know_what_the_hands_hold_by_then(write):
    path = write(mission("  - pick: red cup\n  - place: {object: it, on: table}\n"))
    assert [type(leaf.params).__name__ for leaf in p.errands(check(path).task)] == [
        "PickParams",
        "PlaceParams",
    ]
    path = write(mission("  - repeat: 2\n    do: [pick: red cup, pick: blue cup, pick: bottle]\n"))
    assert problems(path) == [
        ":4:41: both hands are full by then, with the red cup and the blue cup "
        "(put something down first)"
    ]


def test_the_plan_names_every_step_and_a_time(write):
    checked = check(FOLDER / "patrol.yaml")
    plan = forecast(checked.task, checked.where)
    assert plan.total_s > 10.0
    assert plan.problems == 0
    assert [row.path for row in plan.rows if row.kind == "step"][:2] == ["1#1.1.1.1", "1#1.1.1.2"]


# --- what is wrong ------------------------------------------------------------------------------

WRONG = [
    ("  - pik: red cup\n", ":3:5: there is no step 'pik' (did you mean 'pick'?)"),
    ("  - pick: red cupp\n", "no object 'red cupp' in this world (did you mean 'red cup'?)"),
    ("  - go_to: {plcae: table}\n", ":3:13: unknown key 'plcae' (did you mean 'place'?)"),
    ("  - go_to: tabel\n", ":3:12: there is no place 'tabel' in this world (did you"),
    ("  - say: x\n    on_fail: {no_pth: [say: y]}\n", "failure code 'no_pth' (did you mean"),
    ("  - say: x\n    on_fail: {cancelled: [say: y]}\n", "no failure code 'cancelled'"),
    ('  - say: "{{wrods}}"\n', "there is no parameter 'wrods' here"),
    ("  - pick: the {cup}\n", ":3:11: '{cup}' has one brace where a parameter has two"),
    ('  - "pick up the {thng}"\n', ":3:5: '{thng}' has one brace where a parameter has two"),
    ('  - say: "hello { name }"\n', ":3:10: '{ name }' has one brace where a parameter has two"),
    ('  - for_each: cup\n    in: all cups\n    do: ["look at the {cup}"]\n',
     "where a parameter has two (a parameter is {{cup}})"),
    ('  - if: "the {cup} is on the table"\n    then: [say: x]\n', "'{cup}' has one brace"),
    ("  - {say: x, retry: many}\n", ":3:21: retry: 'many' where a whole number from 1 to"),
    ("  - {repeat: 0, do: [say: x]}\n", ":3:14: repeat: 0 where a whole number from 1 to 1000"),
    ("  - {repeat: many, do: [say: x]}\n", ":3:14: repeat: 'many' where a whole number from 1"),
    ("  - say: {{words}}\n", 'a parameter stands in quotes: "{{name}}"'),
    ("  - frobnicate the cup\n", "this sentence was not understood"),
    ("  - pick: cup\n", "'cup' is not clear (Which cup"),
    ("  - wait: long\n", ":3:11:"),
    ("  - wait: -1\n", "a number from 0 to 600"),
    ("  - balance: {mode: stand, duration_s: soon}\n", ":3:40:"),
    ("  - say: x\n    retry: 1000\n", "retry: 1000 where a whole number from 1 to 100"),
    ("  - say: x\n    timeout_s: 0\n", "timeout_s: 0 where a number above 0 and up to 86400"),
    ("  - {repeat: 2}\n", "the key 'do' is missing"),
    ("  - {say: x, pick: red cup}\n", "a step does one thing: 'pick'"),
    ("  - {}\n", "this step does nothing"),
    ("  - [say: x]\n", "a list where a step should be"),
    ("  - 7\n", "not understood"),
    ("  - mission: nowhere\n", "there is no such file"),
    ("  - mission: it\n", "this mission calls itself: it.yaml > it.yaml"),
    ("  - parallel: [go_to: table, pick: red cup]\n", "both need"),
    ("  - parallel: [go_to: table]\n", "at least 2"),
    ("  - if: {seen: red cup, holding: true}\n    then: [say: x]\n", "exactly one of"),
    ("  - if: pigs fly\n    then: [say: x]\n", "not understood"),
    ("  - while: {holding: true}\n    do: [say: x]\n", "the key 'at_most' is missing"),
    ("  - for_each: X\n    in: [red cup]\n    do: [say: x]\n", "'X' is no name"),
    ("  - for_each: x\n    in: [red cupp]\n    do: [say: x]\n", "did you mean 'red cup'"),
    ("  - go_to: {pose: {x_m: 99, y_m: 0}}\n", "outside this world"),
    ("  - go to (3, 1)\n", "(3, 1) is at the very edge of this world (x from -2.94 to 2.94 m"),
    ("  - walk forward 15 m\n", "15 m from here is outside this world (it is 6 by 5 m)"),
    ("  - go_to: {pose: {x_m: .inf, y_m: 0}}\n", ":3:25: x_m: '.inf' where a number should be"),
    ("  - go_to: {pose: {x_m: 1e300, y_m: 0}}\n", "x_m: 1e300 where a number of less"),
]  # fmt: skip


@pytest.mark.parametrize(("steps", "words"), WRONG, ids=[words for _, words in WRONG])
def test_a_mistake_is_named_with_its_place_and_cure(steps, words, write):
    found = problems(write(mission(steps)))
    assert any(words in text for text in found), found
    assert all(text.startswith(":") for text in found)  # line and column


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ("world: kitchn\n", ":2:8: unknown world"),
        ("limits: {duration_s: -1}\n", "duration_s: -1 where a number above 0"),
        ("limit: {duration_s: 1}\n", "did you mean 'limits'?"),
        ("parameters: {x: {type: objct}}\n", "did you mean 'object'?"),
        ("parameters: {x: {type: object, default: cupboard}}\n", ":2:41:"),
        ("parameters: {x: {type: integer, default: 1.5}}\n", "should be an integer"),
        ("parameters: {x: {type: place}}\n", "has no value"),
        ("expect: [the moon is on the table]\n", ":2:10:"),
        ("expect:\n  - the red cup is on the table and it is raining\n", "“it is raining”"),
        ("expect:\n  - the red cup is on the table and wave\n", ":3:5:"),
        ("expect:\n  - the red cup is on the table, wave\n", "is no condition"),
        ("faults: [{fault: psh}]\n", "did you mean 'push'?"),
        ("name: again\n", "stands here twice"),
    ],
)
def test_mistakes_around_the_steps(more, words, write):
    found = problems(write(mission("  - say: hello\n", more)))
    assert any(words in text for text in found), found


def test_all_mistakes_are_found_at_once(write):
    text = mission("".join(steps for steps, _ in WRONG if "{{words}}" not in steps))
    found = problems(write(text))
    assert len(found) >= len(WRONG) - 5
    assert found == sorted(found, key=lambda text: [int(n) for n in text.split(":")[1:3]])


def test_a_mistake_in_a_step_hides_no_other_one_in_it(write):
    found = problems(write(mission(
        "  - if: {robot_at: moon, seen: red cupp, on: sun}\n"
        "  - {pick: red cupp, retry: -1}\n"
        "  - place: {object: cap, on: tabel, in: bin}\n    retry: -1\n"
        "  - {pick: moon rock, retyr: 3, timeout_s: -3}\n"
        "  - bring: {object: unicorn, to: mars}\n"
        "  - {while: {seen: unicorn, on: mars}, at_most: 0, do: [fly to mars]}\n"
    )))  # fmt: skip
    wanted = [
        (3, "'then' is missing"), (3, "exactly one of seen"), (3, "'moon'"), (3, "'red cupp'"),
        (3, "'sun'"), (4, "'red cupp'"), (4, "retry: -1"), (5, "exactly one of on, in should"),
        (5, "'cap'"), (5, "'tabel'"), (5, "'bin'"), (6, "retry: -1"), (7, "'moon rock'"),
        (7, "'retyr'"), (7, "timeout_s: -3"), (8, "'unicorn'"), (8, "'mars'"), (9, "'unicorn'"),
        (9, "'mars'"), (9, "at_most: 0"), (9, "fly to mars"),
    ]  # fmt: skip
    for said, (line, words) in zip(found, wanted, strict=True):
        assert said.startswith(f":{line}:")
        assert words in said


EVERYWHERE = """limits: {duration_s: -4, speed_m_s: 99}
steps:
  - go_to: {pose: {x_m: 99999, y_m: 2, yaw_deg: 7200000}}
  - wait: 1e12
  - {repeat: 0, do: [wait: -3]}
  - pick: red cup
faults: [{at_s: 1, fault: meteor}]
expect: [{holding: true}, {holding: false}]
"""
"""What is wrong in it needs no world, but that the pose is outside of one."""


@pytest.mark.parametrize("world", ["kitchen", "kitchn", "zzzzzz", "broken.yaml"])
def test_neither_a_mistake_beside_it_nor_the_world_hides_a_mistake(world, write):
    write("objects: [", "broken.yaml")
    found = problems(write(f"name: it\nworld: {world}\n{EVERYWHERE}"))
    wanted = [":3:22: duration_s: -4", ":3:37: speed_m_s 99", ":5:49: yaw_deg: 7200000",
              ":6:11: wait: 1e12", ":7:14: repeat: 0", ":7:28: wait: -3", ":9:27: unknown fault",
              ":10:27: this and what is expected in line 10 are never both so"]  # fmt: skip
    wanted += [":5:5: (99999, 2) is outside"] if world.startswith("kit") else []
    wanted += [] if world == "kitchen" else ["broken.yaml:2:" if ".yaml" in world else ":2:8:"]
    for words in wanted:
        assert any(words in text for text in found), (words, found)
    assert len(found) == len(wanted), found


@pytest.mark.parametrize(
    ("one", "other", "both"),
    [
        ("holding: true", "holding: false", False),
        ("holding: red cup", "holding: false", False),
        ("holding: red cup", "not: {holding: red cup}", False),
        ("seen: red cup, on: table", "seen: red cup, on: shelf", False),
        ("seen: red cup, on: table", "all: [the red cup is on the shelf]", False),
        ("holding: red cup", "holding: blue cup", True),
        ("holding: red cup", "holding: true", True),
        ("seen: red cup, on: table", "seen: blue cup, on: shelf", True),
        ("all: [a cup is on the table]", "all: [a cup is on the shelf]", True),
        ("holding: true", "any: [{holding: false}, {robot_at: table}]", True),
    ],
)
def test_expectations_that_exclude_one_another_are_a_mistake(one, other, both, write):
    path = write(mission("  - wave\n", f"expect: [{{{one}}}, {{{other}}}]\n"))
    if both:
        check(path)
    else:
        (said,) = problems(path)
        assert "are never both so" in said


def test_steps_to_begin_at_are_named_once(write):
    path = write(mission("  - {nod: , retry: 2}\n".replace("nod: ", "say: x") * 2))
    (said,) = problems(path, first="9")
    assert "(valid: 1, 2)" in said


def test_words_that_are_misspelt_are_told(write):
    path = write(
        mission("  - go to the tabel\n  - if: the red cup is on the tabel\n    then: []\n")
    )
    notes = [str(note).removeprefix(str(path)) for note in check(path).notes]
    assert notes == [":3:5: I took “tabel” for “table”.", ":4:9: I took “tabel” for “table”."]
    assert check(write(mission("  - go to the table\n"))).notes == ()


def test_a_step_to_begin_at_has_to_be_there(write):
    path = write(mission("  - say: a\n  - repeat: 2\n    do: [say: b, say: c]\n"))
    assert check(path, Options(first="2#2.1")).done == {"1/", "2#1/", "2#2?"}
    assert problems(path, first="2#3.1") == [
        "--from: there is no step '2#3.1' in this mission (did you mean '2#1.1'?)"
    ]


def test_params_have_to_be_known_and_right(write):
    path = write(mission("  - say: a\n", "parameters: {x: {type: integer, default: 1}}\n"))
    assert "did you mean 'x'" in problems(path, params={"xx": "1"})[0]
    assert problems(path, params={"x": "many"})[0].startswith("--param x: the parameter 'x'")


# --- places, and what is wrong all at once --------------------------------------------------------


def test_robot_and_world_are_refused_where_each_is_named(write):
    path = write("name: a\nworld: kichen\nrobot: junno\nsteps: [stand]\n")
    found = problems(path)
    assert [text.split(": ")[0][-4:] for text in found] == [":2:8", ":3:8"]
    assert "did you mean 'kitchen'" in found[0]
    assert "did you mean 'juno'" in found[1]
    found = problems(path, world="kitchen", robot="jnuo")
    assert found == ["--robot: unknown robot 'jnuo' (did you mean 'juno'?)"]


def test_a_parameter_that_is_wrong_is_there_all_the_same(write):
    parameters = (
        "parameters:\n"
        "  a: {type: objct}\n"
        "  b: {type: object, default: red cpu}\n"
        "  c: {type: text}\n"
    )
    steps = '  - pick: "{{a}}"\n  - pick: "{{b}}"\n  - say: "{{c}} {{d}}"\n'
    found = problems(write(mission(steps, parameters)))
    assert len(found) == 4, found
    assert "'c' of 'it' has no value" in found[0]
    assert "did you mean 'object'" in found[1]
    assert "no object 'red cpu'" in found[2]
    assert "there is no parameter 'd' here" in found[3]


FAULTS = [
    (
        "{fault: shove, strength_n_s: strong}",
        "the fault 'shove': strength_n_s is 'strong', and must be a number",
    ),
    ("{fault: shove}", "strength_n_s is missing"),
    ("{fault: shove, strength_n_s: 1e308}", "1e+308, and must be from 0 to 1000 N s"),
    ("{fault: shove, strength_n_s: 1e999}", "is '1e999', and must be a number"),
    ("{fault: shove, strength_n_s: 5, duration_s: 0}", "is 0, and must be 0.01 s or more"),
    ("{fault: shove, strength_n_s: {uniform: [5, 5000]}}", "is 5000, and must be"),
    ("{fault: shove, strength_n_s: {uniform: [a, 2]}}", "uniform: [low, high]"),
    ("{fault: shove, strength_n_s: {choice: []}}", "choice: [one, or, another]"),
    ("{fault: push, impulse_n_s: [0, 4]}", "has 2 values, and must have 3"),
    ("{fault: kill, process: planner}", "cannot be 'planner' (valid: controller, perception)"),
    ("{fault: heat, motor: left_kne, temperature_c: 90}", "did you mean 'left_knee'"),
    ("{fault: discharge, charge: 80}", "is 80, and must be from 0 to 1"),
    ("{fault: silence, topic: camera, duration_s: -3}", "is -3, and must be 0.01 s or more"),
    ("{fault: slow_planner, requests: 1.5}", "is 1.5, and must be a whole number"),
    (
        "{fault: kill_executive, times: 100000000000}",
        "the trigger: times is 1e+11, and must be from 1 to 1000",
    ),
    ("{fault: kill_executive, at_s: -1}", "the trigger: at_s is -1, and must be from 0"),
    ("{fault: kill_executive, step: ''}", "the trigger: step is empty"),
    ("{fault: remove, target: table}", "unknown target 'table'"),
    ("{fault: move, target: red_cup, X_WO: 3}", "X_WO is 3, and must be a mapping"),
    ("{fault: move, target: red_cup}", "exactly one of X_WO, by_m"),
    ("remove", "a fault is a mapping"),
    ("{}", "the key 'fault' is missing"),
]


def test_everything_wrong_in_faults_is_said_at_its_line_in_our_words(write):
    text = "faults:\n" + "".join(f"  - {fault}\n" for fault, _ in FAULTS)
    found = problems(write(mission("  - stand\n", text)))
    assert len(found) == len(FAULTS)
    for line, (said, (_, words)) in enumerate(zip(found, FAULTS, strict=True), start=3):
        assert words in said
        assert f":{line}:" in said
        assert "Expected" not in said
        assert "$" not in said


def test_a_fault_at_a_step_that_the_mission_does_not_have_is_told(write):
    told = {"go to*": 0, "g? to the table": 0, "1": 0, "walk*": 1, "nonsense": 1}
    for pattern, times in told.items():
        more = f'faults:\n  - {{step: "{pattern}", fault: kill_executive}}\n'
        found = [
            note.message for note in check(write(mission("  - go to the table\n", more))).notes
        ]
        assert found == [f"no step of this mission is called {pattern!r}"] * times


def test_who_is_no_person_place_or_thing_of_a_list_is_looked_for_among_all_three(write):
    steps = """  - for_each: who
    in: [anna, bob, table, red cup]
    do:
      - look_at: "{{who}}"
"""
    (found,) = problems(write(mission(steps)))
    assert "no thing, place or person 'bob'" in found
    assert "anna" in found


@pytest.mark.parametrize(
    ("steps", "words"),
    [
        ("  - bring:\n    object: red cup\n    to: table\n", "indent it further: it belongs below 'bring'"),  # noqa: E501
        ("\t- say: hi\n", "indent with spaces, not with a tab"),
        ("  - balance: {mode: jump}\n", "valid: lean, one_leg, sit, squat, stand"),
        ("  - wait: 5 seconds\n", "wait: '5 seconds' where a number from 0 to 600"),
        ("  - go_to: {by: {}}\n", "neither how far nor how much to turn"),
        ("  - goto: table\n", "did you mean 'go_to'"),
    ],
)  # fmt: skip
def test_what_a_newcomer_gets_wrong_is_told_with_its_cure(steps, words, write):
    assert any(words in text for text in problems(write(mission(steps))))


def test_an_expectation_of_several_parts_is_only_met_by_all_of_them(write):
    text = "the red cup is on the table and the bottle is on the counter"
    path = write(mission("  - say: hello\n", f"expect:\n  - {text}\n"))
    (expect,) = (part for part in leaves(check(path, Options()).task) if isinstance(part, p.Expect))
    (finding,) = expect.findings
    assert [one.params.place_ids for look in finding.looks for one in p.errands(look)] == [
        ("table",),
        ("counter",),
    ]


def test_a_misspelt_world_or_a_wrong_item_hides_no_other_mistake(tmp_path):
    path = tmp_path / "m.yaml"
    path.write_text(
        """name: m
world: kitchenn
robot: jun
steps:
  - pick up the purple cup
  - go_to: {place: nowhere}
expect: ["the red cup is on the moon", {objct: x}]
faults: [{at_s: 1, fault: meteor}, {at_s: 1, fault: shove, strenth_n_s: 3}]
"""
    )
    with pytest.raises(ConfigError) as refused:
        check(path)
    lines = [problem.line for problem in refused.value.problems]
    assert lines == sorted(lines)
    assert set(lines) == {2, 3, 5, 6, 7, 8}
    assert lines.count(7) == lines.count(8) == 2


def test_a_world_that_resembles_none_is_told_with_what_needs_no_world(tmp_path):
    path = tmp_path / "m.yaml"
    path.write_text("name: m\nworld: zzzzzz\nbogus: 1\nsteps: [wave]\n")
    with pytest.raises(ConfigError) as refused:
        check(path)
    assert [problem.line for problem in refused.value.problems] == [2, 3]


@pytest.mark.parametrize(
    ("slots", "words"),
    [
        ("{mode: one_leg, side: middle}", "(valid: left, right)"),
        ("{mode: one_leg, side: forward}", "(valid: left, right)"),
        ("{mode: lean, side: middle}", "(valid: backward, forward, left, right)"),
        ("{mode: squat, side: left}", "side: 'left' means nothing here (leave it out)"),
    ],
)
def test_the_sides_are_those_of_the_posture(write, slots: str, words: str):
    (problem,) = problems(write(mission(f"  - balance: {slots}\n")))
    assert words in problem


def test_a_wrong_parameter_hides_no_wrong_name_beside_it(write):
    more = "parameters:\n  thing: {type: object, default: red cup}\n"
    steps = '  - bring: {object: "{{thng}}", to: "cuonter"}\n  - pick: {object: "{{thing}}"}\n'
    told = problems(write(mission(steps, more)))
    assert len(told) == 2
    assert "there is no parameter 'thng'" in told[0]
    assert "there is no place 'cuonter'" in told[1] and "counter" in told[1]


def test_what_is_no_name_is_not_answered_with_a_question(write):
    steps = "  - pick: {object: red cup}\nexpect:\n  - holding: maybe\n"
    (told,) = problems(write(mission(steps)))
    assert "there is no object 'maybe' in this world" in told and "?" not in told


def test_a_file_that_is_not_here_and_that_comes_along_is_named_as_that(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ConfigError) as refused:
        load(Path("hello.yaml"), Problems())
    assert "'hello'" in (refused.value.problems[0].suggestion or "")
    Path("hello.yaml").write_text("steps: []")
    load(Path("hello.yaml"), Problems())  # what is here is read
