"""Files of other programs: included ones, Nav2's nodes and frames, all that is wrong at once."""

from __future__ import annotations

import pytest

from executive.missions import nav2
from executive.missions.btcpp import importing, leaves, nodes
from executive.missions.btcpp.xml import parse
from robot.errors import ConfigError
from robot.files import yaml_nodes
from robot.files.yaml_nodes import read_text


def tree(inside: str, head: str = "") -> str:
    return f'<root BTCPP_format="4">{head}\n<BehaviorTree ID="A"><Sequence>\n{inside}\n</Sequence></BehaviorTree></root>'  # noqa: E501


def steps_of(inside: str) -> list[object]:
    return importing.mission_data(parse(tree(inside), "tree.xml"))["steps"]


@pytest.fixture
def problems(tmp_path):
    """What is wrong in a file, without its name."""

    def _problems(text: str, name: str = "tree.xml") -> list[str]:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        make = importing.mission_of if name.endswith(".xml") else nav2.mission_of
        with pytest.raises(ConfigError) as error:
            make(path)
        return [str(problem).replace(f"{tmp_path}/", "") for problem in error.value.problems]

    return _problems


# --- all at once --------------------------------------------------------------------------------

WRONG = [
    ('<Check condition="json:{bad"/>', "the condition is no JSON: {bad"),
    (f'<Check condition="json:{"[" * 3000}"/>', "deeper than 50 levels"),
    (f'<Wait duration_s="{"9" * 5001}"/>', "no number that can be meant"),
    ('<Wait duration_s="1e999"/>', "no number that can be meant"),
    ('<Wait duration_s=""/>', "a port of Wait is empty"),
    ('<Say text="{gone}"/>', "{gone} has no value"),
    ('<Say text="a" _skipIf="b"/>', "_skipIf"),
    ('<Sayy text="a"/>', "did you mean 'Say'"),
    ('<SubTree ID="B"/>', "there is no tree 'B'"),
    ('<NavigateToPose goal="{goal}"/>', "{goal} has no value"),
    ('<NavigateToPose goal="0;odom;1;2;0;0;0;0;1"/>', "in the frame 'odom'"),
    ('<NavigateToPose goal="1;2;3"/>', "stamp;map;x;y;z;qx;qy;qz;qw"),
    ('<NavigateToPose goal="0;map;nan;2;0;0;0;0;1"/>', "0;map;nan"),
    ('<NavigateToPose goal="0;map;1;2;0;0;0;0;0"/>', "length 1"),
    ('<NavigateToPose goal="0;map;1;2;0;1;0;0;0"/>', "leans"),
    ('<ComputePathToPose goal="{goal}"/>', "use NavigateToPose with a pose"),
    ('<RecoveryNode number_of_retries="-1"><Say text="a"/><Say text="b"/></RecoveryNode>',
     "number_of_retries='-1'"),
    ('<Wait wait_duration="abc"/>', "Wait: wait_duration: 'abc' where a number"),
    ('<Wait wait_duration="-1"/>', "wait_duration: -1 where a number from 0"),
    ('<Wait wait_duration="1" duration_s="2"/>', "say the same"),
    ('<Sleep/>', "the port 'msec' is missing"),
    ('<Spin spin_dist="nan"/>', "spin_dist: 'nan' where a number"),
    ('<BackUp backup_dist="far"/>', "backup_dist: 'far' where a number"),
    ('<BackUp backup_dist="90"/>', "backup_dist: -90 where a number"),
    ('<GoTo target="table" place="shelf"/>', "'target' and 'place' of 'GoTo' say the same"),
    ('<Pick/>', "Pick: the port 'object' is missing"),
    ('<Balance mode="handstand"/>', "mode: 'handstand'"),
    ('<Delay delay_msec="9000000"><Say text="a"/></Delay>', "wait: 9000"),
    ('<NavigateThroughPoses goals="0;map;1;2;0;0;0;0;1;0;map;1e10;2;0;0;0;0;1"/>',
     "x_m: 10000000000"),
    ('<Timeout msec="5s"><Say text="a"/></Timeout>', "msec is '5s', and must be"),
    ('<Timeout><Say text="a"/></Timeout>', "Timeout: msec is missing"),
    ('<Repeat num_cycles="-1"><Say text="a"/></Repeat>', "nothing here is without an end"),
    ('<Timeout msec="99999999"><Say text="a"/></Timeout>', "timeout_s: 99"),
    ('<RetryUntilSuccessful num_attempts="102"><Say text="a"/></RetryUntilSuccessful>',
     "at most 101"),
    ('<Repeat num_cycles="1001"><Say text="a"/></Repeat>', "at most 1000"),
    ('<Check condition="json:{&quot;holdin&quot;: true}"/>', "did you mean 'holding'"),
    ('<Sequence><Expect condition="holding"/><Say text="a"/></Sequence>', "use Check"),
]  # fmt: skip


