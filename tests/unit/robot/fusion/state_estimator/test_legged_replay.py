"""Recordings of legged robots: read in the forms they come in, refused with the field's name."""

import io
import math
import zipfile
from pathlib import Path

import numpy as np
import pytest

from robot.errors import ConfigError
from robot.fusion.state_estimator import legged_body, legged_log, replay, urdf_chains
from robot.se3 import SE3, rotation_vector
from tests.fakes import legged_logs

RECORDING = Path(__file__).resolve().parents[6] / "shared" / "recordings" / "legged"


@pytest.fixture(scope="module")
def chains(tmp_path_factory):
    return urdf_chains.load(legged_logs.urdf_file(tmp_path_factory.mktemp("urdf")))


def track(tmp_path, chains, fields, **options):
    log = legged_log.load(legged_logs.write(tmp_path, fields))
    body = legged_body.find(chains, log, **options)
    return log, body, replay.estimate(log, body)


def moved(trajectory):
    """How far it strayed from where it began: [m], [rad]."""
    way = np.linalg.norm(trajectory.positions - trajectory.positions[0], axis=1).max()
    turn = rotation_vector(trajectory.rotations[0].T @ trajectory.rotations[-1])
    return float(way), float(np.linalg.norm(turn))


def shuffled(fields):
    order = np.random.default_rng(2).permutation(len(fields["joint_names"]))
    return {
        "joint_names": fields["joint_names"][order],
        "joint_pos": fields["joint_pos"][:, order],
    }


def with_gaps(fields):
    changed = {name: fields[name].copy() for name in ("t", "joint_pos", "imu_gyro", "r_foot_fz")}
    changed["t"][40] = np.nan
    changed["joint_pos"][100:120, 3] = np.nan
    changed["imu_gyro"][200:203] = np.inf
    changed["r_foot_fz"][300:320] = np.nan
    return changed


VARIANTS = {
    "as it is": lambda _f: {},
    "joints in another order": shuffled,
    "names as bytes": lambda f: {"joint_names": f["joint_names"].astype("S")},
    "gaps": with_gaps,
    "wrenches": lambda f: {"l_foot_fz": np.outer(f["l_foot_fz"], [0, 0, 1, 0, 0, 0])},
    "forces on the floor": lambda f: {k: -f[k] for k in ("l_foot_fz", "r_foot_fz")},
    "gravity for the push against it": lambda f: {"imu_acc": -f["imu_acc"]},
    "single precision": lambda f: {k: f[k].astype(np.float32) for k in ("joint_pos", "imu_acc")},
    "stamps of another day": lambda f: {"t": f["t"] + 1.7e9},
}


@pytest.mark.parametrize("variant", VARIANTS)
def test_standing_stays_where_it_began(tmp_path, chains, variant):
    fields = legged_logs.standing()
    fields |= VARIANTS[variant](fields)
    log, body, trajectory = track(tmp_path, chains, fields)
    assert len(trajectory.positions) == len(log) == 600
    way_m, turn_rad = moved(trajectory)
    assert way_m < 0.003
    assert turn_rad < math.radians(0.2)
    bias = body.R_BI @ trajectory.gyro_bias_rad_s
    assert bias == pytest.approx(legged_logs.BIAS_RAD_S, abs=math.radians(0.05))


def test_it_begins_where_the_recording_says(tmp_path, chains):
    _, _, trajectory = track(tmp_path, chains, legged_logs.standing(samples=50))
    X = SE3.from_rpy(0.01, -0.02, 2.5, (1.0, 2.0, 0.59))
    assert trajectory.positions[0] == pytest.approx(X.p)
    assert trajectory.rotations[0] == pytest.approx(X.rotation())


def test_samples_that_came_in_bursts_are_put_where_they_were_taken(tmp_path):
    fields = legged_logs.standing()
    even = fields["t"].copy()
    for begin in range(20, 600, 60):
        fields["t"][begin : begin + 15] = even[begin + 15] - 1e-4 * np.arange(15, 0, -1)
    log = legged_log.load(legged_logs.write(tmp_path, fields))
    assert log.bursts
    assert np.abs(log.taken_s - even).max() < 0.002
    assert log.t == pytest.approx(fields["t"])


def test_even_stamps_are_left_alone(tmp_path):
    fields = legged_logs.standing()
    fields["t"][300:] += 0.5  # half a second was lost
    log = legged_log.load(legged_logs.write(tmp_path, fields))
    assert not log.bursts
    assert log.taken_s == pytest.approx(fields["t"])


@pytest.mark.parametrize("scale", [0.0, 1e-300, 1e-12])
def test_stamps_of_a_clock_that_does_not_tick_are_taken_as_they_are(tmp_path, scale):
    fields = legged_logs.standing(samples=400)
    fields["t"] = np.arange(400) * scale
    fields["t"][50:150] = fields["t"][50]
    taken_s = legged_log.load(legged_logs.write(tmp_path, fields)).taken_s
    assert np.isfinite(taken_s).all() and (np.diff(taken_s) >= 0.0).all()


