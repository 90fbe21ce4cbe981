"""What a page can tell a robot that does one thing and takes no other orders: to stop."""

from __future__ import annotations

import threading
from collections.abc import Callable

from executive.engine.loop import Interrupts
from executive.frontends.emergency import emergency
from executive.frontends.reading_back import Risk
from executive.frontends.since_boot import now_s
from intents.halting import is_halt
from intents.stopping import is_stop

NO_ORDERS = "It takes no orders but `stop` now."


class OnlyStopping:
    """A `Steered` of the console's desk (`executive.frontends.console.desk`).

    Attributes:
        out: says a line to people.
        stops: how often it was told to stop.
        asked: nothing is.
        asks: neither.
    """

    asked: tuple[str, tuple[str, ...]] | None = None
    asks = False

    def __init__(self, interrupts: Interrupts, out: Callable[[str], None]) -> None:
        """Bring it to a stand by `interrupts`."""
        self.out = out
        self.stops = 0
        self._interrupts = interrupts
        self._stopped_s: list[float] = []
        self._lock = threading.Lock()

    def stops_by(self, begun_s: float | None) -> int:
        """How often it had been told to stop by then, in seconds since boot (None: by now)."""
        return sum(begun_s is None or at_s <= begun_s for at_s in self._stopped_s)

    def stop(self, why: str) -> None:
        """Bring it to a stand; from any thread."""
        with self._lock:
            self.stops += 1
            self._stopped_s.append(now_s())
        self._interrupts.wish()
        self.out(f"Stopping: {why}.")

    def stop_at_once(self, text: str) -> bool:
        """Stop if a line is a cry to stop; an emergency stop is one here, and nothing undoes it.

        What it does ends with it, and no wish for more can follow.
        """
        said = emergency(text)
        if said is not None and said.undoes:
            self.out(NO_ORDERS)
            return True
        if said is None and not is_stop(text):
            return False
        self.stop("the operator said stop")
        return True

    def halt_at_once(self, text: str, *, busy: bool | None = None, spoken: bool = False) -> bool:
        """A cry that ends nothing elsewhere ends this as well: nobody could say to go on."""
        del busy, spoken
        if is_halt(text):
            self.stop("the operator cried")
            return True
        return False

    def line(self, text: str, *, stops: int | None = None) -> None:
        """Say that it takes none."""
        del stops
        if not is_halt(text):
            self.out(NO_ORDERS)

    def hear(self, text: str, *, stops: int, risk: Risk | None = None) -> None:
        """The same of what was said."""
        del risk
        self.line(text, stops=stops)

    def help(self, text: str) -> bool:
        """It asks for none."""
        del text
        return False

    def command(self, name: str) -> None:
        """End it where it is to pause or be cancelled."""
        if name in ("pause", "cancel"):
            self.stop(f"{name} was pressed")
        else:
            self.out(NO_ORDERS)
