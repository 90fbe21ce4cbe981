"""Where reality is chosen: nothing else in the executive imports `sim`, all else is handed this."""

from __future__ import annotations

from robot.reality.contract import Reality
from sim.simulation import Simulation

REALITY: Reality = Simulation()