@pytest.mark.parametrize("window", [1, 2, 3, 7, 8, 30])
def test_the_least_ahead_is_that_of_a_look_at_each(window):
    values = np.random.default_rng(0).random(20)
    found = legged_log._least_ahead(values, window)
    assert found.tolist() == [values[k : k + window + 1].min() for k in range(20)]


def without(name):
    return lambda fields: fields.pop(name)


def put(name, value):
    def change(fields):
        fields[name] = value(fields[name])

    return change


WRONG = {
    "no time": (without("t"), "'t' is missing"),
    "no gyro": (without("imu_gyro"), "'imu_gyro' is missing"),
    "no joint names": (without("joint_names"), "'joint_names' is missing"),
    "no force": (without("r_foot_fz"), "'r_foot_fz' is missing"),
    "too few names": (put("joint_names", lambda v: v[:-1]), "shape"),
    "a name twice": (put("joint_names", lambda v: np.array(["a"] * len(v))), "twice"),
    "rows that differ": (put("imu_acc", lambda v: v[:-1]), "shape"),
    "two axes": (put("imu_acc", lambda v: v[:, :2]), "shape"),
    "texts": (put("imu_gyro", lambda v: v.astype(str)), "real numbers"),
    "no number at all": (put("imu_gyro", lambda v: v * np.nan), "without any number"),
    "one sample": (put("t", lambda v: v[:1]), "fewer than two"),
    "objects": (put("t", lambda v: v.astype(object)), "broken"),
    "lying": (put("imu_acc", lambda v: v[:, [2, 1, 0]]), "--imu"),
    "a joint far round": (put("joint_pos", lambda v: v + 1e300), "beyond 10000"),
    "a gyro gone mad": (put("imu_gyro", lambda v: v + 1e200), "beyond 10000"),
    "no first pose": (
        lambda f: f.update(gt_base_pos0=np.zeros((0, 3)), gt_base_rpy0=np.zeros(3)),
        "three numbers",
    ),
    "a first pose of texts": (
        lambda f: f.update(gt_base_pos0=np.zeros(3), gt_base_rpy0=np.array(list("abc"))),
        "real",
    ),
    "what is no letter": (
        put("joint_names", lambda v: np.full(len(v), 0x7FFFFFFF, "<u4").view("<U1")),
        "broken",
    ),
    "other joints": (put("joint_names", lambda v: np.char.add(v, "_x")), "--feet"),
}


@pytest.mark.parametrize("kind", WRONG)
def test_what_cannot_be_used_is_refused_with_its_name(tmp_path, chains, kind):
    change, says = WRONG[kind]
    fields = legged_logs.standing(samples=40)
    change(fields)
    with pytest.raises(ConfigError, match=says):
        track(tmp_path, chains, fields)


def test_a_header_may_not_claim_more_than_there_is(tmp_path):
    stream = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": (10**12,)}
    np.lib.format.write_array_header_1_0(stream, header)
    path = tmp_path / "log.npz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("t.npy", stream.getvalue())
    with pytest.raises(ConfigError, match="more than 5000000 rows"):
        legged_log.load(path)


URDFS = {
    "<robot": "no XML",
    "<sdf/>": "no <robot>|describes no",
    "<robot/>": "0 trees",
    "<robot><link name='a'/><link name='b'/></robot>": "2 trees",
    "<!DOCTYPE robot [<!ENTITY a 'b'>]><robot/>": "document type",
    "<robot><link name='a'/><link name='b'/><joint name='j' type='ball'><parent link='a'/>"
    "<child link='b'/></joint></robot>": "ball",
    "<robot><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/>"
    "<child link='b'/><axis xyz='0 nan 0'/></joint></robot>": "3 numbers",
    "<robot><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='b'/>"
    "<child link='a'/></joint><joint name='k' type='fixed'><parent link='a'/><child link='b'/>"
    "</joint></robot>": "0 trees",
    "<robot><link name='o'/><link name='a'/><link name='b'/><joint name='j' type='fixed'>"
    "<parent link='b'/><child link='a'/></joint><joint name='k' type='fixed'><parent link='a'/>"
    "<child link='b'/></joint></robot>": "a ring",
    "<robot><link name='a'><inertial><mass value='-1'/></inertial></link></robot>": "below zero",
    "<robot><link name='a'><inertial><mass value='nan'/></inertial></link></robot>": "a number",
    **{
        "<robot><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/>"
        f"<child link='b'/>{what}</joint></robot>": "number"
        for what in (
            "<mimic joint='j' multiplier='nan'/>",
            "<mimic joint='j' multiplier='1e308'/>",
            "<mimic joint='j' offset='inf'/>",
            "<origin xyz='0 0 1e308'/>",
            "<origin rpy='0 1e9 0'/>",
            "<axis xyz='0 0 1e200'/>",
        )
    },
}


