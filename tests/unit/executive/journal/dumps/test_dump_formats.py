"""Every format shows the same tree, and no name in it can do harm."""

from __future__ import annotations

import io
import re
from itertools import combinations
from xml.etree import ElementTree

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from executive.journal.dumps import layout, svg
from executive.journal.dumps.dot import quoted
from executive.journal.dumps.formats import FORMATS, Wish, render
from executive.journal.dumps.text import picture
from executive.journal.run import Run
from executive.journal.snapshot import Shown, come_to_rest, snapshot
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.trees.build import build
from executive.trees.parts import Always, Branch, Loop, Retry, Series, Timeout
from robot.printable import is_printable
from tests.fakes.long_run import LongRun
from tests.fakes.recorded import Recorded, read
from tests.fakes.rig import PICK, WAIT, WALK
from tests.fakes.scripted_skills import Script

HOSTILE = "</script><script>alert(1)</script>\"'&\\<!--\x1b[31m\n]]>\u202e{x}|é杯"


@pytest.fixture(scope="module")
def recovered() -> Run:
    """Picked at the second try, waiting when it ends."""
    rig = Recorded({PickParams: [Script(steps=2, code="grasp_missed"), Script(steps=5)]})
    rig.begin(PICK, WAIT).tick(6)
    return rig.read()


@pytest.fixture(scope="module")
def many() -> Run:
    return read(LongRun(nodes=500, duration_s=600.0).lines)


def named(name: str) -> list[Shown]:
    leaf = Shown(id=1, kind="skill", name=name, state="failed", note=name)
    return [Shown(id=0, kind="sequence", name=name, state="running", children=[leaf])]


def test_nothing_is_at_work_at_the_end_of_a_run_that_was_stopped():
    rig = Recorded({PickParams: [Script(steps=20, stop_steps=2)]})
    rig.begin(PICK).tick(3)
    rig.executive.stop("enough")
    rig.run()
    run = rig.read()
    assert any(one.state == "running" for root in snapshot(run) for _, one in root.walk())
    come_to_rest(run)
    assert not [one for root in snapshot(run) for _, one in root.walk() if one.state == "running"]


def test_what_was_given_up_at_once_was_stopped():
    rig = Recorded({PickParams: [Script(steps=20, stop_steps=2)]})
    rig.begin(PICK).tick(3)
    rig.executive.abandon(None, rig.now_s)
    run = rig.read()
    come_to_rest(run)
    shown = [one for root in snapshot(run) for _, one in root.walk()]
    assert [one.name for one in shown if one.state == "stopped"] == ["task", "pick"]
    assert not [one for one in shown if one.state == "running"]


def test_what_a_run_that_was_cut_off_was_at_stays_at_work():
    rig = Recorded({PickParams: [Script(steps=20)]})
    rig.begin(PICK).tick(3)
    run = rig.read()
    come_to_rest(run)
    assert [one.name for _, one in snapshot(run)[0].walk() if one.state == "running"] == [
        "task", "pick"
    ]  # fmt: skip


def test_recoveries_of_all_jobs_are_counted():
    rig = Recorded({PickParams: [Script(steps=2, code="grasp_missed"), Script(steps=5)] * 2})
    for _ in range(2):
        rig.begin(PICK).run()
    assert rig.read().recoveries == 2


def test_people_see_the_steps_and_not_what_holds_them_together(recovered):
    assert picture(snapshot(recovered), style="ascii").splitlines() == [
        "> task  (0.1 s)",
        "  > pick  (0.1 s)",
        "    x pick: scripted grasp_missed  (0.1 s)",
        "    + recover: look again, then retry (1 of 2)",
        "    > look again, then retry  (0.1 s)",
        "      + look for cup",
        "      > pick: working  (0.1 s)",
        "    wait",
    ]


def test_everything_is_every_node_in_view(recovered):
    shown = [s for root in snapshot(recovered, everything=True) for _, s in root.walk()]
    in_view = [n for n in recovered.nodes.values() if n.in_view(recovered.end_s)]
    assert len(shown) == len(in_view)
    assert len(shown) > sum(1 for root in snapshot(recovered) for _ in root.walk())


def test_the_styles_of_text_say_the_same(recovered):
    roots = snapshot(recovered)
    plain = picture(roots)
    coloured = re.sub(r"\x1b\[[0-9;]*m", "", picture(roots, style="colour"))
    assert coloured == plain
    assert picture(roots, style="ascii").isascii()
    assert len(picture(roots, style="ascii").splitlines()) == len(plain.splitlines())


def test_no_name_commands_a_terminal():
    text = picture(named(HOSTILE))
    assert "\x1b" not in text
    assert "\u202e" not in text
    assert len(text.splitlines()) == 2


@pytest.mark.parametrize("kind", ["html", "svg", "dot", "json", "text"])
@given(name=st.text(st.one_of(st.characters(), st.sampled_from("\x1b\x9b\u202e\x00"))))
def test_no_format_commands_whoever_looks_at_it(kind, name):
    name = name.encode(errors="replace").decode()  # no journal holds half a letter
    run = read([
        msgspec.json.encode({"n": n, "t_s": 0.0, **event}) + b"\n"
        for n, event in enumerate([
            {"event": "run", "text": name},
            {"event": "tree", "nodes": [[0, -1, "jobs", name], [1, 0, "skill", name]]},
            {"event": "node", "id": 1, "status": "running", "note": name},
            {"event": "board", "key": name, "value": {name: [name]}},
        ])
    ])  # fmt: skip
    assert is_printable(render(run, kind).decode())


