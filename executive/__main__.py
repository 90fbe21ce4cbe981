"""`humanoid`, and `python -m executive`: makes sure that the packages are ours, then runs it."""

import sys

from executive.frontends import namesakes


def main() -> None:
    """Entry point; ends with status 3 where another distribution has taken a name of ours."""
    wrong = namesakes.elsewhere()
    if not wrong:
        try:
            from executive.frontends.cli import main as run  # not in a worker, which has no use
        except ImportError as error:
            wrong = namesakes.explained(error)
            if not wrong:
                raise
        else:
            run()
            return
    told = "\n  ".join(["Broken:", *wrong])
    sys.stderr.write(f"{told}\nWhat to do: {namesakes.CURE}\n")
    sys.exit(3)


if __name__ == "__main__":  # a worker process imports this file as well
    main()
