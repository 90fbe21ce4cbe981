"""A robot's MJCF: one file, or a published one with an overlay of our own laid over it.

An overlay is MJCF as well. Its bodies, wherever they stand in its tree, mean those of the same name
in the published model: what stands in them is added there; a joint or a geom whose name is there
already, an `inertial`, `option`, `compiler` and `default` lend it their attributes instead. Bodies
of new names, and whatever stands in other sections, are added as they are.
"""

from __future__ import annotations

import ctypes
from pathlib import Path
from xml.etree import ElementTree as ET

import msgspec
import mujoco

from robot.errors import DescriptionError, Problem
from robot.files.ordinary_files import read_ordinary
from robot.model import mjcf_files
from robot.model.mjcf_files import MAX_XML_BYTES


def _unwritten(_text: str) -> None:
    """Hear a warning of MuJoCo: what it is about shows in the numbers, and is looked for there."""


# Unheard, it goes into MUJOCO_LOG.TXT of the current folder, and through a link that a stranger
# left there into any file of this user's.
mujoco.set_mju_user_warning(_unwritten)

MOST_KEPT_BYTES = 160_000_000
"""Of meshes as they were compiled, which MuJoCo keeps: the G1's take 151 MB, and its next model is
compiled in 0.2 s in place of 1.3 s. By itself MuJoCo would keep 524 MB of robots of before."""
mujoco.mj_setCacheCapacity(mujoco.mj_getCache(), MOST_KEPT_BYTES)

SETTINGS = frozenset({"option", "compiler", "inertial"})
"""Elements that an overlay changes rather than repeats."""


class Source(msgspec.Struct, frozen=True):
    """Where a model comes from: its file, what is laid over it, meshes that are left out.

    `folder` holds the file and all that it draws in; `overlay_folder` the overlay likewise.
    """

    path: str
    folder: str
    overlay: str | None = None
    overlay_folder: str = ""
    without: tuple[str, ...] = ()

    def content(self) -> bytes:
        """What is in the files.

        Raises:
            DescriptionError: one cannot be read, or is too large to be a robot's.
        """
        files = (self.path,) if self.overlay is None else (self.path, self.overlay)
        return b"".join(map(_content, files))


def _content(file: str) -> bytes:
    try:
        return read_ordinary(file, limit=MAX_XML_BYTES)
    except OSError as error:
        raise DescriptionError([Problem(f"cannot be read: {error.strerror}", file)]) from None


def spec(source: Source) -> mujoco.MjSpec:
    """The robot alone, to be compiled or put into a scene.

    Raises:
        DescriptionError: if it cannot be read, or overlay and published model do not fit.
    """
    try:
        if source.overlay is None:
            model = mjcf_files.read(Path(source.path))
            mjcf_files.check(model, Path(source.path), [Path(source.folder)])
            return mujoco.MjSpec.from_file(source.path)
        return mujoco.MjSpec.from_string(_laid_over(source, Path(source.overlay)))
    except (ValueError, ET.ParseError) as error:
        raise DescriptionError([_broken(source, error)]) from None
    except OSError as error:
        text = f"the MJCF cannot be read: {error.strerror}"
        raise DescriptionError([Problem(text, str(error.filename or source.path))]) from None


def compiled(source: Source) -> mujoco.MjModel:
    """The robot alone. Raises DescriptionError as `spec` does."""
    try:
        model = spec(source).compile()
    except ValueError as error:
        raise DescriptionError([_broken(source, error)]) from None
    if model.nmesh:
        _give_back()
    return model


def _give_back() -> None:
    """Return what compiling took to the system: of the G1's meshes glibc keeps 120 MB otherwise."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # no other C library has it
    if trim is not None:
        trim(0)


def _broken(source: Source, error: Exception) -> Problem:
    return Problem(f"the MJCF does not compile: {error}", source.overlay or source.path)


def _laid_over(source: Source, overlay_path: Path) -> str:
    """The published model with the overlay, as MJCF; meshes by their full path."""
    base, overlay = mjcf_files.read(Path(source.path)), mjcf_files.read(overlay_path)
    _full_paths(base, Path(source.path).resolve().parent)
    for compiler in overlay.iter("compiler"):
        _full_folders(compiler, overlay_path.resolve().parent)
    for root, file in ((base, source.path), (overlay, source.overlay)):
        _draws_in_no_model(root, str(file))
    _robot_alone(base)
    _leave_out(base, source.without)
    bodies = {body.get("name"): body for body in base.iter("body")}
    for section in overlay:
        own = base.find(section.tag)
        if own is None:
            base.append(section)
        elif section.tag in SETTINGS:
            own.attrib.update(section.attrib)
        elif section.tag == "default":
            _defaults(own, section)
        elif section.tag == "worldbody":
            _bodies(own, section, bodies)
        else:
            own.extend(section)
    folders = [Path(source.folder), Path(source.overlay_folder)]
    mjcf_files.check(base, Path(source.path), folders)
    mjcf_files.check(base, overlay_path, folders)
    return ET.tostring(base, encoding="unicode")


def _full_paths(base: ET.Element, folder: Path) -> None:
    if base.find("compiler") is None:
        ET.SubElement(base, "compiler")
    for compiler in base.iter("compiler"):
        _full_folders(compiler, folder)
        for kind in ("meshdir", "texturedir"):  # without one MuJoCo looks where we happen to stand
            compiler.set(kind, compiler.get(kind) or compiler.get("assetdir") or str(folder))


def _full_folders(compiler: ET.Element, folder: Path) -> None:
    for kind in mjcf_files.FOLDER_KEYS:
        if kind in compiler.attrib:
            compiler.set(kind, str(folder / compiler.get(kind, "")))


def _draws_in_no_model(root: ET.Element, file: str) -> None:
    """MuJoCo would look for it where we happen to stand: a text has no folder of its own."""
    for tag in ("include", "model"):
        if root.find(f".//{tag}") is not None:
            text = f"<{tag}> has no place in an overlay, or under one"
            raise DescriptionError([Problem(text, file, suggestion="put its content there")])


def _robot_alone(base: ET.Element) -> None:
    """Without keyframes, which an added joint makes too short, and without light of its own."""
    for keyframe in base.findall("keyframe"):
        base.remove(keyframe)
    for world in base.findall("worldbody"):
        for light in world.findall("light"):
            world.remove(light)


def _leave_out(base: ET.Element, meshes: tuple[str, ...]) -> None:
    for body in base.iter("body"):
        for geom in [geom for geom in body.findall("geom") if geom.get("mesh") in meshes]:
            body.remove(geom)


def _defaults(own: ET.Element, added: ET.Element) -> None:
    """Attributes for classes that are there, and classes that are not."""
    classes = {one.get("class"): one for one in own.iter("default")}
    for child in added:
        there = classes.get(child.get("class")) if child.tag == "default" else own.find(child.tag)
        if there is None:
            own.append(child)
        elif child.tag == "default":
            _defaults(there, child)
        else:
            there.attrib.update(child.attrib)


def _bodies(own: ET.Element, added: ET.Element, bodies: dict[str | None, ET.Element]) -> None:
    """What stands in a body of the overlay, put into the published one."""
    for child in added:
        name = child.get("name")
        if child.tag == "body" and name in bodies:
            _bodies(bodies[name], child, bodies)
        elif child.tag in SETTINGS:
            there = own.find(child.tag)
            own.append(child) if there is None else there.attrib.update(child.attrib)
        else:
            same = [one for one in own.findall(child.tag) if name and one.get("name") == name]
            for one in same:
                one.attrib.update(child.attrib)
            if not same:
                own.append(child)
