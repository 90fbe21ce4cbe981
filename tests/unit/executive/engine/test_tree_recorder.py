"""What the recorder writes is what the tree did, no more and no less."""

from __future__ import annotations

import math
from itertools import pairwise

from py_trees.behaviours import Success
from py_trees.common import Status
from py_trees.composites import Selector, Sequence

from executive.engine.recorder import TreeWatch, kind
from executive.engine.surroundings import PoseWatch, drawing
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from robot.messages import Obstacle, Shape, Track, WorldState
from robot.se3 import SE3
from tests.fakes.recorded import Recorded
from tests.fakes.rig import PICK, PUT, WALK
from tests.fakes.scripted_skills import Script
from tests.fakes.stage import kitchen


class Told:
    """A tree, and what a watch told of it."""

    def __init__(self):
        self.leaves = [Success(name) for name in "ab"]
        self.root = Sequence("all", memory=True, children=self.leaves)
        self.events: list[tuple[str, dict]] = []
        self.watch = TreeWatch(lambda event, **data: self.events.append((event, data)))
        self.watch.look(self.root)

    def news(self):
        self.events.clear()
        self.watch.look(self.root)
        return list(self.events)


def test_the_first_look_tells_the_whole_tree_parents_first():
    told = Told()
    nodes = [[0, -1, "sequence", "all"], [1, 0, "success", "a"], [2, 0, "success", "b"]]
    assert told.events == [("tree", {"nodes": nodes})]


def test_a_tick_without_change_tells_nothing():
    assert Told().news() == []


def test_only_the_nodes_whose_status_changed_are_told():
    told = Told()
    told.leaves[0].status = Status.RUNNING
    told.leaves[0].feedback_message = "x" * 1000
    told.root.status = Status.RUNNING
    assert told.news() == [
        ("node", {"id": 0, "status": "running"}),
        ("node", {"id": 1, "status": "running", "note": "x" * 160}),
    ]


def test_a_new_node_is_told_with_its_place_and_numbers_are_not_used_again():
    told = Told()
    told.root.insert_child(Success("new"), 1)
    assert told.news() == [
        ("tree", {"nodes": [[3, 0, "success", "new"]], "order": [[0, [1, 3, 2]]]})
    ]
    told.root.remove_child(told.leaves[1])
    assert told.news() == [("tree", {"nodes": [], "order": [[0, [1, 3]]]})]
    told.root.add_child(Selector("deep", memory=False, children=[Success("leaf")]))
    assert told.news()[0][1]["nodes"] == [[4, 0, "selector", "deep"], [5, 4, "success", "leaf"]]


def test_a_node_that_is_taken_out_tells_its_last_status_first():
    told = Told()
    told.leaves[1].status = Status.SUCCESS
    told.root.children.remove(told.leaves[1])
    assert [event for event, _ in told.news()] == ["node", "tree"]


def test_another_root_is_another_tree():
    told = Told()
    told.root = Selector("other", memory=False, children=[])
    assert told.news() == [("tree", {"nodes": [[3, -1, "selector", "other"]]})]


def test_a_deep_tree_is_no_problem():
    node = Success("leaf")
    for _ in range(5000):
        node = Sequence("in", memory=True, children=[node])
    events: list[str] = []
    TreeWatch(lambda event, **data: events.append(event)).look(node)
    assert events == ["tree"]


def test_two_equal_runs_write_the_same_bytes():
    def run():
        rig = Recorded({PickParams: [Script(code="grasp_missed"), Script(steps=3)]})
        rig.begin(WALK, PICK).run()
        return b"".join(rig.written)

    assert run() == run()


def test_what_is_recorded_leaves_the_run_as_it_is():
    plain, recorded = Recorded({}), Recorded({})
    plain.recorder.update = lambda: None
    for rig in (plain, recorded):
        rig.begin(WALK, PICK, PUT).run()
    kinds = ("step", "done", "failure", "recovery", "outcome")
    assert plain.events(*kinds) == recorded.events(*kinds)


