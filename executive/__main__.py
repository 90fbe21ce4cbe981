"""`humanoid`, and `python -m executive`: makes sure that the packages are ours, then runs it."""

import os
import signal
import sys
from types import FrameType


def main() -> None:
    """Entry point; ends with status 3 where another distribution has taken a name of ours."""
    heard = signal.getsignal(signal.SIGINT)
    if heard is signal.default_int_handler:
        signal.signal(signal.SIGINT, _stopped)
    from executive.frontends import namesakes  # now that Ctrl-C is heard: loading takes a second

    wrong = namesakes.elsewhere()
    if not wrong:
        from executive.frontends.service import quick

        if quick.is_meant(sys.argv[1:]):
            signal.signal(signal.SIGINT, heard)
            sys.exit(quick.run(sys.argv[1:]))
        try:
            from executive.frontends.cli import main as run  # not in a worker, which has no use
        except ImportError as error:
            wrong = namesakes.explained(error)
            if not wrong:
                raise
        else:
            signal.signal(signal.SIGINT, heard)
            run()
            return
    told = "\n  ".join(["Broken:", *wrong])
    sys.stderr.write(f"{told}\nWhat to do: {namesakes.CURE}\n")
    sys.exit(3)


def _stopped(_number: int, _frame: FrameType | None) -> None:
    """Ctrl-C while it loads: nothing has begun, and a half loaded library would say odd things."""
    os.write(2, b"Stopped on request.\n  nothing was started, and nothing has moved\n")
    os._exit(1)


if __name__ == "__main__":  # a worker process imports this file as well
    main()
