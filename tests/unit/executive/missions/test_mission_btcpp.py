"""BehaviorTree.CPP XML and Nav2 waypoints: what is read, what is refused by name, and back."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.missions import nav2
from executive.missions.btcpp import exporting, importing, leaves
from executive.missions.btcpp.xml import parse
from executive.missions.load import shipped
from robot.errors import ConfigError
from robot.files import yaml_nodes
from tests.fakes.missions import SIMULATION, check, known_settings  # noqa: F401, a fixture


def data_of(xml: str) -> dict[str, Any]:
    return importing.mission_data(parse(xml, "tree.xml"))


def tree(inside: str, more: str = "") -> str:
    main = f'<BehaviorTree ID="Main">\n{inside}\n</BehaviorTree>{more}'
    return f'<root BTCPP_format="4" main_tree_to_execute="Main">\n{main}</root>'


def steps_of(inside: str, more: str = "") -> list[Any]:
    return data_of(tree(inside, more))["steps"]


def refusal(inside: str, more: str = "") -> str:
    with pytest.raises(ConfigError) as error:
        data_of(tree(inside, more))
    return str(error.value)


def test_stock_nodes_become_steps():
    assert steps_of("""
      <Sequence>
        <Fallback name="try">
          <MoveTo location="table"/>
          <Say text="no way"/>
        </Fallback>
        <RetryUntilSuccessful num_attempts="3"><PickObject object="red cup"/></RetryUntilSuccessful>
        <Timeout msec="2500"><Sleep msec="500"/></Timeout>
        <Repeat num_cycles="2"><Sequence><Say text="a"/><Say text="b"/></Sequence></Repeat>
        <ForceSuccess><Action ID="SaySomething" message="{words}"/></ForceSuccess>
        <Parallel success_count="-1" failure_count="1">
          <Spin spin_dist="1.57"/>
          <Wait wait_duration="2"/>
        </Parallel>
        <IfThenElse><IsHolding object="red cup"/><Say text="yes"/><Say text="no"/></IfThenElse>
        <Inverter><IsHolding/></Inverter>
      </Sequence>""".replace("{words}", "hi")) == [
        {"do": [{"go_to": {"place": "table"}}], "on_fail": {"any": [{"say": "no way"}]},
         "name": "try"},
        {"pick": {"object": "red cup"}, "retry": 2},
        {"wait": {"duration_s": 0.5}, "timeout_s": 2.5},
        {"repeat": 2, "do": [{"say": "a"}, {"say": "b"}]},
        {"say": "hi", "on_fail": {"any": []}},
        {"parallel": [{"go_to": {"by": {"turn_rad": 1.57}}}, {"wait": {"duration_s": 2}}]},
        {"if": {"holding": "red cup"}, "then": [{"say": "yes"}], "else": [{"say": "no"}]},
        {"if": {"not": {"holding": True}}, "then": [],
         "else": [{"fail": 'not so: {"not":{"holding":true}}'}]},
    ]  # fmt: skip


def test_subtrees_are_written_out_with_their_ports():
    more = """
      <BehaviorTree ID="Fetch"><Sequence>
        <PickObject object="{what}"/>
        <SubTree ID="Put" _autoremap="1" on="shelf"/>
      </Sequence></BehaviorTree>
      <BehaviorTree ID="Put"><Place object="{what}" on="{on}"/></BehaviorTree>"""
    assert steps_of('<SubTree ID="Fetch" what="blue cup" name="get it"/>', more) == [
        {
            "do": [
                {"pick": {"object": "blue cup"}},
                {"do": [{"place": {"object": "blue cup", "on": "shelf"}}]},
            ],
            "name": "get it",
        }
    ]


@pytest.mark.parametrize(
    ("inside", "words"),
    [
        ("<ReactiveSequence><Say text='a'/></ReactiveSequence>", "ReactiveSequence"),
        ("<Script code='a:=1'/>", "Script has no equivalent"),
        ("<KeepRunningUntilFailure><Say text='a'/></KeepRunningUntilFailure>", "no end"),
        ("<Repeat num_cycles='-1'><Say text='a'/></Repeat>", "num_cycles='-1'"),
        ("<Parallel success_count='1'><Say text='a'/><Wait duration_s='1'/></Parallel>",
         "Parallel that does not wait"),
        ("<Inverter><Say text='a'/></Inverter>", "Inverter of an action"),
        ("<OpenGriper/>", "'OpenGriper' has no equivalent"),
        ("<Pick objct='cup'/>", "did you mean 'object'"),
        ("<Say text='{words}'/>", "{words} has no value"),
        ("<Say text='a' _skipIf='x'/>", "_skipIf"),
        ("<SubTree ID='Main'/>", "calls itself: Main > Main"),
        ("<SubTree ID='Mian'/>", "did you mean 'Main'"),
        ("<Switch2/>", "Switch2"),
    ],
)  # fmt: skip
def test_what_has_no_equivalent_is_refused_by_name_and_line(inside, words):
    text = refusal(f"\n{inside}")
    assert words in text
    assert text.startswith("tree.xml:4")


@pytest.mark.parametrize(
    "text",
    [
        '<!DOCTYPE a [<!ENTITY x "y">]><root BTCPP_format="4">&x;</root>',
        '<!DOCTYPE a SYSTEM "file:///etc/passwd"><root/>',
        "<root>" * 101,
        "<root" + " " * 10,
        "",
        "<root BTCPP_format='3'/>",
        "<tree/>",
        "<root BTCPP_format='4'/>",
        tree(""),
        tree("<Sequence/>"),
        "<root>" + "<a/>" * 60_000 + "</root>",
    ],
)
def test_hostile_xml_is_refused(text):
    with pytest.raises(ConfigError, match=r"tree\.xml"):
        data_of(text)


@pytest.mark.parametrize("letter", ["&#x9b;", "&#x202e;", "\x9d", "\u2028", "&#x7f;"])
def test_texts_that_cannot_be_printed_are_refused(letter):
    with pytest.raises(ConfigError, match="cannot be printed"):
        data_of(tree(f'<Say text="hi{letter}there"/>'))


# --- the way back -------------------------------------------------------------------------------

WORDS = st.text("abc xyz äß<&>\"'", min_size=1, max_size=12).map(str.strip).filter(bool)
CONDITIONS = st.sampled_from(
    ["the red cup is on the table", {"holding": True}, {"not": {"seen": "red cup", "on": "shelf"}}]
)
LEAVES = st.one_of(
    st.just("walk to the table"),
    WORDS.map(lambda text: {"say": text}),
    st.just({"pick": {"object": "red cup", "at": "table"}}),
    st.just({"place": {"object": "it", "on": "shelf"}}),
    st.just({"go_to": {"by": {"forward_m": -0.25, "turn_deg": 90}}}),
    st.just({"go_to": {"pose": {"x_m": 1.5, "y_m": -2.0}}}),
    st.just({"balance": {"mode": "lean", "side": "left", "duration_s": 1.5}}),
    st.just({"report": "health"}),
    WORDS.map(lambda text: {"fail": text}),
)


def _dressed(both: tuple[Any, dict[str, Any]]) -> Any:
    step, options = both
    return {**step, **options} if isinstance(step, dict) else step


def _structures(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    steps = st.lists(inner, min_size=1, max_size=3)
    bare = st.one_of(
        LEAVES,
        steps.map(lambda do: {"do": do}),
        st.tuples(st.integers(1, 9), steps).map(lambda b: {"repeat": b[0], "do": b[1]}),
        st.tuples(CONDITIONS, steps).map(lambda b: {"while": b[0], "at_most": 3, "do": b[1]}),
        st.tuples(CONDITIONS, steps, steps).map(lambda b: {"if": b[0], "then": b[1], "else": b[2]}),
        st.tuples(steps, steps).map(lambda b: {"parallel": list(b)}),
    )
    options = st.fixed_dictionaries(
        {},
        optional={
            "name": WORDS,
            "retry": st.integers(1, 5),
            "timeout_s": st.integers(1, 100).map(float),
            "on_fail": st.dictionaries(st.sampled_from(["no_path", "any"]), steps, min_size=1),
            "always": steps,
        },
    )
    return st.tuples(bare, options).map(_dressed)


STEPS = st.lists(st.recursive(LEAVES, _structures, max_leaves=8), min_size=1, max_size=4)


@settings(max_examples=60, deadline=None)
@given(steps=STEPS, expect=st.lists(CONDITIONS, max_size=2))
def test_what_is_exported_reads_back_to_the_same_steps(steps, expect):
    mission = {"name": "it", "steps": steps, **({"expect": expect} if expect else {})}
    xml = exporting.xml_of_data(mission)
    assert data_of(xml) == mission
    assert "<TreeNodesModel" in xml


@pytest.mark.parametrize("path", shipped(), ids=lambda path: path.stem)
def test_shipped_missions_go_out_and_back(path, tmp_path):
    xml = exporting.xml_of(path, SIMULATION)
    copy = tmp_path / "back.yaml"
    copy.write_text(yaml_nodes.dump(data_of(xml)), encoding="utf-8")
    check(copy)
    assert exporting.xml_of(copy, SIMULATION) == xml


def test_the_table_names_only_steps_that_there_are():
    from executive.missions.schema import STEPS as KINDS

    for leaf in leaves.table().values():
        assert leaf.step in (*KINDS, "sentence")


# --- Nav2 ---------------------------------------------------------------------------------------


def test_waypoints_become_a_walk(tmp_path):
    panel = tmp_path / "my_round.yaml"
    panel.write_text(
        "waypoints:\n"
        "  waypoint0:\n    pose: [1.0, 0.5, 0.0]\n    orientation: [0.7071068, 0, 0, 0.7071068]\n"
    )
    poses = tmp_path / "poses.yaml"
    poses.write_text(
        "poses:\n  - header: {frame_id: map}\n    pose:\n"
        "      position: {x: 1.0, y: 0.5, z: 0.0}\n"
        "      orientation: {x: 0, y: 0, z: 0.7071068, w: 0.7071068}\n"
    )
    for path in (panel, poses):
        mission = tmp_path / "made.yaml"
        mission.write_text(nav2.mission_of(path))
        (step,) = check(mission).task.parts  # type: ignore[union-attr]
        pose = step.params.pose
        assert (pose.x_m, pose.y_m, pose.yaw_rad) == (1.0, 0.5, pytest.approx(1.570796))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("waypoints: {a: {pose: [1, 2], orientation: [1, 0, 0, 0]}}", "3 numbers"),
        ("waypoints: {a: {pose: [1, 2, 0], orientation: [2, 0, 0, 0]}}", "length 2"),
        ("waypoints: {a: {pose: [1, 2, 0], orientation: [0, 1, 0, 0]}}", "leans by 180"),
        ("waypoints: {a: {orientation: [1, 0, 0, 0]}}", "no position"),
        ("waypoints: {}", "no waypoints"),
        ("hello", "no waypoints"),
    ],
)
def test_waypoints_that_cannot_be_walked_are_refused(text, words, tmp_path):
    path = tmp_path / "points.yaml"
    path.write_text(text)
    with pytest.raises(ConfigError, match=words) as error:
        nav2.mission_of(path)
    assert "points.yaml:1:" in str(error.value)