def test_an_svg_is_well_formed_whatever_the_names():
    root = ElementTree.fromstring(svg.svg(named(HOSTILE + "\ufffe\x00"), title=HOSTILE))
    assert {element.tag.rpartition("}")[2] for element in root.iter()} <= {
        "svg", "title", "rect", "path", "g", "text",
    }  # fmt: skip
    assert all(not name.startswith("on") for element in root.iter() for name in element.attrib)


def test_an_svg_has_a_box_a_node(many):
    roots = snapshot(many, 300.0)
    root = ElementTree.fromstring(svg.svg(roots, title="t"))
    count = sum(1 for top in roots for _ in top.walk())
    assert count > 450
    boxes = root.findall("{http://www.w3.org/2000/svg}g")
    again = [box for box in boxes if "continued" in "".join(box.itertext())]
    assert len(boxes) - len(again) == count
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    assert 0.4 < width / height < 2.5


def test_columns_hold_every_leaf_once_and_in_order(many):
    roots = snapshot(many, 300.0)
    leaves = [s.id for root in roots for _, s in root.walk() if not s.children]
    for count in (1, 3, 7):
        parts = layout.split(roots, count)
        found = [[s.id for r in part for _, s in r.walk() if not s.children] for part in parts]
        assert [leaf for part in found for leaf in part] == leaves
        assert max(map(len, found)) - min(map(len, found)) <= 1


def test_no_two_boxes_touch_and_lines_go_to_the_right(many, recovered):
    for roots in (snapshot(many, 300.0), snapshot(recovered, everything=True)):
        drawn = layout.arrange(roots, svg.measure)
        for a, b in combinations(drawn.boxes[::3], 2):
            apart_x = a.x + a.width <= b.x or b.x + b.width <= a.x
            apart_y = a.y + a.height < b.y or b.y + b.height < a.y
            assert apart_x or apart_y
        for parent, child in drawn.edges:
            a, b = drawn.boxes[parent], drawn.boxes[child]
            assert a.x + a.width < b.x
        assert all(box.x > 0 and box.x + box.width < drawn.width for box in drawn.boxes)
        assert all(box.y > 0 and box.y + box.height < drawn.height for box in drawn.boxes)


def test_a_png_is_a_picture_with_the_colours_of_the_states(recovered):
    image = Image.open(io.BytesIO(render(recovered, "png")))
    image.load()
    colours = {colour for _, colour in image.getcolors(maxcolors=1 << 24) or ()}
    for state in ("running", "done", "failed", "waiting"):
        fill = layout.LOOKS[state].fill
        assert tuple(int(fill[k : k + 2], 16) for k in (1, 3, 5)) in colours


def test_an_empty_run_has_a_picture_too():
    for kind in FORMATS:
        assert render(Run(), kind)


def test_dot_is_what_graphviz_reads(recovered):
    text = render(recovered, "dot").decode()
    nodes = set(re.findall(r"^  (n\d+) \[", text, re.MULTILINE))
    edges = re.findall(r"^  (n\d+) -> (n\d+);$", text, re.MULTILINE)
    assert len(nodes) == sum(1 for root in snapshot(recovered) for _ in root.walk())
    assert {name for edge in edges for name in edge} <= nodes
    inside = re.sub(r'"(?:[^"\\]|\\.)*"', "", text)
    assert '"' not in inside
    assert inside.count("{") == inside.count("}") == 1


def test_quotes_in_dot_end_where_they_should():
    assert re.fullmatch(r'"(?:[^"\\]|\\.)*"', quoted(HOSTILE))


def test_json_reads_back_to_the_same_run(many):
    assert msgspec.json.decode(render(many, "json"), type=Run).dumped() == many.dumped()


def test_a_picture_is_of_the_time_that_was_asked_for(recovered):
    begin = render(recovered, "text", Wish(t_s=0.0)).decode()
    assert "look again" not in begin
    assert "look again" in render(recovered, "text").decode()


def test_a_mission_is_shown_without_the_workings_of_its_loops():
    rig = Recorded()
    parts = (
        Loop(name="patrol", bodies=(WALK,), at_most=2),
        Retry(name="try twice", part=PICK, attempts=2),
        Timeout(name="in time", part=WALK, limit_s=20.0),
        Always(name="tidy", part=WALK, after=WAIT),
        Branch(name="if seen", question=lambda _: False, then=PICK, otherwise=WAIT),
    )
    node = build(Series(name="task", parts=parts), rig.stage)
    rig.executive.submit(lambda _: node, text="a mission")
    rig.run()
    expected = [
        "+ a mission",
        "  + patrol",
        "    + walk",
        "    + walk",
        "  + try twice",
        "    + pick",
        "  + in time",
        "    + walk",
    ]
    shown = re.sub(
        r"(:.*|  \(.*)$", "", picture(snapshot(rig.read()), style="ascii"), flags=re.MULTILINE
    )
    assert shown.splitlines()[: len(expected)] == expected
    words = ("another round", "again", "remember", "as it ended", "recover")
    assert not any(word in shown for word in words)
    assert "no\n" in shown  # the answer to the question


def test_a_guard_is_shown_while_it_has_something_to_do():
    rig = Recorded({NavigateParams: [Script(steps=50, stop_steps=3)]})
    rig.begin(WALK).tick(3)
    rig.executive.pause("wait")
    rig.tick(20)
    rig.executive.resume()
    rig.tick(3)
    run = rig.read()
    assert "pause" in picture(snapshot(run, 0.5))
    assert "pause" not in picture(snapshot(run, 0.1))
    assert "pause" not in picture(snapshot(run, run.end_s))
