"""Files of other programs: included ones, Nav2's nodes and frames, all that is wrong at once."""

from __future__ import annotations

import pytest

from executive.missions import nav2
from executive.missions.btcpp import importing, leaves, nodes
from executive.missions.btcpp.xml import parse
from robot import yaml_nodes
from robot.errors import ConfigError
from robot.yaml_nodes import read_text


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


# --- Nav2 ---------------------------------------------------------------------------------------


def test_nodes_of_nav2_that_have_a_meaning_become_steps_with_its_defaults():
    assert steps_of("""
      <NavigateToPose goal="0;map;1.5;-2;0;0;0;0.70711;0.70711" error_code_id="{e}"/>
      <NavigateThroughPoses goals="0;map;1;0;0;0;0;0;1;0;map;2;0;0;0;0;0;1"/>
      <Spin is_recovery="true"/>
      <BackUp backup_dist="0.3" error_msg="{m}"/>
      <DriveOnHeading dist_to_travel="0.2" speed="0.1"/>
      <Wait wait_duration="5" server_timeout="10"/>""") == [
        {"go_to": {"pose": {"x_m": 1.5, "y_m": -2.0, "yaw_rad": 1.570796}}},
        {"do": [
            {"go_to": {"pose": {"x_m": 1.0, "y_m": 0.0, "yaw_rad": 0.0}}},
            {"go_to": {"pose": {"x_m": 2.0, "y_m": 0.0, "yaw_rad": 0.0}}},
        ]},
        {"go_to": {"by": {"turn_rad": 1.57}}},
        {"go_to": {"by": {"forward_m": -0.3}}},
        {"go_to": {"by": {"forward_m": 0.2}}},
        {"wait": {"duration_s": 5}},
    ]  # fmt: skip


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
