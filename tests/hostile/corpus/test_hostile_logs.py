"""Logs of sensors, maps and URDFs that mean no good: small ones that grow, numbers of no sensor."""

import io
import zipfile
from functools import partial
from pathlib import Path

import numpy as np

from tests.hostile.cases import Case, Expect, Make, Streams, mode
from tests.hostile.exam import exam

N = 200
NO_LETTER = np.full(1, 0x7FFFFFFF, np.uint32).view("<U1")

Arrays = dict[str, object]
SCANS: Arrays = {
    "scan_t": np.arange(50) * 0.1,
    "scan_ranges_mm": np.full((50, 180), 1500, np.uint16),
    "scan_angle": np.array([-1.5, 0.017]),
}
SWEEPS: Arrays = {
    "odom": np.column_stack([np.arange(30) * 0.1, np.zeros((30, 2))]),
    "ranges_cm": np.random.default_rng(0).integers(300, 340, (30, 90)).astype(np.uint16),
    "angle_min": np.array(-1.5),
    "angle_inc": np.array(0.033),
}
MAP: Arrays = {
    "format": np.array("humanoid map 1"), "cell_m": np.array(0.05), "origin_m": np.zeros(2),
    "grid": np.zeros((20, 20), np.uint8), "trajectory": np.zeros((3, 4)), "keys": np.zeros((2, 3)),
    "surface": np.random.default_rng(0).random((50, 5)), "place_names": np.array(["desk"]),
    "place_poses": np.zeros((1, 3)),
}  # fmt: skip
LEGGED: Arrays = {
    "t": np.arange(N) * 0.002, "joint_names": np.array(["left", "right"]),
    "joint_pos": np.zeros((N, 2)), "imu_gyro": np.zeros((N, 3)),
    "imu_acc": np.tile([0.0, 0.0, 9.81], (N, 1)), "l_foot_fz": np.full(N, 100.0),
    "r_foot_fz": np.full(N, 100.0),
}  # fmt: skip


class Zeros:
    """An array of zeros that a log holds packed, and that is never made here."""

    def __init__(self, *shape: int, kind: str = "|u1", there: bool = True) -> None:
        self.shape, self.kind, self.there = shape, kind, there

    def write(self, archive: zipfile.ZipFile, name: str) -> None:
        head = io.BytesIO()
        claim = {"descr": self.kind, "fortran_order": False, "shape": self.shape}
        np.lib.format.write_array_header_1_0(head, claim)
        size = int(np.prod(self.shape)) * np.dtype(self.kind).itemsize if self.there else 0
        with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
            entry.write(head.getvalue())
            for begin in range(0, size, 1 << 20):
                entry.write(bytes(min(1 << 20, size - begin)))


def _write(arrays: Arrays, packing: int, path: Path) -> None:
    with zipfile.ZipFile(path, "w", packing) as archive:
        for name, array in arrays.items():
            if isinstance(array, Zeros):
                array.write(archive, name)
            else:
                data = io.BytesIO()
                np.lib.format.write_array(data, np.asarray(array))
                archive.writestr(f"{name}.npy", data.getvalue())


def log(sound: Arrays, *, packing: int = zipfile.ZIP_DEFLATED, **changes: object) -> Make:
    """A sound log with some arrays changed."""
    return partial(_write, {**sound, **changes}, packing)


def _spoilt(path: Path) -> None:
    """Packed as LZMA, and then broken."""
    _write(SWEEPS, zipfile.ZIP_LZMA, path)
    data = bytearray(path.read_bytes())
    for at in range(60, 90):
        data[at] ^= 0x5A
    path.write_bytes(data)


def _crowded(path: Path) -> None:
    """A million entries in 50 MB of a table of contents."""
    entry = b"PK\1\2" + bytes(24) + b"\1\0" + bytes(16) + b"a"
    table = entry * 1_000_000
    count, size = (65_535).to_bytes(2, "little"), len(table).to_bytes(4, "little")
    path.write_bytes(table + b"PK\5\6" + bytes(4) + count + count + size + bytes(6))


