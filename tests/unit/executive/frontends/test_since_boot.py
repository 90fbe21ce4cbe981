"""When a process began, as other processes count time."""

from __future__ import annotations

import subprocess
import sys

from executive.frontends.since_boot import now_s, process_began_s


def test_a_process_began_before_it_does_anything_and_after_who_started_it():
    began_s = process_began_s()
    assert began_s is not None and began_s < now_s()
    code = "from executive.frontends import since_boot as b; print(b.process_began_s())"
    before_s = now_s()
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    tick_s = 0.011
    assert before_s - tick_s < float(told.stdout) < now_s()
