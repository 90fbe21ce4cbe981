"""Logs of sensors, pictures and networks: what is read to learn from it, or to look into it."""

import io
import struct
import zipfile
import zlib
from pathlib import Path

import numpy as np
from PIL import Image

from tests.hostile.cases import OUTSIDE, Case, Expect, Make, fifo, folder, link, sparse
from tests.hostile.corpus.shapes import ESCAPE, NAMES
from tests.hostile.exam import exam

PEOPLE = ("people", "--json", "--log", "l.npz")
SCANS = {
    "scan_t": np.arange(4) * 0.1,
    "scan_ranges_mm": np.full((4, 200), 1500, dtype=np.uint16),
    "scan_angle": np.array([-1.0, 0.01]),
}


def _archive(**changes: object) -> bytes:
    """A sound log with some arrays changed; None leaves one out."""
    data = io.BytesIO()
    arrays = {name: value for name, value in {**SCANS, **changes}.items() if value is not None}
    np.savez(data, **arrays)  # type: ignore[arg-type]
    return data.getvalue()


def _npy(header: str, body: bytes = b"") -> bytes:
    """An archive in which the stamps have this header."""
    padded = header.encode().ljust(118) + b"\n"
    data = io.BytesIO(_archive(scan_t=None))
    with zipfile.ZipFile(data, "a") as archive:
        head = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(padded))
        archive.writestr("scan_t.npy", head + padded + body)
    return data.getvalue()


def _header(shape: str, kind: str = "'<f8'") -> bytes:
    return _npy(f"{{'descr': {kind}, 'fortran_order': False, 'shape': {shape}, }}", bytes(32))


def _bomb(path: Path) -> None:
    """400 MB of zeros, packed."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive, archive.open(
        "scan_t.npy", "w", force_zip64=True
    ) as entry:  # fmt: skip
        for _ in range(400):
            entry.write(bytes(1 << 20))


def _png(width: int, height: int) -> bytes:
    """A picture that promises to be so large."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    body = zlib.compress(bytes(100_000))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def _picture() -> bytes:
    data = io.BytesIO()
    Image.new("L", (64, 48), 200).save(data, "PNG")
    return data.getvalue()


LOGS: dict[str, bytes | Make] = {
    "truncated": _archive()[:-30],
    "first-half": _archive()[:1500],
    "bomb": _bomb,
    "no-scans": _archive(
        scan_t=np.zeros(0), scan_ranges_mm=np.zeros((0, 10)), training_scan_t=None
    ),
    "nan-stamps": _archive(scan_t=np.array([0.0, np.nan, 0.2, 0.3])),
    "no-stamps": _archive(scan_t=np.array([-1e300, 0.0, 1e9, 1e300])),
    "inf-angle": _archive(scan_angle=np.array([np.inf, 0.01])),
    "step-zero": _archive(scan_angle=np.array([0.0, 0.0])),
    "step-minus": _archive(scan_angle=np.array([0.0, -0.01])),
    "objects": _archive(scan_t=np.array([{"a": 1}] * 4, dtype=object)),
    "texts": _archive(scan_ranges_mm=np.array([["a" * 100] * 3] * 4)),
    "complex": _archive(scan_ranges_mm=np.zeros((4, 200), dtype=complex)),
    "three-axes": _archive(scan_ranges_mm=np.zeros((4, 200, 2))),
    "many-beams": _archive(scan_ranges_mm=np.zeros((4, 20_000), dtype=np.uint8)),
    "names": _archive(**{"scan_t": None, f"x{ESCAPE}y": np.zeros(3)}),
    "outside": _archive(**{"scan_t": None, "../../../etc/passwd": np.zeros(3)}),
    "header-huge": _header("(1000000, 1000000, 1000000)"),
    "header-minus": _header("(-1,)"),
    "header-digits": _header("(" + "9" * 90 + ",)"),
    "header-call": _npy("__import__('os').system('touch owned')"),
    "header-pickle": _header("(4,)", "'|O'"),
    "header-deep": _npy("(" * 100),
}  # fmt: skip
SOUND_LOGS: dict[str, bytes] = {
    "nothing-returned": _archive(scan_ranges_mm=np.zeros((4, 200), dtype=np.uint16)),
    "nan-ranges": _archive(scan_ranges_mm=np.full((4, 200), np.nan)),
    "minus-ranges": _archive(scan_ranges_mm=np.full((4, 200), -5.0)),
    "inf-ranges": _archive(scan_ranges_mm=np.full((4, 200), np.inf)),
    "huge-ranges": _archive(scan_ranges_mm=np.full((4, 200), 1e300)),
    "one-beam": _archive(scan_ranges_mm=np.full((4, 1), 1000)),
    "stamps-back": _archive(scan_t=np.array([3.0, 2.0, 1.0, 0.0])),
    "stamps-far": _archive(scan_t=np.array([-1e11, 0.0, 1e9, 1e11])),
    "same-place": _archive(scan_ranges_mm=np.full((4, 200), 51)),
}