def test_everything_wrong_in_a_tree_is_said_at_once_in_order(problems):
    found = problems(tree("\n".join(node for node, _ in WRONG)))
    assert len(found) == len(WRONG)
    for line, (said, (_, words)) in enumerate(zip(found, WRONG, strict=True), start=3):
        assert said.startswith(f"tree.xml:{line}: ")
        assert words in said
        assert len(said) < 250


def test_what_is_inside_a_node_that_is_refused_is_looked_at_once(problems):
    deep = "<RateController>" * 60 + '<Say txt="a"/>' + "</RateController>" * 60
    found = problems(tree(deep))
    assert len(found) == 2
    assert "RateController has no equivalent: the robot plans again by itself" in found[0]
    assert "did you mean 'text'" in found[1]


def test_a_mission_that_could_not_be_read_again_is_not_written(problems):
    inside = "<Sequence>" * 90 + '<Say text="a"/>' + "</Sequence>" * 90
    assert "nested deeper than 60 levels" in problems(tree(inside))[0]
    inside = '<RecoveryNode number_of_retries="9">' * 20 + '<Say text="a"/>'
    inside += '<Say text="b"/></RecoveryNode>' * 20
    assert "at most 5" in problems(tree(inside))[0]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<a>\n<b>\n</c></a>", "f:3:3: not valid XML: another tag is closed than <b> of line 2"),
        ("<a>\n<b>\n", "f:2: not valid XML: <b> is never closed"),
        ('<a>\n<b c="1/>\n<d/></a>', "f:2:1: not valid XML: a quote in this tag is never closed"),
        ("<a>&</a>", "& is &amp;"),
        ('<a b="1" b="2"/>', "an attribute stands twice"),
        ("<a/><b/>", "behind the end of <root>"),
        ("", "there is nothing in it"),
    ],
)
def test_what_is_no_xml_is_told_where_it_begins(text, words):
    with pytest.raises(ConfigError) as error:
        parse(text, "f")
    assert words in str(error.value)


# --- included files -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("include", "words"),
    [
        ('<include path="otehr.xml"/>', "tree.xml:1: the file 'otehr.xml', included here, is not there (did you mean 'other.xml'?)"),  # noqa: E501
        ('<include path="/etc/passwd"/>', "tree.xml:1: '/etc/passwd' lies outside the folder"),
        ('<include path="../other.xml"/>', "lies outside the folder"),
        ('<include ros_pkg="nav2" path="other.xml"/>', "only a file beside this one"),
        ("<include/>", "only a file beside this one"),
        ('<include path="broken.xml"/>', "broken.xml:1:"),
        ('<inclde path="other.xml"/>', "did you mean 'include'"),
    ],
)  # fmt: skip
def test_what_cannot_be_included_is_an_error_at_its_line(include, words, problems, tmp_path):
    (tmp_path / "other.xml").write_text('<root BTCPP_format="4"/>')
    (tmp_path / "broken.xml").write_text("<root>")
    found = problems(tree('<Say text="a"/>', include))
    assert len(found) == 1
    assert words in found[0]


def test_trees_of_included_files_are_called_and_files_may_include_one_another(tmp_path):
    (tmp_path / "b.xml").write_text(
        '<root BTCPP_format="4"><include path="a.xml"/>'
        '<BehaviorTree ID="B"><Say text="{words}"/></BehaviorTree></root>'
    )
    path = tmp_path / "a.xml"
    path.write_text(tree('<SubTree ID="B" words="hello"/>', '<include path="b.xml"/>'))
    made = yaml_nodes.parse(importing.mission_of(path), "a.yaml").plain_data
    assert made["steps"] == [{"do": [{"say": "hello"}]}]


# --- several trees ------------------------------------------------------------------------------

SEVERAL = """<root BTCPP_format="4"{main}>
<BehaviorTree ID="A"><Say text="a"/></BehaviorTree>
<BehaviorTree ID="B"><SubTree ID="C"/></BehaviorTree>
<BehaviorTree ID="C">{inside}</BehaviorTree></root>"""


