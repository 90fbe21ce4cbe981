"""Runs for other programs: what independent readers find in them."""

from __future__ import annotations

import csv
import itertools
import json
import re

import msgspec
import mujoco
import numpy as np
import pytest

from executive.frontends.dump.command import Asked, dump
from executive.frontends.dump.recording import Recording
from executive.frontends.dump.tables import FORMULAS
from executive.frontends.end_signals import Ending
from executive.journal import journal, motion, sensed
from executive.journal.motion import Moment
from executive.journal.sensed import Scan, Sensed
from robot import shots
from robot.errors import ConfigError
from robot.model import description
from robot.model.body import BodyModel
from robot.printable import is_printable
from robot.se3 import SE3
from robot.shots import Shot

CUP = (1.0, 0.5, 0.8, 1.0, 0.0, 0.0, 0.0)
ROBOT = description.load("juno")
BODY = BodyModel(ROBOT)
WALL_S = 1.7e9


@pytest.fixture
def run(tmp_path):
    """A run of three moments, in postures of which every joint counts."""
    folder = tmp_path / "run"
    folder.mkdir()
    lines = [
        {"n": 0, "t_s": 0.5, "event": "run", "text": "wave", "world": "kitchen", "robot": "juno"},
        {"n": 1, "t_s": 1.0, "event": "said", "text": "Hello, =1+1."},
        {"n": 2, "t_s": 1.2, "event": "warning", "text": "low"},
    ]
    _write(folder / journal.FILE, map(msgspec.json.encode, lines))
    _write(folder / journal.WALL_FILE, [b'{"n":0,"wall_s":%.1f}' % (WALL_S + 0.5)])
    rng = np.random.default_rng(5)
    moves = [
        Moment(
            t_s=1.0 + k,
            base=(0.1 * k, 0.0, 0.6, *SE3.from_rpy(0.1, -0.2, k, (0, 0, 0)).quat_wxyz),
            q=tuple(rng.uniform(BODY.lower_rad, BODY.upper_rad).tolist()),
            objects={"red_cup": (CUP, None, CUP)[k]},
            held=("red_cup",) if k == 2 else None,
        )
        for k in range(3)
    ]
    _write(folder / motion.FILE, map(motion.encode, moves))
    return folder, moves


def _write(path, lines):
    path.write_bytes(b"".join(line + b"\n" for line in lines))


def _messages(path):
    reader = pytest.importorskip("mcap.reader", reason="the extra `dev` is not installed")
    protobuf = pytest.importorskip("mcap_protobuf.decoder")
    with path.open("rb") as file:
        made = reader.make_reader(file, decoder_factories=[protobuf.DecoderFactory()])
        found = {}
        for schema, channel, message in made.iter_messages():
            if channel.message_encoding == "json":
                told = json.loads(message.data)
            else:
                told = protobuf.DecoderFactory().decoder_for("protobuf", schema)(message.data)
            found.setdefault(channel.topic, []).append((message.log_time / 1e9, told))
        return found, made.get_summary()


def _pose(translation, rotation):
    at = (translation.x, translation.y, translation.z)
    return SE3(at, (rotation.w, rotation.x, rotation.y, rotation.z))


def test_frames_of_an_mcap_stand_as_mujoco_has_the_bodies(run, tmp_path):
    """Composed from the world to every link, at every moment."""
    folder, moves = run
    path = tmp_path / "a.mcap"
    assert dump(Asked(run=str(folder), kind="mcap", output=path)) == 0
    found, summary = _messages(path)
    assert summary.chunk_indexes  # may be sought in
    fixed = {one.child_frame_id: one for one in found["/tf_static"][0][1].transforms}
    assert len(found["/tf"]) == len(moves)
    for (when_s, told), moment in zip(found["/tf"], moves, strict=True):
        assert when_s == pytest.approx(WALL_S + moment.t_s)
        frames = fixed | {one.child_frame_id: one for one in told.transforms}
        data = BODY.data()
        BODY.write_base(data, SE3(moment.base[:3], moment.base[3:]))
        BODY.write_joints(data, np.array(moment.q))
        mujoco.mj_kinematics(BODY.model, data)
        assert len(frames) == BODY.model.nbody - 1
        for name in frames:
            X, at = SE3(), name
            while at != "world":
                X = _pose(frames[at].translation, frames[at].rotation) @ X
                at = frames[at].parent_frame_id
            np.testing.assert_allclose(X.p, data.body(name).xpos, atol=1e-6, err_msg=name)
            R = data.body(name).xmat.reshape(3, 3)
            np.testing.assert_allclose(X.rotation(), R, atol=1e-6, err_msg=name)


