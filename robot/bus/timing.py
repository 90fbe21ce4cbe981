"""How well a periodic loop keeps its time: a histogram of lateness, cheap enough for 500 Hz.

A loop of which more than `PRESSED_SHARE` of the periods are late is pressed: what is not real-time
(cameras, drawing) goes slower, until the loop has been well for a while.
"""

from __future__ import annotations

from robot.messages import LoopTiming

BIN_S = 20e-6
BINS = 5000
LATE_SHARE = 0.5
PRESSED_SHARE, WELL_SHARE = 0.05, 0.02
PRESSED_REPORTS, WELL_REPORTS = 2, 10
"""How many reports in a row it takes to be pressed, and to be well again."""


class Lateness:
    """Counts how much later than one period after the last each period began."""

    def __init__(self, process: str, period_s: float) -> None:
        self.count = 0
        self.late = 0
        self.max_s = 0.0
        self._process = process
        self._period_s = period_s
        self._late_from_s = LATE_SHARE * period_s
        self._bins = [0] * BINS
        self._last_s: float | None = None
        self._begun: tuple[float, float] | None = None
        self._told = (0, 0)
        self._pressed = False
        self._in_a_row = 0

    def tick(self, now_s: float) -> float:
        """A period begins now (wall clock); returns by how much it is late [s], 0 for the first."""
        last_s, self._last_s = self._last_s, now_s
        if last_s is None:
            return 0.0
        lateness_s = max(0.0, now_s - last_s - self._period_s)
        self.count += 1
        if lateness_s > self._late_from_s:
            self.late += 1
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
        begun_stamp_s, begun_wall_s = self._begun = self._begun or (stamp_s, wall_s)
        passed_s = wall_s - begun_wall_s
        late_share = self._since_the_last()
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
            real_time_factor=(stamp_s - begun_stamp_s) / passed_s if passed_s > 0.0 else 1.0,
            late_share=late_share,
            pressed=self._pressed,
        )

    def _since_the_last(self) -> float:
        """The part of the periods since the last report that were late; it presses, or relieves."""
        (count, late), self._told = self._told, (self.count, self.late)
        share = (self.late - late) / max(1, self.count - count)
        differs = share < WELL_SHARE if self._pressed else share > PRESSED_SHARE
        self._in_a_row = self._in_a_row + 1 if differs else 0
        if self._in_a_row >= (WELL_REPORTS if self._pressed else PRESSED_REPORTS):
            self._pressed, self._in_a_row = not self._pressed, 0
        return share