def several(inside: str = '<Say text="c"/>', *, main: str = "") -> str:
    name = f' main_tree_to_execute="{main}"' if main else ""
    return SEVERAL.format(main=name, inside=inside)


def test_of_several_trees_the_file_says_which_is_the_main_one(problems):
    (said,) = problems(several())
    assert "tree.xml:1: there are 3 trees" in said
    assert "main_tree_to_execute" in said


def test_trees_that_nothing_calls_are_named_and_looked_at(problems, tmp_path):
    path = tmp_path / "tree.xml"
    path.write_text(several(main="B"))
    text = importing.mission_of(path)
    assert "# left out: line 2, the tree 'A', which nothing calls\n" in text
    assert "'C'" not in text.partition("name:")[0]
    inside = "<Sequence><RateController><Say text='{x}'/></RateController></Sequence>"
    path.write_text(several(inside, main="A"))
    assert "'C', which nothing calls; in it, without equivalent: RateController" in (
        importing.mission_of(path)
    )
    for inside, words in (
        ("<Sequence><Sayy text='a'/></Sequence>", "did you mean 'Say'"),
        ("<Sequnce><Say text='a'/></Sequnce>", "did you mean 'Sequence'"),
        ("<SubTree ID='D'/>", "there is no tree 'D'"),
    ):
        (said,) = problems(several(inside, main="A"))
        assert said.startswith("tree.xml:4: ")
        assert words in said


# --- what does nothing --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "inside",
    [
        '<Repeat num_cycles="2"><AlwaysSuccess/></Repeat>',
        '<RetryUntilSuccessful num_attempts="2"><AlwaysSuccess name="a"/></RetryUntilSuccessful>',
        '<Timeout msec="500"><AlwaysSuccess/></Timeout>',
        '<ForceSuccess><Sequence name="a"><AlwaysSuccess/></Sequence></ForceSuccess>',
        '<Fallback><AlwaysSuccess/><Say text="b"/></Fallback>',
        '<RecoveryNode><AlwaysSuccess/><Say text="b"/></RecoveryNode>',
        "<Parallel><AlwaysSuccess/><AlwaysSuccess/></Parallel>",
    ],
)
def test_what_does_nothing_leaves_nothing_behind(inside):
    assert steps_of(f'{inside}<Say text="a"/>') == [{"say": "a"}]


def tried(step, working):
    """What a step says until it is done, where only some can be said; and whether it is done."""
    if "say" in step:
        return [step["say"]], step["say"] in working
    said = []
    for one in step["do"]:
        more, done = tried(one, working)
        said += more
        if not done:
            break
    else:
        return said, True
    if "on_fail" not in step:
        return said, False
    more, done = tried({"do": step["on_fail"]["any"]}, working)
    return said + more, done


