"""Reference of the divergent component of motion (DCM) under a piecewise linear ZMP.

With omega = sqrt(g / z_com), xi = c + cdot / omega obeys xidot = omega (xi - p). For a ZMP moving
linearly from p0 to p1 in T, backward in closed form (Englsberger, Ott, Albu-Schaeffer,
"Three-dimensional bipedal walking control based on divergent component of motion", 2015):

    xi(0) = p0 + pdot / omega + exp(-omega T) (xi(T) - p1 - pdot / omega)
"""

from __future__ import annotations

import math

import msgspec

Point = tuple[float, float]


class Segment(msgspec.Struct, frozen=True):
    """A stretch of the ZMP's plan: from `start` to `end` [m] in `duration_s`."""

    start: Point
    end: Point
    duration_s: float


class DcmPlan:
    """The DCM at the start of every segment, from a terminal DCM backward."""

    def __init__(self, segments: list[Segment], terminal: Point, omega_1_s: float) -> None:
        """Run the recursion once; `at` is then cheap."""
        self.segments = segments
        self.omega_1_s = omega_1_s
        self.starts: list[Point] = [(0.0, 0.0)] * len(segments)
        self.terminal = terminal
        xi = terminal
        for i in range(len(segments) - 1, -1, -1):
            segment = segments[i]
            decay = math.exp(-omega_1_s * segment.duration_s)
            xi = (
                self._back(segment.start[0], segment.end[0], segment.duration_s, xi[0], decay),
                self._back(segment.start[1], segment.end[1], segment.duration_s, xi[1], decay),
            )
            self.starts[i] = xi

    def _back(self, p0: float, p1: float, duration_s: float, xi: float, decay: float) -> float:
        lead = (p1 - p0) / (duration_s * self.omega_1_s) if duration_s > 0.0 else 0.0
        return p0 + lead + decay * (xi - p1 - lead)

    def at(self, time_s: float) -> tuple[Point, Point]:
        """(xi, p) at `time_s` from the first segment's start; the end is held after it."""
        for segment, xi in zip(self.segments, self.starts, strict=True):
            if time_s <= segment.duration_s:
                return self._within(segment, xi, max(0.0, time_s))
            time_s -= segment.duration_s
        end = self.segments[-1].end if self.segments else self.terminal
        return self.terminal, end

    def _within(self, segment: Segment, xi: Point, time_s: float) -> tuple[Point, Point]:
        growth = math.exp(self.omega_1_s * time_s)
        share = time_s / segment.duration_s if segment.duration_s > 0.0 else 1.0
        xis, ps = [0.0, 0.0], [0.0, 0.0]
        for k in (0, 1):
            p0, p1 = segment.start[k], segment.end[k]
            lead = (p1 - p0) / (segment.duration_s * self.omega_1_s) if segment.duration_s else 0.0
            ps[k] = p0 + share * (p1 - p0)
            xis[k] = ps[k] + lead + growth * (xi[k] - p0 - lead)
        return (xis[0], xis[1]), (ps[0], ps[1])
