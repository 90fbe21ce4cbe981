"""What an MJCF draws in stays inside the robot's folder, and is made of ordinary files."""

import os
import struct
from pathlib import Path

import pytest

from robot.errors import DescriptionError
from robot.model import mjcf, mjcf_files

TRIANGLES = [((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)),
             ((0, 0, 0), (0, 1, 0), (0, 0, 1)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))]  # fmt: skip
STL = bytes(80) + struct.pack("<I", 4) + b"".join(
    struct.pack("<12fH", 0, 0, 0, *(x for corner in one for x in corner), 0) for one in TRIANGLES
)  # fmt: skip
PLAIN = "<mujoco><worldbody><body name='b'><geom size='1'/></body></worldbody></mujoco>"


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """A folder with a mesh in it, and a file that is nobody's business beside it."""
    folder = tmp_path / "robot"
    (folder / "meshes").mkdir(parents=True)
    (folder / "meshes" / "m.stl").write_bytes(STL)
    (folder / "part.xml").write_text(PLAIN)
    (tmp_path / "secret.stl").write_bytes(STL)
    (tmp_path / "secret.xml").write_text(PLAIN)
    os.mkfifo(folder / "pipe.stl")
    os.mkfifo(folder / "pipe.xml")
    (folder / "zero.png").symlink_to("/dev/zero")
    (folder / "folders.xml").write_text("<mujocoinclude><compiler meshdir='..'/></mujocoinclude>")
    (folder / "deep" / "deeper" / "deepest").mkdir(parents=True)
    (folder / "deep" / "secret.stl").write_bytes(STL)
    (folder / "link").symlink_to(folder / "deep" / "deeper" / "deepest")
    (folder / "out.stl").symlink_to(tmp_path / "secret.stl")
    return folder


def source(robot: Path, text: str) -> mjcf.Source:
    (robot / "robot.xml").write_text(text)
    return mjcf.Source(str(robot / "robot.xml"), str(robot))


def with_asset(asset: str, compiler: str = "") -> str:
    return (
        f"<mujoco>{compiler}<asset>{asset}</asset><worldbody><geom size='1'/></worldbody></mujoco>"
    )


@pytest.mark.parametrize(
    "text",
    [
        with_asset("<mesh file='meshes/m.stl'/>"),
        with_asset("<mesh file='m.stl'/>", "<compiler meshdir='meshes'/>"),
        with_asset("<mesh file='../robot/meshes/m.stl'/>"),
        "<mujoco><include file='part.xml'/></mujoco>",
    ],
)
def test_what_lies_in_the_folder_is_drawn_in(robot, text):
    assert mjcf.spec(source(robot, text)).compile().ngeom == 1


OUTSIDE = [
    with_asset("<mesh file='../secret.stl'/>"),
    with_asset("<mesh file='secret.stl'/>", "<compiler meshdir='..'/>"),
    with_asset("<mesh file='out.stl'/>"),
    with_asset("<mesh file='{root}/secret.stl'/>"),
    with_asset("<texture type='2d' file='/dev/zero'/>"),
    with_asset("<texture type='cube' fileright='/dev/zero' fileleft='/dev/zero'/>"),
    with_asset("<hfield size='1 1 1 1' file='/dev/zero'/>"),
    with_asset("<model name='m' file='../secret.xml'/>"),
    with_asset("<mesh file='/a/b/../secret.stl'/>", "<compiler meshdir='..' strippath='true'/>"),
    "<mujoco><include file='/etc/passwd'/></mujoco>",
    "<mujoco><include file='../secret.xml'/></mujoco>",
    "<mujoco><include file='../nowhere.xml'/></mujoco>",
    with_asset(r"<mesh file='..\secret.stl'/>"),
    with_asset("<mesh file='secret.stl'/>", r"<compiler meshdir='..\'/>"),
    with_asset("<mesh file='secret.stl'/>", r"<compiler assetdir='meshes\..\..'/>"),
    with_asset("<mesh file='link/../../secret.stl'/>"),
    with_asset("<mesh file='meshes/m.stl'/>", "<compiler texturedir='/etc'/>"),
    with_asset("<mesh file='nowhere.stl'/>", "<compiler meshdir='../nowhere'/>"),
    r"<mujoco><include file='..\secret.xml'/></mujoco>",
    with_asset("<mesh file='secret.stl'/>", "<include file='folders.xml'/>"),
]
NONE = [
    with_asset("<mesh file='pipe.stl'/>"),
    with_asset("<texture type='2d' file='zero.png'/>"),
    "<mujoco><include file='pipe.xml'/></mujoco>",
]


