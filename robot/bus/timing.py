"""How well a periodic loop keeps its time: a histogram of lateness, cheap enough for 500 Hz.

Late is late by the wall's clock. Whether that is a danger is up to the body: one of metal waits for
nobody, so that a period which is late is missed. The time of a simulation may wait for its
controller (`sim.live`): missed are the periods that it did not wait for.

A loop that misses more than `PRESSED_SHARE` of its periods is pressed: what is not real-time
(cameras, drawing) goes slower, until the loop has been well for a while.
"""

from __future__ import annotations

from collections import deque

from robot.messages import LoopTiming

BIN_S = 20e-6
BINS = 5000
LATE_SHARE = 0.5
PRESSED_SHARE, WELL_SHARE = 0.05, 0.02
PRESSED_REPORTS, WELL_REPORTS = 2, 10
"""How many reports in a row it takes to be pressed, and to be well again."""
PACE_REPORTS = 10
"""Over so many the pace of simulated time is told."""


class Lateness:
    """Counts how much later than one period after the last each period began."""

    def __init__(self, process: str, period_s: float) -> None:
        self.count = 0
        self.late = self.missed = 0
        self.max_s = 0.0
        self._process = process
        self._period_s = period_s
        self._late_from_s = LATE_SHARE * period_s
        self._bins = [0] * BINS
        self._last_s: float | None = None
        self._body_s: float | None = None
        self._begun: tuple[float, float] | None = None
        self._reported: deque[tuple[float, float]] = deque(maxlen=PACE_REPORTS + 1)
        self._told = (0, 0, 0)
        self._pressed = False
        self._in_a_row = 0

    def tick(self, now_s: float, *, body_s: float | None = None) -> float:
        """A period begins now (wall clock); returns by how much it is late [s], 0 for the first.

        Args:
            now_s: of the wall's clock.
            body_s: the time of a body that waits for this loop; None: it waits for nobody.
        """
        last_s, self._last_s = self._last_s, now_s
        before_s, self._body_s = self._body_s, body_s
        if last_s is None:
            return 0.0
        lateness_s = max(0.0, now_s - last_s - self._period_s)
        self.count += 1
        is_late = lateness_s > self._late_from_s
        self.late += is_late
        if body_s is not None and before_s is not None:
            is_late = body_s - before_s - self._period_s > self._late_from_s
        self.missed += is_late
        self.max_s = max(self.max_s, lateness_s)
        self._bins[min(BINS - 1, int(lateness_s / BIN_S))] += 1
        return lateness_s

    def percentile_s(self, share: float) -> float:
        """Lateness that a share of all periods did not exceed, to the width of a bin."""
        wanted, seen = share * self.count, 0
        for index, count in enumerate(self._bins):
            seen += count
            if count and seen >= wanted:
                return min(self.max_s, (index + 1) * BIN_S)
        return 0.0

    def report(self, stamp_s: float, wall_s: float) -> LoopTiming:
        """The figures so far; `stamp_s` of the plant's clock and `wall_s` give their ratio."""
        self._begun = self._begun or (stamp_s, wall_s)
        self._reported.append((stamp_s, wall_s))
        late_share, missed_share = self._since_the_last()
        return LoopTiming(
            stamp_s=stamp_s,
            process=self._process,
            period_s=self._period_s,
            count=self.count,
            late=self.late,
            p50_s=self.percentile_s(0.5),
            p99_s=self.percentile_s(0.99),
            p999_s=self.percentile_s(0.999),
            max_s=self.max_s,
            real_time_factor=_ratio(self._begun, self._reported[-1]),
            late_share=late_share,
            pressed=self._pressed,
            waited_for=self._body_s is not None,
            missed=self.missed,
            missed_share=missed_share,
            pace=_ratio(self._reported[0], self._reported[-1]),
        )

    def _since_the_last(self) -> tuple[float, float]:
        """The parts of the periods since the last report that were late, and that were missed.

        The second one presses, or relieves.
        """
        (count, late, missed), self._told = self._told, (self.count, self.late, self.missed)
        periods = max(1, self.count - count)
        share = (self.missed - missed) / periods
        differs = share < WELL_SHARE if self._pressed else share > PRESSED_SHARE
        self._in_a_row = self._in_a_row + 1 if differs else 0
        if self._in_a_row >= (WELL_REPORTS if self._pressed else PRESSED_REPORTS):
            self._pressed, self._in_a_row = not self._pressed, 0
        return (self.late - late) / periods, share


def _ratio(before: tuple[float, float], after: tuple[float, float]) -> float:
    """Simulated over wall time between two reports; 1 where no time has passed."""
    passed_s = after[1] - before[1]
    return (after[0] - before[0]) / passed_s if passed_s > 0.0 else 1.0
