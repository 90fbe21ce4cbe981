"""What the page is told of a run, now and at any time before."""

from __future__ import annotations

import msgspec

from executive.frontends.console.telling import MOST_NODES, MOST_SAID, told
from tests.fakes.recorded import read


def line(n: int, t_s: float, kind: str, **data) -> bytes:
    return msgspec.json.encode({"n": n, "t_s": t_s, "event": kind, **data}) + b"\n"


NODES = [[0, -1, "jobs", "jobs"], [1, 0, "sequence", "two things"], [2, 1, "skill", "walk"],
         [3, 1, "skill", "wave"]]  # fmt: skip
RUN = (
    ("run", 0.0, {"text": "prompt", "world": "kitchen", "robot": "juno", "attended": True}),
    ("job", 0.1, {"job": 1, "state": "waiting", "text": "two things"}),
    ("job", 0.1, {"job": 1, "state": "running", "text": "two things"}),
    ("tree", 0.1, {"nodes": NODES}),
    ("node", 0.1, {"id": 1, "status": "running"}),
    ("node", 0.1, {"id": 2, "status": "running"}),
    ("board", 0.1, {"key": "goal", "value": "two things"}),
    ("pose", 0.1, {"x_m": 0.0, "y_m": 0.0, "mode": "walk"}),
    ("health", 2.0, {"name": "camera", "level": "HOLD", "cause": "the camera is silent"}),
    ("failure", 3.0, {"step": "walk", "code": "blocked", "cause": "a chair", "evidence": {}}),
    ("said", 4.0, {"text": "Hello."}),
    ("health", 5.0, {"name": "camera", "level": "OK"}),
    ("node", 6.0, {"id": 2, "status": "success"}),
    ("node", 6.0, {"id": 3, "status": "running", "note": "waving"}),
    ("job", 8.0, {"job": 1, "state": "done", "text": "two things"}),
    ("outcome", 8.0, {"code": "done", "took_s": 7.9, "recoveries": 0}),
)


def run(*more):
    return read([line(n, t_s, kind, **data) for n, (kind, t_s, data) in enumerate((*RUN, *more))])


def states(parts) -> dict[str, str]:
    return {row[2]: row[3] for row in parts["tree"]}


def test_it_tells_how_it_stands_now():
    parts = told(run())
    assert parts["head"]["ending"]["code"] == "done"
    assert parts["jobs"] == [[1, "two things", "done"]]
    assert parts["health"] == []
    assert [one[2:] for one in parts["said"] if one[1] == "said"] == [["says: Hello.", "robot"]]


def test_it_tells_how_it_stood_then():
    parts = told(run(), 3.5)
    assert (parts["head"]["ending"], parts["head"]["mode"]) == (None, "walk")
    assert parts["head"]["goal"] == "two things"
    assert states(parts)["walk"] == "running" and states(parts)["wave"] == "waiting"
    assert parts["health"] == [["HOLD", "camera", "the camera is silent"]]
    assert [one["cause"] for one in parts["troubles"]] == ["a chair"]
    assert parts["jobs"] == [[1, "two things", "running"]]
    assert all(one[0] <= 3.5 for one in parts["said"])
    assert states(told(run(), 7.0))["walk"] == "done"
    assert told(run(), 1.0)["troubles"] == []


def test_nothing_is_told_of_nothing():
    parts = told(read([]))
    assert (parts["tree"], parts["said"], parts["jobs"]) == ([], [], [])


def test_a_page_is_told_no_more_than_it_can_show():
    nodes = [[0, -1, "jobs", "jobs"], *([k, 0, "skill", f"step {k}"] for k in range(1, 3000))]
    said = [("said", 9.0, {"text": str(k)}) for k in range(1000)]
    parts = told(run(("tree", 9.0, {"nodes": nodes}), *said))
    assert len(parts["tree"]) <= MOST_NODES
    assert len(parts["said"]) == MOST_SAID and parts["said"][-1][2] == "says: 999"