@pytest.mark.parametrize("text", URDFS)
def test_a_urdf_that_is_none_is_refused(tmp_path, text):
    path = tmp_path / "robot.urdf"
    path.write_text(text)
    with pytest.raises(ConfigError, match=URDFS[text]):
        urdf_chains.load(path)


def chain(links: int) -> str:
    joints = "".join(
        f"<joint name='j{n}' type='fixed'><parent link='l{n}'/><child link='l{n + 1}'/></joint>"
        for n in range(links - 1)
    )
    return "<robot>" + "".join(f"<link name='l{n}'/>" for n in range(links)) + joints + "</robot>"


def test_a_chain_that_no_robot_has_is_refused_before_it_is_followed(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(chain(urdf_chains.MOST_DEEP + 1))
    assert urdf_chains.load(path).links
    path.write_text(chain(urdf_chains.MOST_DEEP + 2))
    with pytest.raises(ConfigError, match="hangs on more than"):
        urdf_chains.load(path)
    path.write_text("<robot>" + "<link name='a'/>" * 9 + chain(urdf_chains.MOST_LINKS + 1)[7:])
    with pytest.raises(ConfigError, match="more than 2000 links"):
        urdf_chains.load(path)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp037"])
def test_no_encoding_hides_a_document_type(tmp_path, encoding):
    path = tmp_path / "robot.urdf"
    text = f"<?xml version='1.0' encoding='{encoding}'?><!DOCTYPE robot [<!ENTITY a 'b'>]>"
    path.write_bytes((text + "<robot><link name='&a;'/></robot>").encode(encoding))
    with pytest.raises(ConfigError, match=r"UTF-8|XML|document type"):
        urdf_chains.load(path)
    path.write_text("<?xml version='1.0' encoding='utf-7'?>+ADw-robot><link name='a'/></robot>")
    with pytest.raises(ConfigError, match="no XML"):
        urdf_chains.load(path)


def test_soles_and_imu_may_be_told(tmp_path, chains):
    fields = legged_logs.standing(samples=60)
    soles = ("left_foot", "right_foot")
    _, body, _ = track(tmp_path, chains, fields, soles=soles, imu="pelvis")
    assert body.soles == soles
    assert body.imu == "pelvis"
    with pytest.raises(ConfigError, match="nowhere"):
        track(tmp_path, chains, fields, soles=("nowhere", "right_foot"))


def test_links_are_where_the_model_has_them(chains):
    """The URDF's own kinematics against MuJoCo's, in random postures."""
    from robot.kinematics.dynamics import Dynamics
    from robot.model import description
    from robot.model.body import SIDES, BodyModel

    body = BodyModel(description.load())
    dynamics, rng = Dynamics(body), np.random.default_rng(0)
    joints = [motor.joint for motor in body.description.motors.values()]
    for _ in range(5):
        q = rng.uniform(body.lower_rad, body.upper_rad)
        body.write_base(dynamics.data, SE3())
        body.write_joints(dynamics.data, q)
        dynamics.kinematics()
        readings = {name: np.array([value]) for name, value in zip(joints, q, strict=True)}
        for k, side in enumerate(SIDES):
            rotations, positions = chains.poses(f"{side}_sole_frame", readings)
            assert positions[0] == pytest.approx(dynamics.sole_position[k], abs=1e-6)
            assert rotations[0] == pytest.approx(dynamics.sole_rotation[k], abs=1e-6)


@pytest.mark.skipif(not RECORDING.is_dir(), reason="needs the recording of a real humanoid")
@pytest.mark.parametrize("causal", [True, False])
def test_a_real_humanoid_sways_where_motion_capture_saw_it(causal):
    chains = urdf_chains.load(RECORDING / "model.urdf")
    path = RECORDING / "com-sinusoid.npz"
    log = legged_log.load(path)
    trajectory = replay.estimate(log, legged_body.find(chains, log), causal=causal)
    with np.load(path) as truth:
        places, angles = truth["gt_base_pos"], truth["gt_base_rpy"]
    off_m = np.linalg.norm(trajectory.positions - places, axis=1)
    rotations = [SE3.from_rpy(*rpy, (0.0, 0.0, 0.0)).rotation() for rpy in angles]
    turns = [
        np.linalg.norm(rotation_vector(R @ true.T))
        for R, true in zip(trajectory.rotations, rotations, strict=True)
    ]
    assert np.sqrt(np.mean(off_m**2)) < 0.003
    assert math.degrees(np.sqrt(np.mean(np.square(turns)))) < 0.4