def test_an_mcap_has_joints_by_name_words_by_level_and_things_while_they_are_known(run, tmp_path):
    folder, moves = run
    path = tmp_path / "a.mcap"
    dump(Asked(run=str(folder), kind="mcap", output=path))
    found, _ = _messages(path)
    joints = [(one.name, one.position) for one in found["/joint_states"][1][1].joints]
    assert joints == list(zip(ROBOT.motor_names, moves[1].q, strict=True))
    words = [(one.name, one.level, one.message) for _, one in found["/log"]]
    assert ("said", 2, "says: Hello, =1+1.") in words
    assert [level for name, level, _ in words if name == "warning"] == [3]
    cups = [told for _, told in found["/things/object/red_cup"]]
    assert [len(one.entities) for one in cups] == [1, 0, 1]
    assert [one.id for one in cups[1].deletions] == ["object/red_cup"]
    assert [event["event"] for _, event in found["/events"]] == ["run", "said", "warning"]
    assert found["/state"][-1][1] == {"held": ["red_cup"]}
    shown = {entity.id for entity in found["/scene"][0][1].entities}
    assert "torso" in shown and any(name.startswith("furniture/") for name in shown)


@pytest.mark.parametrize("how", ["dump", "recording"])
def test_an_mcap_has_scans_pictures_torques_and_temperatures(run, tmp_path, how):
    folder, moves = run
    path = tmp_path / "a.mcap"
    ranges_m = np.full(180, 1.5)
    ranges_m[90] = 0.0  # no hit
    scan = Scan(
        from_rad=-3.0, step_rad=0.03, ranges_mm=np.rint(1000 * ranges_m).astype("<u2").tobytes()
    )
    torque, heat = (0.5,) * len(moves[0].q), (31.0,) * len(moves[0].q)
    line = sensed.encode(Sensed(t_s=1.5, scan=scan, torque=torque, heat=heat))
    _write(folder / sensed.FILE, [line, b"no line"])
    shot = Shot(
        t_s=2.0, kind="colour", type="jpeg", data=b"a picture", width=4, height=3,
        focal_px=(2.0, 2.0), centre_px=(1.5, 1.0),
    )  # fmt: skip
    _write(folder / shots.COLOUR_FILE, [shots.encode(shot)])
    if how == "dump":
        assert dump(Asked(run=str(folder), kind="mcap", output=path)) == 0
    else:
        with path.open("wb") as file, Ending() as ending:
            recording = Recording(folder, file, ending)
            while recording.take():
                pass
            recording.close()
    found, _ = _messages(path)
    ((when_s, told),) = found["/scan"]
    assert when_s == pytest.approx(WALL_S + 1.5)
    frames = (*found["/tf_static"][0][1].transforms, *found["/tf"][0][1].transforms)
    assert told.frame_id in {one.child_frame_id for one in frames}
    assert (told.start_angle, told.end_angle) == pytest.approx((-3.0, -3.0 + 179 * 0.03))
    assert list(told.ranges[:90]) == [1.5] * 90 and told.ranges[90] == float("inf")
    ((_, motors),) = found["/motors"]
    assert motors == {"names": list(ROBOT.motor_names), "torque": [*torque], "heat_c": [*heat]}
    ((_, picture),) = found["/camera/image"]
    assert (picture.data, picture.format) == (b"a picture", "jpeg")


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_tables_hold_every_moment_and_event(run, tmp_path, kind):
    folder, moves = run
    assert dump(Asked(run=str(folder), kind=kind, output=tmp_path / "out")) == 0
    rows = {
        path.stem: (_csv(path) if kind == "csv" else _parquet(path))
        for path in (tmp_path / "out").iterdir()
    }
    assert set(rows) == {"motion", "things", "tree", "log", "events"}
    assert [float(row["t_s"]) for row in rows["motion"]] == [1.0, 2.0, 3.0]
    for row, moment in zip(rows["motion"], moves, strict=True):
        q = [float(row[f"q_{name}"]) for name in ROBOT.motor_names]
        np.testing.assert_allclose(q, moment.q)
    cups = [row["x_m"] for row in rows["things"]]
    assert [one in ("", None) for one in cups] == [False, True, False]
    assert [json.loads(row["data"])["text"] for row in rows["events"]] == [
        "wave", "Hello, =1+1.", "low",
    ]  # fmt: skip


HOSTILE = (
    "=cmd|' /C calc'!A0", "@SUM(1+1)", "+1", "-1", "\t=1", "\r=1", " =1", "\n=1", "＝1",
    "cup;=1+1", "cup; =1", "cup;\"@SUM(1)", "a;b;-1;+1", "cup|=1",
    "\x1b]0;owned\x07", "a\u202eb", "a\u200bb", "\x9b31m",
)  # fmt: skip


@pytest.mark.parametrize("text", HOSTILE)
def test_no_cell_of_a_csv_is_worked_out_or_obeyed(text, run, tmp_path):
    folder, _ = run
    event = {"n": 9, "t_s": 2.0, "event": text, "text": text, text: text}
    moment = {"t_s": 9.0, "base": [0, 0, -1.5, 1, 0, 0, 0], "q": [], "objects": {text: CUP}}
    for name, line in ((journal.FILE, event), (motion.FILE, moment)):
        with (folder / name).open("ab") as file:
            file.write(msgspec.json.encode(line) + b"\n")
    dump(Asked(run=str(folder), kind="csv", output=tmp_path / "out"))
    for path in (tmp_path / "out").iterdir():
        assert is_printable(path.read_text())
        for row in csv.reader(path.open(newline="")):
            for cell in row:
                assert cell[:1] not in "=+-@\t\r\n＝" or cell == "" or float(cell) < 0
                for part in re.split("[;|\t]", cell)[1:]:  # as a spreadsheet elsewhere splits it
                    assert part.strip(" '\"")[:1] not in FORMULAS or "'" in part[:3], cell
    assert _csv(tmp_path / "out" / "motion.csv")[-1]["base_z_m"] == "-1.5"
    assert json.loads(_csv(tmp_path / "out" / "events.csv")[-1]["data"])[text] == text


