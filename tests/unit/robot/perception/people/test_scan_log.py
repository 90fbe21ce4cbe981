"""Logs of scans are read in two layouts, and what is no log is refused in a sentence."""

import io
import zipfile

import numpy as np
import pytest

from robot.errors import ConfigError
from robot.files.archives import Archive
from robot.perception.people.scan_log import read_scans


def first(**changes):
    """A log of three scans of 100 beams in millimetres."""
    arrays = {
        "scan_t": np.array([0.0, 0.1, 0.2]),
        "scan_ranges_mm": np.full((3, 100), 1500, dtype=np.uint16),
        "scan_angle": np.array([-0.5, 0.01]),
    }
    return {**arrays, **changes}


@pytest.fixture
def log(tmp_path):
    def write(**arrays):
        path = tmp_path / "log.npz"
        np.savez(path, **{name: value for name, value in arrays.items() if value is not None})
        return path

    return write


def test_the_first_layout_with_and_without_its_prefix(log):
    for prefix in ("", "training_"):
        scans = read_scans(log(**{prefix + name: value for name, value in first().items()}))
        assert [scan.t_s for scan in scans] == [0.0, 0.1, 0.2]
        assert scans[0].ranges_m[0] == 1.5
        assert scans[0].bearings_rad[:2] == pytest.approx([-0.5, -0.49])


def test_the_second_layout_has_a_moving_laser(log):
    ranges_cm = np.array([[100, 8100, 9000], [120, 130, 140]])
    odom = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 0.5]])
    both = {"t": np.array([5.0, 4.9]), "angle_min": -1.0, "angle_inc": 0.1}
    scans = read_scans(log(ranges_cm=ranges_cm, odom=odom, **both))
    assert scans[1].pose == (1.0, 2.0, 0.5)
    assert scans[0].returned.tolist() == [0]
    assert scans[1].ranges_m == pytest.approx([1.2, 1.3, 1.4])


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"scan_t": None}, "this is no log of scans"),
        ({"scan_angle": None}, "it holds no scan_angle"),
        ({"scan_t": np.array([0.0, 0.1])}, "3 scans, and stamps of 2"),
        ({"scan_t": np.array([0.0, np.nan, 0.2])}, "not finite"),
        ({"scan_angle": np.array([0.0, 0.0])}, "step between the beams"),
        ({"scan_angle": np.array([0.0, 1.0])}, "step between the beams"),
        ({"scan_angle": np.array([np.nan, 0.01])}, "angles are not two finite"),
        ({"scan_angle": np.array([0.1])}, r"shape \(2\), not"),
        ({"scan_ranges_mm": np.zeros(3)}, r"shape \(n, n\), not"),
        ({"scan_ranges_mm": np.array([["a"], ["b"], ["c"]])}, "real numbers"),
        ({"scan_ranges_mm": np.zeros((3, 4), dtype=complex)}, "real numbers"),
    ],
)
def test_what_is_wrong_is_said(log, changes, says):
    with pytest.raises(ConfigError, match=says):
        read_scans(log(**first(**changes)))


def test_objects_are_never_unpickled(log):
    with pytest.raises(ConfigError, match="scan_t in it is broken"):
        read_scans(log(**first(scan_t=np.array([{}, {}, {}], dtype=object))))


def test_a_header_that_promises_the_world_costs_nothing(tmp_path):
    header = io.BytesIO()
    shape = {"descr": "<f8", "fortran_order": False, "shape": (10**6, 10**6)}
    np.lib.format.write_array_header_1_0(header, shape)
    path = tmp_path / "huge.npz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("scan_t.npy", header.getvalue())
    with pytest.raises(ConfigError, match="scan_t makes it larger than"):
        Archive(path).numbers("scan_t", shape=(None, None))


def test_truncated_and_missing_files_are_refused(log, tmp_path):
    path = log(**first())
    path.write_bytes(path.read_bytes()[:-40])
    with pytest.raises(ConfigError, match="no NumPy archive"):
        read_scans(path)
    with pytest.raises(ConfigError, match="No such file"):
        read_scans(tmp_path / "none.npz")
    with pytest.raises(ConfigError):
        read_scans(tmp_path)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"scan_t": np.arange(3) * 1e300}, "no time"),
        ({"scan_ranges_mm": np.zeros((3, 0))}, "have 0 beams"),
        ({"scan_angle": np.array([1e300, 0.01])}, "angles are not"),
    ],
)
def test_numbers_that_no_laser_gives_are_refused(log, changes, says):
    with pytest.raises(ConfigError, match=says):
        read_scans(log(**first(**changes)))


def test_ranges_that_no_laser_sees_are_no_returns(log):
    ranges = np.full((3, 100), 1e300)
    ranges[:, 50] = 1500.0
    assert read_scans(log(**first(scan_ranges_mm=ranges)))[0].returned.tolist() == [50]


def test_a_log_takes_no_more_room_than_it_is_stored_in(log):
    scans = read_scans(log(**first()))
    assert scans.ranges.dtype == np.uint16
    assert scans[1].ranges_m.dtype == np.float64
