"""What all joints say, period by period, as lines of a table for other programs (CSV)."""

from __future__ import annotations

import csv
from typing import TextIO

import msgspec
import numpy as np

from robot.bringup import motor_families
from robot.bringup.motor_bench import M, Opens, opened
from robot.clock import Clock

COLUMNS = ("q_rad", "qd_rad_s", "tau_nm", "winding_c", "age_ms")
SAME_S = 1e-6
"""Sums of periods are not exact."""


class Logged(msgspec.Struct, frozen=True, kw_only=True):
    """What came of it.

    Attributes:
        rows: lines written, without the head.
        span_s: from the first to the last.
        lost: replies that came too late or not at all.
    """

    rows: int
    span_s: float
    lost: int


def log(
    joints: M,
    clock: Clock,
    out: TextIO,
    *,
    for_s: float,
    every_s: float = 0.0,
    opens: Opens[M] | None = None,
) -> Logged:
    """Write a line now and then, until the time is over or Ctrl-C; nothing is enabled.

    Columns are `time_s` from the first line on, for each joint JOINT.q_rad and so on, and the codes
    of alarms; what was not told is empty. Where another program commands the motors, its motion is
    what is written.

    Args:
        joints: the map.
        clock: of the wall; another one in tests.
        out: takes the lines.
        for_s: for so long.
        every_s: between two lines; at least the map's period.
        opens: its buses, in tests.

    Raises:
        DriverError: if a motor is not what the map says, or a bus went away.
        OSError: if a line cannot be written.
    """
    table = csv.writer(out, lineterminator="\n")
    table.writerow(
        ["time_s", *(f"{name}.{column}" for name in joints.joints for column in COLUMNS), "alarms"]
    )
    rows, first_s, last_s = 0, 0.0, 0.0
    family = motor_families.of(joints)
    with family.of.motors(joints, clock, ports=lambda: opened(joints, clock, opens)) as driver:
        lost = driver.reception.lost
        due_s = begun_s = clock.now_s()
        try:
            while clock.now_s() < begun_s + for_s - SAME_S:
                state = driver.read()
                if state.stamp_s < due_s - SAME_S:
                    continue
                due_s = max(due_s + every_s, state.stamp_s)
                if not rows:
                    first_s = state.stamp_s
                last_s = state.stamp_s
                values = np.stack(
                    (state.q, state.qd, state.tau, state.temperature_c, 1000.0 * state.age_s)
                )
                told = [f"{v:.6g}" if np.isfinite(v) else "" for v in values.T.ravel().tolist()]
                codes = " ".join(f"{alarm.who}:{alarm.code}" for alarm in driver.alarms.on)
                table.writerow([f"{last_s - first_s:.4f}", *told, codes])
                rows += 1
        except KeyboardInterrupt:
            pass
        return Logged(rows=rows, span_s=last_s - first_s, lost=driver.reception.lost - lost)
