"""Archives of strangers: what an array takes is looked at before there is room for it."""

import io
import zipfile

import numpy as np
import pytest

from robot.errors import ConfigError
from robot.files import archives
from robot.files.archives import Archive


def entry(array) -> bytes:
    stream = io.BytesIO()
    np.lib.format.write_array(stream, np.asarray(array))
    return stream.getvalue()


def made(path, packing=zipfile.ZIP_DEFLATED, **entries):
    with zipfile.ZipFile(path, "w", packing) as archive:
        for name, data in entries.items():
            archive.writestr(f"{name}.npy", data if isinstance(data, bytes) else entry(data))
    return path


@pytest.fixture
def path(tmp_path):
    return tmp_path / "some.npz"


def test_what_is_packed_comes_out_again(path):
    arrays = {"a": np.arange(6.0).reshape(2, 3), "b": np.array(["x", "y\u20ac"])}
    path.write_bytes(archives.packed(arrays))
    found = Archive(path).arrays(dict.fromkeys(arrays, True), what="anything")
    assert all(np.array_equal(found[name], arrays[name]) for name in arrays)


def test_columns_stay_columns_and_wide_numbers_become_infinite(path):
    columns = np.asfortranarray(np.arange(6).reshape(2, 3))
    archive = Archive(made(path, a=columns, b=np.full(3, np.longdouble("1e4000"))))
    assert archive.numbers("a", shape=(None, 3)).tolist() == [[0, 1, 2], [3, 4, 5]]
    assert np.isinf(archive.numbers("b", shape=(3,))).all()


def test_numbers_are_counted_as_they_are_handed_out_and_together(path):
    made(path, a=np.zeros(100, np.uint8), b=np.zeros(100, np.uint8))
    archive = Archive(path, limit=1000)
    archive.array("a")
    archive.numbers("b", shape=(None,))
    with pytest.raises(ConfigError, match="larger than"):
        archive.numbers("a", shape=(None,))
    with pytest.raises(ConfigError, match="larger than"):
        Archive(path, limit=799).numbers("a", shape=(None,))


def test_the_shape_is_looked_at_before_a_byte_of_it(path):
    header = io.BytesIO()
    claim = {"descr": "|u1", "fortran_order": False, "shape": (10, 9_000_000)}
    np.lib.format.write_array_header_1_0(header, claim)
    archive = Archive(made(path, a=header.getvalue()), limit=10**9)
    with pytest.raises(ConfigError, match=r"shape \(n, 3\), not uint8 in the shape"):
        archive.numbers("a", shape=(None, 3))
    with pytest.raises(ConfigError, match="broken"):
        archive.array("a")


@pytest.mark.parametrize("packing", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_other_packings_than_numpys_are_refused(path, packing):
    with pytest.raises(ConfigError, match="savez"):
        Archive(made(path, packing, a=np.zeros(3))).array("a")


@pytest.mark.parametrize("order", "<>")
def test_text_that_is_none_is_refused(path, order):
    points = np.full(2, 0x110000, f"{order}u4")
    archive = Archive(made(path, bad=points.view(f"{order}U1"), good=np.array(["a"], f"{order}U3")))
    assert archive.array("good").tolist() == ["a"]
    with pytest.raises(ConfigError, match="bad in it is broken"):
        archive.array("bad")


def test_a_table_of_contents_that_is_too_long_is_not_read(path, monkeypatch):
    made(path, **{f"entry{number}": b"" for number in range(100)})
    assert len(Archive(path).names) == 100
    monkeypatch.setattr(archives, "_MOST_DIRECTORY", 1000)
    with monkeypatch.context() as patched, pytest.raises(ConfigError, match="no NumPy archive"):
        patched.setattr(zipfile, "ZipFile", None)  # it would take all of it
        Archive(path)


def test_an_end_of_64_bits_is_not_followed(path):
    data = made(path, a=np.zeros(3)).read_bytes()
    path.write_bytes(data[:-22] + b"PK\6\7" + bytes(16) + data[-22:])
    with pytest.raises(ConfigError, match="no NumPy archive"):
        Archive(path)