def test_the_board_is_told_once_a_change_and_the_clock_never():
    rig = Recorded({NavigateParams: [Script(steps=10)]})
    rig.begin(WALK).run()
    changes = [(e.data["key"], e.data["value"]) for e in rig.journal.recent if e.event == "board"]
    assert ("goal", "task") in changes
    assert not {"now_s", "body", "world", "map", "health"} & {key for key, _ in changes}
    assert all(a != b for a, b in pairwise(changes))


def world(x_m=0.0, *, cup=(1.0, 0.0, 0.7), unmapped=(), **how):
    track = Track(id="cup", X_WO=SE3(cup), seen_s=0.0, **how)
    return WorldState(
        stamp_s=0.0, X_WN=SE3(), X_WB=SE3((x_m, 0, 1)), fix_age_s=0.0, tracks=(track,),
        unmapped=unmapped,
    )  # fmt: skip


def test_whereabouts_are_told_when_they_change():
    whereabouts = PoseWatch()
    first = whereabouts.news(world(), mode="stand")
    assert first == {
        "x_m": 0.0, "y_m": 0.0, "yaw_rad": 0.0, "mode": "stand",
        "objects": {"cup": {"x_m": 1.0, "y_m": 0.0, "z_m": 0.7}},
    }  # fmt: skip
    assert whereabouts.news(world(0.005, cup=(1.01, 0.0, 0.7)), mode="stand") == {}
    assert whereabouts.news(world(0.02), mode="stand") == {"x_m": 0.02, "y_m": 0.0, "yaw_rad": 0.0}
    assert whereabouts.news(world(0.02, held_by="left"), mode="walk") == {
        "x_m": 0.02, "y_m": 0.0, "yaw_rad": 0.0, "mode": "walk",
        "objects": {"cup": {"x_m": 1.0, "y_m": 0.0, "z_m": 0.7, "held": "left"}},
    }  # fmt: skip


def test_what_the_map_does_not_explain_comes_and_goes():
    box = Shape(kind="box", size_m=(0.4, 0.2, 1.0))
    chair = Obstacle(id="u1", name="?", X_WO=SE3((1, 1, 0)), shapes=(box,))
    whereabouts = PoseWatch()
    corners = [[0.8, 0.9], [1.2, 0.9], [1.2, 1.1], [0.8, 1.1]]
    assert whereabouts.news(world(unmapped=(chair,)), mode="")["unmapped"] == {"u1": corners}
    assert whereabouts.news(world(unmapped=(chair,)), mode="") == {}
    assert whereabouts.news(world(), mode="")["unmapped"] == {"u1": []}


def test_a_drawing_has_the_furniture_turned_as_it_stands():
    leg = Shape(kind="box", size_m=(0.1, 0.1, 0.7), X_BodyShape=SE3((0.45, 0.2, 0.35)))
    top = Shape(kind="box", size_m=(1.0, 0.5, 0.05), X_BodyShape=SE3((0.0, 0.0, 0.7)))
    X_WO = SE3.from_xy_yaw(2.0, 1.0, math.pi / 2)
    table = Obstacle(id="t", name="table", X_WO=X_WO, shapes=(leg, top))
    plan = drawing(kitchen().__class__(**{**_fields(kitchen()), "obstacles": (table,)}))
    assert plan["furniture"][0]["outline_m"] == [[2.25, 0.5], [2.25, 1.5], [1.75, 1.5], [1.75, 0.5]]
    assert plan["people"] == [{"name": "Ann", "x_m": 0.0, "y_m": 3.0, "radius_m": 0.25}]


def _fields(struct):
    return {name: getattr(struct, name) for name in struct.__struct_fields__}


def test_kinds_are_words_for_people():
    assert kind(Sequence("s", memory=True)) == "sequence"
    assert kind(Success("b")) == "success"