@pytest.mark.parametrize("text", OUTSIDE)
def test_what_leads_out_of_the_folder_is_refused(robot, text):
    with pytest.raises(DescriptionError, match="outside"):
        mjcf.spec(source(robot, text.replace("{root}", str(robot.parent))))


@pytest.mark.parametrize("text", NONE)
def test_what_is_no_ordinary_file_is_refused(robot, text):
    with pytest.raises(DescriptionError, match=r"no ordinary file|outside"):
        mjcf.spec(source(robot, text))


@pytest.mark.parametrize("text", [*OUTSIDE, *NONE])
def test_nor_does_an_include_lead_out(robot, text):
    text = text.replace("{root}", str(robot.parent))
    (robot / "inner.xml").write_text(text)
    with pytest.raises(DescriptionError):
        mjcf.spec(source(robot, "<mujoco><include file='inner.xml'/></mujoco>"))


@pytest.mark.parametrize("text", [*OUTSIDE, *NONE])
def test_nor_does_an_overlay(robot, text):
    (robot / "overlay.xml").write_text(text.replace("{root}", str(robot.parent)))
    laid = source(robot, PLAIN)
    laid = mjcf.Source(laid.path, laid.folder, str(robot / "overlay.xml"), str(robot))
    with pytest.raises(DescriptionError):
        mjcf.spec(laid)


def test_files_that_include_one_another_come_to_an_end(robot):
    loop = "<mujoco><include file='robot.xml'/></mujoco>"
    with pytest.raises(DescriptionError):
        mjcf.spec(source(robot, loop))


@pytest.mark.parametrize("path", ["pipe.xml", "zero.png", "missing.xml", "meshes"])
def test_a_model_that_is_no_file_is_refused(robot, path):
    with pytest.raises(DescriptionError):
        mjcf.spec(mjcf.Source(str(robot / path), str(robot)))


def test_a_model_elsewhere_is_refused(robot):
    with pytest.raises(DescriptionError, match="outside"):
        mjcf.spec(mjcf.Source(str(robot / ".." / "secret.xml"), str(robot)))


def test_a_document_type_is_refused(robot):
    entity = "<!DOCTYPE mujoco [<!ENTITY x '/dev/zero'>]>"
    with pytest.raises(DescriptionError, match="document type"):
        mjcf.spec(source(robot, entity + with_asset("<mesh file='&x;'/>")))


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_no_encoding_hides_a_document_type(robot, encoding):
    path = robot / "hidden.xml"
    path.write_bytes("<!DOCTYPE mujoco [<!ENTITY x 'y'>]><mujoco/>".encode(encoding))
    with pytest.raises(mjcf_files.ET.ParseError, match="XML forbids"):
        mjcf_files.read(path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<mujoco><include xmlns='a' file='part.xml'/></mujoco>", "name space"),
        (with_asset("<mesh file='meshes\n/m.stl'/>"), "line break"),
        ("<robot name='r'><mesh filename='package:///etc/passwd'/></robot>", "URDF"),
    ],
)
def test_what_mujoco_would_read_otherwise_is_refused(robot, text, words):
    with pytest.raises(DescriptionError, match=words):
        mjcf.spec(source(robot, text))


def test_only_the_encoding_that_mujoco_reads_is_read(robot):
    (robot / "robot.xml").write_bytes(PLAIN.encode("utf-16"))
    with pytest.raises(DescriptionError, match="utf-8"):
        mjcf.spec(mjcf.Source(str(robot / "robot.xml"), str(robot)))


def test_an_overlay_draws_nothing_in_from_where_we_happen_to_stand(robot, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "elsewhere.stl").write_bytes(STL)
    (robot / "overlay.xml").write_text("<mujoco><compiler meshdir='meshes'/></mujoco>")
    text = with_asset("<mesh file='elsewhere.stl'/>", "<compiler/>")
    laid = source(robot, text)
    laid = mjcf.Source(laid.path, laid.folder, str(robot / "overlay.xml"), str(robot))
    with pytest.raises(DescriptionError, match=r"robot/meshes/elsewhere\.stl"):
        mjcf.compiled(laid)


def test_too_many_folders_are_refused(robot):
    compilers = "".join(f"<compiler meshdir='{i}'/>" for i in range(50))
    with pytest.raises(DescriptionError, match="folders"):
        mjcf.spec(source(robot, with_asset("<mesh file='meshes/m.stl'/>", compilers)))


def test_more_than_a_bound_is_refused(robot, monkeypatch):
    monkeypatch.setattr(mjcf_files, "MAX_DRAWN_IN_BYTES", len(STL) - 1)
    with pytest.raises(DescriptionError, match="more than"):
        mjcf.spec(source(robot, with_asset("<mesh file='meshes/m.stl'/>")))