@pytest.mark.parametrize("count", [1, 2, 3, 21, 200])
def test_a_fallback_of_any_length_tries_one_after_the_other(count):
    names = [f"t{number}" for number in range(count)]
    children = "".join(f'<Say text="{name}"/>' for name in names)
    (step,) = steps_of(f"<Fallback>{children}</Fallback>")
    for at in {0, count // 2, count - 1}:
        assert tried(step, {names[at]}) == (names[: at + 1], True)
    assert tried(step, set()) == (names, False)


def test_beside_what_does_nothing_one_branch_is_no_parallel():
    assert steps_of('<Parallel><AlwaysSuccess/><Say text="a"/></Parallel>') == [
        {"do": [{"say": "a"}]}
    ]
    assert steps_of('<Delay delay_msec="500"><AlwaysSuccess/></Delay>') == [{"do": [{"wait": 0.5}]}]


# --- Nav2 ---------------------------------------------------------------------------------------


def test_nodes_of_nav2_that_have_a_meaning_become_steps_with_its_defaults():
    assert steps_of("""
      <NavigateToPose goal="0;map;1.5;-2;0;0;0;0.70711;0.70711" error_code_id="{e}"/>
      <NavigateThroughPoses goals="0;map;1;0;0;0;0;0;1;0;map;2;0;0;0;0;0;1"/>
      <Spin is_recovery="true"/>
      <BackUp backup_dist="0.3" error_msg="{m}"/>
      <DriveOnHeading dist_to_travel="0.2" speed="0.1"/>
      <Wait wait_duration="5" server_timeout="10"/>
      <Wait/>
      <DriveOnHeading/>""") == [
        {"go_to": {"pose": {"x_m": 1.5, "y_m": -2.0, "yaw_rad": 1.570796}}},
        {"do": [
            {"go_to": {"pose": {"x_m": 1.0, "y_m": 0.0, "yaw_rad": 0.0}}},
            {"go_to": {"pose": {"x_m": 2.0, "y_m": 0.0, "yaw_rad": 0.0}}},
        ]},
        {"go_to": {"by": {"turn_rad": 1.57}}},
        {"go_to": {"by": {"forward_m": -0.3}}},
        {"go_to": {"by": {"forward_m": 0.2}}},
        {"wait": {"duration_s": 5}},
        {"wait": {"duration_s": 1.0}},
        {"go_to": {"by": {"forward_m": 0.15}}},
    ]  # fmt: skip


@pytest.mark.parametrize(
    "ports",
    ['backup_dist="0.3"', 'backup_dist="-0.3"', 'backup_dist="-0.3" backup_speed="-0.05"',
     'backup_dist="0.30" backup_speed="-0.05"'],
)  # fmt: skip
def test_backing_up_goes_backwards_whatever_the_signs_are(ports):
    assert steps_of(f"<BackUp {ports}/>") == [{"go_to": {"by": {"forward_m": -0.3}}}]


def test_driving_on_goes_where_distance_and_speed_agree(problems):
    assert steps_of('<DriveOnHeading dist_to_travel="-0.3" speed="-0.05"/>') == [
        {"go_to": {"by": {"forward_m": -0.3}}}
    ]
    for ports in (
        'dist_to_travel="-0.3" speed="0.05"',
        'dist_to_travel="-0.3"',
        'speed="-0.1"',
        'dist_to_travel="0" speed="0.1"',
    ):
        (said,) = problems(tree(f"<DriveOnHeading {ports}/>"))
        assert "tree.xml:3: Nav2 refuses" in said
    (said,) = problems(tree('<DriveOnHeading dist_to_travel="1" speed="fast"/>'))
    assert "speed: 'fast' where a number should be" in said


def test_a_recovery_node_recovers_and_tries_again_so_often():
    inside = '<RecoveryNode number_of_retries="{n}"><Say text="a"/><Say text="b"/></RecoveryNode>'
    assert steps_of(inside.replace("{n}", "1")) == [
        {"do": [{"say": "a"}], "on_fail": {"any": [{"say": "b"}, {"say": "a"}]}}
    ]
    (step,) = steps_of(inside.replace("{n}", "6"))
    assert step["retry"] == 5
    assert step["on_fail"] == {"any": [{"say": "a"}]}
    (tried,) = step["do"]
    assert tried["on_fail"]["any"][0] == {"say": "b"}
    assert "fail" in tried["on_fail"]["any"][1]


def test_what_is_left_out_stands_above_the_mission(tmp_path):
    path = tmp_path / "a.xml"
    path.write_text(tree('<BackUp backup_speed="0.05"/>'))
    text = importing.mission_of(path)
    assert text.startswith("# left out: line 3, backup_speed of BackUp: ")
    assert yaml_nodes.parse(text, "a.yaml").kind == "map"


SILENT = [
    ('<NavigateToPose goal="0;map;1;0;0.9;0;0;0;1"/>', "z 0.9 of goal"),
    ('<NavigateToPose goal="0;map;1;0;0;0;0;0;1" planner_id="G"/>', "planner_id of NavigateToPose"),
    ('<NavigateToPose goal="0;map;1;0;0;0;0;0;1" server_timeout="9"/>', "server_timeout of"),
    ('<Spin disable_collision_checks="true"/>', "disable_collision_checks of Spin"),
    ('<BackUp is_recovery="true"/>', "is_recovery of BackUp"),
    ('<Wait error_code_id="code"/>', "error_code_id of Wait"),
    ('<SubTree ID="B" words="hi" spare="7"/>', "spare of SubTree: nothing in the tree 'B' reads"),
]


def test_no_port_is_dropped_in_silence(tmp_path):
    path = tmp_path / "a.xml"
    other = '<BehaviorTree ID="B"><SubTree ID="C" _autoremap="1"/></BehaviorTree>'
    other += '<BehaviorTree ID="C"><Say text="{words}"/></BehaviorTree>'
    text = tree("\n".join(node for node, _ in SILENT)).replace("</root>", f"{other}</root>")
    path.write_text(text.replace("<root ", '<root main_tree_to_execute="A" '))
    notes = [line for line in importing.mission_of(path).splitlines() if line.startswith("#")]
    for line, (said, (_, words)) in enumerate(zip(notes, SILENT, strict=True), start=3):
        assert said.startswith(f"# left out: line {line}, {words}")


@pytest.mark.parametrize(
    "node",
    [
        '<Sequence foo="bar"><Say text="a"/></Sequence>',
        '<Repeat num_cycles="2" foo="bar"><Say text="a"/></Repeat>',
        '<NavigateToPose goal="0;map;1;2;0;0;0;0;1" foo="bar"/>',
        '<IfThenElse><Check condition="holding" foo="bar"/><Say text="a"/></IfThenElse>',
        '<AlwaysSuccess foo="bar"/>',
    ],
)
def test_a_port_that_a_node_does_not_have_is_refused(node, problems):
    (said,) = problems(tree(node))
    assert "the port 'foo' of" in said


def test_no_node_is_both_known_and_refused():
    assert not leaves.refused().keys() & (leaves.table().keys() | nodes.NODES.keys())


def test_format_3_is_read_with_its_names_and_its_subtrees():
    made = importing.mission_data(
        parse(
            """<root main_tree_to_execute="A">
      <BehaviorTree ID="A"><SequenceStar>
        <RetryUntilSuccesful num_attempts="2"><Say text="a"/></RetryUntilSuccesful>
        <SubTreePlus ID="B" words="hi"/>
      </SequenceStar></BehaviorTree>
      <BehaviorTree ID="B"><SubTree ID="C" said="words"/></BehaviorTree>
      <BehaviorTree ID="C"><Say text="{said}"/></BehaviorTree></root>""",
            "a.xml",
        )
    )
    assert made["steps"] == [{"say": "a", "retry": 1}, {"do": [{"say": "hi"}]}]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("poses:\n  - header: {frame_id: odom}\n    pose: {position: {x: 1, y: 0, z: 0}}\n",
         "w.yaml:2:24: poses in the frame 'odom'"),
        ("poses: [{position: {x: 1, y: 0, z: 0}}]\nwaypoints: [{pose: [1, 0, 0]}]\n",
         "w.yaml:1:1: waypoints and poses: one list is read"),
        ("header: {frame_id: base_link}\nposes:\n  - {position: {x: 1, y: 0, z: 0}}\n",
         "w.yaml:1:20: poses in the frame 'base_link'"),
        ("frame_id: odom\nposes:\n  - {position: {x: 1, y: 0, z: 0}}\n", "w.yaml:1:11:"),
        ("poses:\n  - {position: {x: 1, y: 0, z: 2}}\n", "2 m from the floor"),
        ("poses:\n  - {position: {x: 1.0e+300, y: 0, z: 0}}\n", "more than 1000 m away"),
        ("poses:\n  - {position: {x: 0, y: -1001, z: 0}}\n", "more than 1000 m away"),
    ],
)  # fmt: skip
def test_waypoints_that_are_not_on_the_floor_of_the_map_are_refused(text, words, problems):
    found = problems(text, "w.yaml")
    assert len(found) == 1
    assert words in found[0]