def _csv(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def _parquet(path):
    parquet = pytest.importorskip("pyarrow.parquet")
    return parquet.read_table(path).to_pylist()


def test_a_world_that_cannot_be_read_leaves_its_shapes_out_and_is_not_told_of(
    run, tmp_path, capsys
):
    folder, moves = run
    elsewhere = tmp_path / "elsewhere.yaml"
    elsewhere.write_text("very_secret_key: swordfish\n")
    text = (folder / journal.FILE).read_text().replace('"kitchen"', f'"{elsewhere}"')
    (folder / journal.FILE).write_text(text)
    path = tmp_path / "a.mcap"
    assert dump(Asked(run=str(folder), kind="mcap", output=path)) == 0
    told = "".join(itertools.chain(*capsys.readouterr()))
    assert "no shapes" in told and "secret" not in told and "swordfish" not in told
    found, _ = _messages(path)
    assert len(found["/joint_states"]) == len(moves) and "/tf" not in found
    dump(Asked(run=str(folder), kind="csv", output=tmp_path / "out"))
    rows = _csv(tmp_path / "out" / "motion.csv")
    assert [float(row["q_0"]) for row in rows] == [moment.q[0] for moment in moves]


def test_things_beyond_those_that_have_a_topic_are_left_out_and_said(
    run, tmp_path, capfd, monkeypatch
):
    monkeypatch.setattr("executive.frontends.dump.foxglove.MOST_THINGS", 5)
    folder, moves = run
    with (folder / motion.FILE).open("ab") as file:
        things = {f"thing_{number}": CUP for number in range(9)}
        for t_s in (9.0, 9.5):
            line = {"t_s": t_s, "base": [0, 0, 0, 1, 0, 0, 0], "q": [], "objects": things}
            file.write(msgspec.json.encode(line) + b"\n")
    path = tmp_path / "a.mcap"
    assert dump(Asked(run=str(folder), kind="mcap", output=path)) == 0
    found, _ = _messages(path)
    assert sum(topic.startswith("/things/") for topic in found) == 5
    assert len(found["/joint_states"]) == len(moves) + 2
    assert "more than 5 things: of the others 10 sightings are left out" in capfd.readouterr().err


NONSENSE = (
    b'{"t_s":4.0,"base":[0,0,0,0,0,0,0],"q":[]}',
    b'{"t_s":5.0,"base":[1e308,0,1e308,1e308,1e308,0,0],"q":[1e308]}',
    b'{"t_s":6.0,"base":[0,0,0,1,0,0,0],"q":[0],"people":{"a\\u0000\\u001b[31m/../b":[0,0,0,0,0,0,0]}}',
    b'{"t_s":1e300,"base":[0,0,0,1,0,0,0],"q":[0]}',
)


@pytest.mark.parametrize("kind", ["mcap", "csv", "parquet"])
def test_movements_of_strangers_break_nothing(run, tmp_path, kind):
    folder, moves = run
    with (folder / motion.FILE).open("ab") as file:
        file.writelines(line + b"\n" for line in NONSENSE)
    with (folder / journal.FILE).open("ab") as file:
        file.write(b'{"n":3,"t_s":9e8,"event":"x","deep":' + b"[" * 90 + b"]" * 90 + b"}\n")
        file.write(b'{"n":4,"t_s":9e8,"event":"x","n2":' + b"9" * 400 + b"}\n")
    (folder / journal.WALL_FILE).write_bytes(b'{"n":0,"wall_s":1e300}\n')
    path = tmp_path / "out"
    assert dump(Asked(run=str(folder), kind=kind, output=path)) == 0
    if kind == "mcap":
        assert len(_messages(path)[0]["/joint_states"]) == len(moves) + 3


@pytest.mark.parametrize(
    ("wish", "says"),
    [
        ({"kind": "mcap", "t_s": 1.0}, "writes a whole run"),
        ({"kind": "csv", "output": "-"}, "writes a whole run"),
        ({"kind": "parquets"}, "parquet"),
    ],
)
def test_what_makes_no_sense_is_refused(run, wish, says):
    with pytest.raises(ConfigError, match=says):
        dump(Asked(run=str(run[0]), **wish))


def test_what_is_not_installed_is_named_with_its_cure(run, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    with pytest.raises(ConfigError, match=r"humanoid-executive\[mcap\]"):
        dump(Asked(run=str(run[0]), kind="mcap"))


def test_a_runs_records_are_not_written_over(run):
    folder, _ = run
    with pytest.raises(ConfigError, match="is read by this very command"):
        dump(Asked(run=str(folder), kind="mcap", output=folder / "journal.jsonl"))