LEGS = """<robot name="r"><link name="base"><inertial><mass value="10"/></inertial></link>
<link name="left_sole"/><link name="right_sole"/><link name="imu"/>
<joint name="left" type="revolute"><parent link="base"/><child link="left_sole"/>
<origin xyz="0 0.1 -0.8"/><axis xyz="0 1 0"/><!--left--></joint>
<joint name="right" type="revolute"><parent link="base"/><child link="right_sole"/>
<origin xyz="0 -0.1 -0.8"/><axis xyz="0 1 0"/></joint>
<joint name="imu" type="fixed"><parent link="base"/><child link="imu"/></joint></robot>"""
URDFS: dict[str, str] = {
    "ring": LEGS.replace('"base"/><child link="left', '"right_sole"/><child link="left').replace(
        '"base"/><child link="right', '"left_sole"/><child link="right'
    ),
    "mimic-nan": LEGS.replace("<!--left-->", '<mimic joint="right" multiplier="nan"/>'),
    "mimic-huge": LEGS.replace("<!--left-->", '<mimic joint="right" offset="1e308"/>'),
    "mass-nan": LEGS.replace('value="10"', 'value="nan"'),
    "mass-minus": LEGS.replace('value="10"', 'value="-1e308"'),
    "far": LEGS.replace("-0.8", "1e308"),
    "many": f"<robot>{'<a/>' * 6_000_000}</robot>",
    "deep": f"<robot>{'<a>' * 500_000}{'</a>' * 500_000}</robot>",
}

PEOPLE = ("people", "--json", "--log", "l.npz")
BUILD = ("map", "build", "--log", "l.npz", "--trajectory", "t.txt")
SHOW = ("map", "show", "l.npz", "--snapshot", "m.png")
ESTIMATE = (
    "sensors", "estimate", "--log", "l.npz", "--urdf", "r.urdf", "--out", "o.txt",
    "--feet", "left_sole,right_sole", "--imu", "imu",
)  # fmt: skip