def test_waypoints_in_the_map_are_walked_along(tmp_path):
    path = tmp_path / "w.yaml"
    path.write_text(
        "poses:\n  - header: {frame_id: map}\n    pose: {position: {x: 1, y: 0, z: 0}}\n"
    )
    made = yaml_nodes.parse(nav2.mission_of(path), "w.yaml").plain_data
    assert made["steps"][0]["go_to"] == {"pose": {"x_m": 1.0, "y_m": 0.0, "yaw_rad": 0.0}}
    assert read_text(path)


@pytest.mark.parametrize("said", ["007", "2020-01-01", "yes", "1e999", "~"])
def test_what_is_to_be_said_is_words_whatever_it_looks_like(said):
    assert steps_of(f'<Say text="{said}"/>') == [{"say": said}]


def test_words_between_tags_are_not_dropped_in_silence():
    with pytest.raises(ConfigError, match="words stand between the tags: only at night"):
        steps_of('only at night<Say text="a"/>')


def test_a_model_of_nodes_may_describe_its_ports():
    ports = "<Action ID='Say'><input_port name='text'>what to say</input_port></Action>"
    head = f"<TreeNodesModel>{ports}</TreeNodesModel>"
    made = importing.mission_data(parse(tree('<Say text="a"/>', head), "tree.xml"))
    assert made["steps"] == [{"say": "a"}]
