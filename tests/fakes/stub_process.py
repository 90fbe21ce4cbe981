"""A process for the supervisor's tests: `stub_process RUN_FILE PARENT`; behaves as RUN_FILE says.

The run file holds one word: `obey` ends on SIGTERM, `stubborn` ignores it, `crash` fails at once,
`child` starts a grandchild (its id goes to RUN_FILE.child) and then obeys.
"""

import signal
import subprocess
import sys
import time
from pathlib import Path

from robot.bus.lifeline import Stop, tie_to_parent


def say(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def main(run_file: str, parent_pid: str) -> None:
    tie_to_parent(int(parent_pid))
    word = Path(run_file).read_text()
    stop = Stop()
    if word == "crash":
        say("the stub is meant to crash")
        sys.exit(3)
    if word == "stubborn":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    if word == "child":
        child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
        Path(run_file + ".child").write_text(str(child.pid))
    say("ready")
    while not stop:
        time.sleep(0.005)


if __name__ == "__main__":
    main(*sys.argv[1:])
