"""The controller's loop over a body on a machine that is half as fast as it should be."""

from types import SimpleNamespace

import pytest

from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.control.main import TIMING_TICKS, serve

PERIODS = 8 * TIMING_TICKS
BODY_PERIOD_S, WALL_PERIOD_S = 0.002, 0.004


class SlowBody:
    """Each period takes twice as long by the wall as by the body's clock, but for `skips`."""

    def __init__(self, clock: SimulatedClock, *, skips_every: int = 0) -> None:
        self.clock, self.skips_every = clock, skips_every
        self.read_s = self.periods = self.written = 0

    def read(self):
        self.clock.sleep_until(self.clock.now_s() + WALL_PERIOD_S)
        self.periods += 1
        skips = self.skips_every and self.periods % self.skips_every == 0
        self.read_s += BODY_PERIOD_S * (2 if skips else 1)
        return SimpleNamespace(motors=SimpleNamespace(stamp_s=self.read_s))

    def write(self, _command) -> None:
        self.written += 1

    def relay(self) -> None:
        pass

    def __bool__(self) -> bool:
        """Whether it is enough: it stands for the wish to stop, too."""
        return self.periods >= PERIODS


def served(*, waited_for: bool, skips_every: int = 0):
    bus, clock = LocalBus(), SimulatedClock()
    heard = bus.subscribe(topics.CONTROLLER_TIMING)
    tripped = []
    loop = SimpleNamespace(
        trip=tripped.append, handle=lambda _: None, tick=lambda _: None,
        state=lambda: None,
    )  # fmt: skip
    body = SlowBody(clock, skips_every=skips_every)
    quiet = SimpleNamespace(
        subscribe=bus.subscribe,
        publish=lambda topic, message: message is not None and bus.publish(topic, message),
    )
    serve(loop, body, quiet, clock=clock, stop=body, waited_for=waited_for)
    assert body.written == PERIODS
    assert not tripped
    return heard.latest


def test_a_slow_machine_is_no_danger_to_a_body_whose_time_waits():
    timing = served(waited_for=True)
    assert timing.late == timing.count
    assert (timing.missed, timing.pressed) == (0, False)
    assert timing.pace == pytest.approx(0.5, abs=0.01)


def test_periods_that_such_a_body_lived_without_a_command_count():
    timing = served(waited_for=True, skips_every=4)
    assert timing.missed == pytest.approx(PERIODS / 4, abs=1)
    assert timing.pressed


def test_on_a_body_that_waits_for_nobody_every_late_period_counts():
    timing = served(waited_for=False)
    assert (timing.missed, timing.pressed) == (timing.count, True)
