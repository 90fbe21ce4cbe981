"""All motors of a map, of whatever families, into frames and back, each family's at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.families import FAMILIES
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.mit11 import Ranges
from robot.drivers.motors.can.mit11_arrays import Feedbacks, ManyMit11
from robot.drivers.motors.can.packed import RECORD, SIZE, Bytes
from robot.se3 import Array


class Coding:
    """The codecs of a map's motors; arrays are in the map's order."""

    def __init__(self, joints: JointMap, ranges: Sequence[Ranges]) -> None:
        """Take what each motor's frames stand for."""
        motors = list(joints.joints.values())
        buses = list(joints.buses)
        kinds = [kind for kind in FAMILIES.values() if any(one.family is kind for one in motors)]
        self._parts: list[tuple[npt.NDArray[np.intp], ManyMit11]] = []
        self._part_of = np.zeros(len(motors), np.intp)
        self._place_in = np.zeros(len(motors), np.intp)
        for number, family in enumerate(kinds):
            members = [index for index, one in enumerate(motors) if one.family is family]
            codec = family.arrays([ranges[index] for index in members])
            self._parts.append((np.array(members), codec))
            self._part_of[members] = number
            self._place_in[members] = range(len(members))
        self._order = np.argsort([buses.index(one.bus) for one in motors], kind="stable")
        self._frames = np.zeros(len(motors), RECORD)
        ids = np.array([one.id for one in motors])
        self._frames["id"] = ids[self._order]
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
            data, said = self._parts[0][1].commands(targets)
        else:
            data, said = np.empty((targets.shape[1], 8), np.uint8), np.empty_like(targets)
            for members, codec in self._parts:
                data[members], said[:, members] = codec.commands(targets[:, members])
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

    def feedback(self, data: Bytes, lengths: Bytes, which: npt.NDArray[np.intp]) -> Feedbacks:
        """What replies say, `data` of shape (k, 8), from the motors `which`, shape (k,)."""
        if len(self._parts) == 1:
            return self._parts[0][1].feedback(data, lengths, which)
        count = len(which)
        said = Feedbacks(np.empty((3, count)), np.empty(count, np.intp), np.empty(count))
        for number, (_, codec) in enumerate(self._parts):
            mine = self._part_of[which] == number
            part = codec.feedback(data[mine], lengths[mine], self._place_in[which[mine]])
            said.motion[:, mine], said.status[mine], said.winding_c[mine] = part
        return said