CALIBRATE = ("calibrate", "camera", "--json", "--board", "chessboard:9x6:0.025", "--images")
PICTURES: dict[str, str | bytes | Make] = {
    "fifo": fifo, "zeros": link("/dev/zero"), "folder": folder, "dangling": link("nowhere"),
    "outside": link(f"{OUTSIDE}/secret.txt"), "sparse-10-GB": sparse(10 << 30), "empty": b"",
    "text": "no picture", "truncated": _picture()[:60], "bomb": _png(200_000, 200_000),
    "wide": _png(2**31 - 1, 1), "broken": _png(400, 400)[:-40], "none": _png(0, 0),
    "postscript": b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n(touch owned) system\n",
    "svg": '<svg xmlns="http://www.w3.org/2000/svg"><image href="file:///etc/passwd"/></svg>',
}  # fmt: skip
BOARDS = {
    "empty": "", "escape": ESCAPE, "nan": "chessboard:9x6:nan", "huge": "chessboard:99999999x6:1",
    "minus": "chessboard:-9x6:0.02", "attribute": "charuco:5x5:0.04:0.03:__class__",
    "unknown": "charuco:5x5:0.04:0.03:DICT_9X9_9", "few": "charuco:40x40:0.04:0.03:DICT_4X4_50",
    "bidi": f"charuco:5x5:0.04:0.03:{NAMES['bidi']}", "colons": ":" * 10_000,
}  # fmt: skip
HAND_EYE = ("calibrate", "hand-eye", "--json", "--board", "chessboard:9x6:0.025", "--images", "p")
POSES: dict[str, str | bytes | Make] = {
    "empty": "", "fifo": fifo, "zeros": link("/dev/zero"), "binary": bytes(range(256)) * 64,
    "words": f"a {ESCAPE} b\n", "nan": "nan " * 7, "huge": "1e999 " * 7, "many": "0 " * 100_000,
    "names": f"image,x,y,z,qw,qx,qy,qz\n{ESCAPE},0,0,0,1,0,0,0\n", "digits": "9" * 5000,
    "zero-quaternion": "0 0 0 0 0 0 0\n", "short-row": "image,x,y,z,qw,qx,qy,qz\n,\n,\n",
}  # fmt: skip
DETECT = ("detect", "--json", "--labels", "n.txt", "--model", "m.onnx")
NETWORKS: dict[str, str | bytes | Make] = {
    "empty": b"", "text": "no network", "fifo": fifo, "zeros": link("/dev/zero"),
    "folder": folder, "sparse-10-GB": sparse(10 << 30), "binary": bytes(range(256)) * 64,
    "fields": b"\x3a\x00" * 20_000_000, "sparse-950-MB": sparse(950 << 20), "nulls": bytes(4096),
    "sparse-290-MB": sparse(290_000_000), "key": b"\xba\x80\x80\x80\x10\x00",
    "nested": b"".join(b"\x0a" + bytes([size]) for size in range(126, 0, -2)),
    "deep": b"\x3a\xff\xff\xff\xff\x07" + b"\x0a" * 1000,
}  # fmt: skip

CASES = [
    *(
        Case(name=f"log-{name}", argv=PEOPLE, files={"l.npz": content}, says=("l.npz",))
        for name, content in LOGS.items()
    ),
    *(
        Case(name=f"sound-{name}", argv=PEOPLE, files={"l.npz": data}, expect=Expect.ACCEPTED)
        for name, data in SOUND_LOGS.items()
    ),
    *(
        Case(name=f"picture-{name}", argv=(*CALIBRATE, "p"), files={"p/a.png": content})
        for name, content in PICTURES.items()
    ),
    *(
        Case(name=f"pattern-{name}", argv=(*CALIBRATE, pattern), files={"p/a.png": _picture()})
        for name, pattern in {
            "none": "p/b*.png", "brackets": "p/[[[", "empty": "", "nowhere": "q/*.png",
            "outside": f"{OUTSIDE}/tree/*", "nul": "p/" + "?" * 5000, "escape": f"p/{ESCAPE}",
        }.items()
    ),
    *(
        Case(
            name=f"board-{name}",
            argv=("calibrate", "camera", "--board", board, "--images", "p"),
            files={"p/a.png": _picture()},
        )
        for name, board in BOARDS.items()
    ),
    *(
        Case(
            name=f"poses-{name}",
            argv=(*HAND_EYE, "--poses", "h.csv"),
            files={"p/a.png": _picture(), "h.csv": content},
            says=("h.csv",),
        )
        for name, content in POSES.items()
    ),
    Case(
        name="out-taken",
        argv=(*CALIBRATE, "p", "--out", "c.yaml"),
        files={"p/a.png": _picture(), "c.yaml": "mine\n"},
        says=("c.yaml",),
    ),
    *(
        Case(
            name=f"network-{name}",
            argv=(*DETECT, "a.png"),
            files={"a.png": _picture(), "n.txt": "cup\n", "m.onnx": content},
            says=("m.onnx",),
        )
        for name, content in NETWORKS.items()
    ),
    Case(name="network-none", argv=("detect", "a.png"), files={"a.png": _picture()}),
    Case(
        name="network-without-names",
        argv=("detect", "--model", "m.onnx", "a.png"),
        files={"a.png": _picture()},
    ),
]  # fmt: skip
test_recordings = exam("recordings", CASES)