REFUSED: dict[str, tuple[tuple[str, ...], Make]] = {
    "people-stamps-far": (PEOPLE, log(SCANS, scan_t=np.arange(50) * 1e300)),
    "people-no-beams": (PEOPLE, log(SCANS, scan_ranges_mm=np.zeros((50, 0)))),
    "people-angle-far": (PEOPLE, log(SCANS, scan_angle=np.array([1e300, 0.017]))),
    "people-too-many": (PEOPLE, log(SCANS, scan_ranges_mm=Zeros(40_000, 9_999))),
    "people-crowded": (PEOPLE, _crowded),
    "build-spoilt": (BUILD, _spoilt),
    "build-lzma": (BUILD, log(SWEEPS, packing=zipfile.ZIP_LZMA)),
    "build-bzip2": (BUILD, log(SWEEPS, packing=zipfile.ZIP_BZIP2)),
    "build-angle-far": (BUILD, log(SWEEPS, angle_min=np.array(1e300))),
    "build-wide-odom": (BUILD, log(SWEEPS, odom=Zeros(1_000_000, 300, kind="<f2"))),
    "show-no-letter": (SHOW, log(MAP, place_names=NO_LETTER)),
    "show-no-format": (SHOW, log(MAP, format=NO_LETTER.reshape(()))),
    "show-long-way": (SHOW, log(MAP, trajectory=Zeros(12_000_000, 4, kind="<f2"))),
    "show-thin": (SHOW, log(MAP, grid=Zeros(300_000_000, 1, there=False))),
    "show-large": (SHOW, log(MAP, grid=Zeros(20_000, 19_999, there=False))),
    "legged-no-letter": (ESTIMATE, log(LEGGED, joint_names=np.repeat(NO_LETTER, 2))),
    "legged-no-rows": (
        ESTIMATE, log(LEGGED, gt_base_pos0=np.zeros((0, 3)), gt_base_rpy0=np.zeros((0, 3))),
    ),
    "legged-texts": (
        ESTIMATE, log(LEGGED, gt_base_pos0=np.zeros(3), gt_base_rpy0=np.array(list("abc"))),
    ),
    "legged-gyro": (ESTIMATE, log(LEGGED, imu_gyro=np.full((N, 3), 1e200))),
    "legged-accel": (ESTIMATE, log(LEGGED, imu_acc=np.full((N, 3), 1e300))),
    "legged-force": (ESTIMATE, log(LEGGED, l_foot_fz=np.full(N, 1e308))),
    "legged-joints": (ESTIMATE, log(LEGGED, joint_pos=np.full((N, 2), 1e308))),
    "legged-stamps": (ESTIMATE, log(LEGGED, t=np.arange(N) * 1e305)),
    "legged-wide": (ESTIMATE, log(LEGGED, t=np.arange(10), joint_pos=Zeros(10, 19_000_000))),
}  # fmt: skip
ENDING: dict[str, tuple[tuple[str, ...], Make]] = {
    "people-far": (PEOPLE, log(SCANS, scan_ranges_mm=np.full((50, 180), 1e300))),
    "people-many": (PEOPLE, log(SCANS, scan_t=np.arange(500), scan_angle=np.array([0, 6e-4]),
                                scan_ranges_mm=Zeros(500, 9_990))),
    "build-far": (BUILD, log(SWEEPS, odom=np.arange(90).reshape(30, 3) * 1e6)),
    "show-lines": (SHOW, log(MAP, place_names=np.array(["desk\nDone: all is well"]))),
    "show-narrow": (SHOW, log(MAP, grid=np.zeros((25_000, 1), np.uint8))),
    "legged-still": (ESTIMATE, log(LEGGED, t=np.zeros(N))),
    "legged-slow": (ESTIMATE, log(LEGGED, t=np.where(np.arange(N) < 99, 1e-300, 2e-300))),
    "legged-back": (ESTIMATE, log(LEGGED, t=-np.arange(N) * 0.002)),
}  # fmt: skip
INPUTS: dict[str, tuple[str, ...]] = {
    "build-log": ("map", "build", "--log", "l.npz", "--trajectory", "l.npz"),
    "build-map": ("map", "build", "--log", "l.npz", "--trajectory", "t.txt", "--out", "./l.npz"),
    "build-both": ("map", "build", "--log", "l.npz", "--trajectory", "t", "--out", "t"),
    "locate": ("map", "locate", "m.npz", "--log", "l.npz", "--trajectory", "m.npz"),
    "legged-log": (*ESTIMATE[:-1], "imu", "--out", "l.npz"),
    "legged-urdf": (*ESTIMATE[:-1], "imu", "--out", "r.urdf"),
    "robot": ("model", "export", "--robot", "r.urdf", "--urdf", "r.urdf"),
    "view": ("view", "--world", "l.png", "--snapshot", "l.png"),
}

CASES = [
    *(
        Case(name=name, argv=argv, files={"l.npz": make, "r.urdf": LEGS}, says=("l.npz",))
        for name, (argv, make) in REFUSED.items()
    ),
    *(
        Case(
            name=name,
            argv=argv,
            files={"l.npz": make, "r.urdf": LEGS},
            expect=Expect.ENDS,
        )
        for name, (argv, make) in ENDING.items()
    ),
    *(
        Case(
            name=f"urdf-{name}",
            argv=ESTIMATE,
            files={"l.npz": log(LEGGED), "r.urdf": text},
            says=("r.urdf",),
        )
        for name, text in URDFS.items()
    ),
    *(
        Case(
            name=f"input-{name}",
            argv=argv,
            files={"l.npz": log(SWEEPS), "m.npz": log(MAP), "r.urdf": LEGS, "l.png": "x"},
            says=("is read by this very command", "is written twice"),
        )
        for name, argv in INPUTS.items()
    ),
    Case(
        name="protected-urdf",
        argv=("model", "export", "--urdf", "a.urdf"),
        files={"a.urdf": mode("kept", 0o444)},
        says=("a.urdf",),
    ),
    *(
        Case(
            name=f"full-{name}",
            argv=argv,
            files={"l.npz": log(SCANS)},
            streams=Streams.FULL,
            says=("could be written",),
        )
        for name, argv in {
            "people": PEOPLE,
            "worlds": ("worlds", "new", "--kind", "flat"),
            "schema": ("mission", "schema"),
            "text": ("mission", "export", "hello"),
        }.items()
    ),
]

test_a_log_of_a_stranger = exam("logs", CASES)
