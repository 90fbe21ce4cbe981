"""All motors of a map, of whatever families, into frames and back, each family's at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.families import FAMILIES
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.packed import RECORD, SIZE, Bytes, Records
from robot.drivers.motors.can.values import Feedbacks, ManyMotors, Ranges
from robot.se3 import Array


class Coding:
    """The codecs of a map's motors; arrays are in the map's order."""

    def __init__(self, joints: JointMap, ranges: Sequence[Ranges]) -> None:
        """Take what each motor's frames stand for."""
        motors = list(joints.joints.values())
        buses = list(joints.buses)
        kinds = [kind for kind in FAMILIES.values() if any(one.family is kind for one in motors)]
        self._parts: list[tuple[npt.NDArray[np.intp], ManyMotors]] = []
        self._part_of = np.zeros(len(motors), np.intp)
        self._place_in = np.zeros(len(motors), np.intp)
        for number, family in enumerate(kinds):
            members = [index for index, one in enumerate(motors) if one.family is family]
            codec = family.arrays(
                [motors[index].id for index in members], [ranges[index] for index in members]
            )
            self._parts.append((np.array(members), codec))
            self._part_of[members] = number
            self._place_in[members] = range(len(members))
        self._order = np.argsort([buses.index(one.bus) for one in motors], kind="stable")
        self._frames = np.zeros(len(motors), RECORD)
        self._frames["length"] = 8
        counts = [len(joints.on(bus)) for bus in buses]
        ends = np.cumsum(counts) * SIZE
        self._slices = {
            bus: slice(int(end) - count * SIZE, int(end))
            for bus, end, count in zip(buses, ends, counts, strict=True)
            if count
        }

    def commands(self, targets: Array) -> tuple[dict[str, bytes], Array]:
        """Everybody's frames, packed, by bus, and what they really say, shape (5, n).

        Raises:
            DriverError: if a value is not finite, or does not fit its range.
        """
        if len(self._parts) == 1:
            ids, data, said = self._parts[0][1].commands(targets)
        else:
            count = targets.shape[1]
            ids, data = np.empty(count, np.uint32), np.empty((count, 8), np.uint8)
            said = np.empty_like(targets)
            for members, codec in self._parts:
                ids[members], data[members], said[:, members] = codec.commands(targets[:, members])
        self._frames["id"] = ids[self._order]
        self._frames["data"] = data[self._order]
        packed = self._frames.tobytes()
        return {bus: packed[part] for bus, part in self._slices.items()}, said

    def is_feedback(self, lengths: Bytes, which: npt.NDArray[np.intp]) -> npt.NDArray[np.bool_]:
        """Whether frames of these lengths, from these motors, can be replies."""
        if len(self._parts) == 1:
            return self._parts[0][1].is_feedback(lengths)
        fits = np.zeros(len(lengths), np.bool_)
        for number, (_, codec) in enumerate(self._parts):
            mine = self._part_of[which] == number
            fits[mine] = codec.is_feedback(lengths[mine])
        return fits

    def feedback(self, frames: Records, which: npt.NDArray[np.intp]) -> Feedbacks:
        """What replies say, packed, from the motors `which`, shape (k,)."""
        ids, data, lengths = frames["id"], frames["data"], frames["length"]
        if len(self._parts) == 1:
            return self._parts[0][1].feedback(ids, data, lengths, which)
        count = len(which)
        said = Feedbacks(np.empty((3, count)), np.empty(count, np.intp), np.empty(count))
        for number, (_, codec) in enumerate(self._parts):
            mine = self._part_of[which] == number
            places = self._place_in[which[mine]]
            part = codec.feedback(ids[mine], data[mine], lengths[mine], places)
            said.motion[:, mine], said.status[mine], said.winding_c[mine] = part
        return said
