"""What the controller does when its own mathematics break: hold for a moment, then damp."""

import numpy as np
import pytest

from benchmarks.rig import Rig


@pytest.mark.parametrize("broken", ["not finite", "unsolved"])
def test_a_broken_programme_damps_soon_and_says_why(monkeypatch, broken):
    rig = Rig(seed=4)
    assert rig.run(0.3)
    solve = rig.loop.whole.solve

    def break_it(dynamics, task):
        solution = solve(dynamics, task)
        solution.ok = broken == "not finite"
        solution.tau = np.full_like(solution.tau, np.nan)
        return solution

    monkeypatch.setattr(rig.loop.whole, "solve", break_it)
    rig.run(0.15)
    state = rig.loop.state()
    assert state.mode == "damping"
    assert state.failure is not None
    assert ("not finite" if broken == "not finite" else "no solution") in state.failure.cause
