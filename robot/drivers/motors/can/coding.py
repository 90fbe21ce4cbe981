"""All motors of a map, of whatever families, into frames and back, each family's at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.families import FAMILIES
from robot.drivers.motors.can.frames import MAX_DATA
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.packed import FD_FLAGS, FD_RECORD, RECORD, Bytes, Records
from robot.drivers.motors.can.values import Feedbacks, ManyMotors, Ranges
from robot.se3 import Array


class Coding:
    """The codecs of a map's motors; arrays are in the map's order."""

    def __init__(self, joints: JointMap, ranges: Sequence[Ranges]) -> None:
        """Take what each motor's frames stand for."""
        motors = list(joints.joints.values())
        kinds = [kind for kind in FAMILIES.values() if any(one.family is kind for one in motors)]
        self._parts: list[tuple[npt.NDArray[np.intp], ManyMotors]] = []
        self._part_of = np.zeros(len(motors), np.intp)
        self._place_in = np.zeros(len(motors), np.intp)
        for number, family in enumerate(kinds):
            members = [index for index, one in enumerate(motors) if one.family is family]
            codec = family.arrays(
                [motors[index].id for index in members],
                [ranges[index] for index in members],
                joints.watchdog_s,
            )
            self._parts.append((np.array(members), codec))
            self._part_of[members] = number
            self._place_in[members] = range(len(members))
        self._width = max(codec.width for _, codec in self._parts)
        self._packing = [
            packing for is_fd in (False, True) if (packing := _Packing(joints, is_fd=is_fd)).slices
        ]

    def commands(self, targets: Array) -> tuple[dict[str, bytes], Array]:
        """Everybody's frames, packed, by bus, and what they really say, shape (5, n).

        Raises:
            DriverError: if a value is not finite, or does not fit its range.
        """
        if len(self._parts) == 1:
            ids, data, said = self._parts[0][1].commands(targets)
        else:
            count = targets.shape[1]
            ids, data = np.empty(count, np.uint32), np.zeros((count, self._width), np.uint8)
            said = np.empty_like(targets)
            for members, codec in self._parts:
                ids[members], data[members, : codec.width], said[:, members] = codec.commands(
                    targets[:, members]
                )
        frames: dict[str, bytes] = {}
        for packing in self._packing:
            frames |= packing.packed(ids, data)
        return frames, said

    def is_feedback(self, frames: Records, which: npt.NDArray[np.intp]) -> npt.NDArray[np.bool_]:
        """Whether packed frames from these motors can be replies."""
        data, lengths = frames["data"], frames["length"]
        if len(self._parts) == 1:
            codec = self._parts[0][1]
            return codec.is_feedback(data[:, : codec.width], lengths)
        fits = np.zeros(len(lengths), np.bool_)
        for number, (_, codec) in enumerate(self._parts):
            mine = self._part_of[which] == number
            fits[mine] = codec.is_feedback(data[mine, : codec.width], lengths[mine])
        return fits

    def feedback(self, frames: Records, which: npt.NDArray[np.intp]) -> Feedbacks:
        """What replies say, packed, from the motors `which`, shape (k,)."""
        ids, data, lengths = frames["id"], frames["data"], frames["length"]
        if len(self._parts) == 1:
            codec = self._parts[0][1]
            return codec.feedback(ids, data[:, : codec.width], lengths, which)
        count = len(which)
        said = Feedbacks(np.empty((3, count)), np.empty(count, np.intp), np.empty(count))
        for number, (_, codec) in enumerate(self._parts):
            mine = self._part_of[which] == number
            places = self._place_in[which[mine]]
            part = codec.feedback(ids[mine], data[mine, : codec.width], lengths[mine], places)
            said.motion[:, mine], said.status[mine], said.winding_c[mine] = part
        return said


class _Packing:
    """Commands into packed frames, by bus: of the buses of CAN FD, or of the classic ones.

    Attributes:
        slices: where in all packed frames those of a bus stand; of buses that have motors.
    """

    def __init__(self, joints: JointMap, *, is_fd: bool) -> None:
        buses = [name for name, bus in joints.buses.items() if bus.is_fd == is_fd]
        motors = list(joints.joints.values())
        self._order = np.array(
            [index for bus in buses for index, one in enumerate(motors) if one.bus == bus], np.intp
        )
        self._frames = np.zeros(len(self._order), FD_RECORD if is_fd else RECORD)
        self._frames["flags"] = FD_FLAGS if is_fd else 0
        size = self._frames.itemsize
        counts = [len(joints.on(bus)) for bus in buses]
        ends = np.cumsum(counts)
        self.slices = {
            bus: slice(size * int(end - count), size * int(end))
            for bus, end, count in zip(buses, ends, counts, strict=True)
            if count
        }
        sizes = [one.family.fd for one in motors]
        lengths = np.array([MAX_DATA if fd is None else fd.command for fd in sizes], np.uint8)
        self._frames["length"] = lengths[self._order]
        self._width = int(self._frames["length"].max(initial=0))

    def packed(self, ids: npt.NDArray[np.uint32], data: Bytes) -> dict[str, bytes]:
        """The frames of each bus, from all motors' identifiers and data."""
        self._frames["id"] = ids[self._order]
        self._frames["data"][:, : self._width] = data[self._order, : self._width]
        together = self._frames.tobytes()
        return {bus: together[part] for bus, part in self.slices.items()}
