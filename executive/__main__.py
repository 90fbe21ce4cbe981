"""`python -m executive`: the same as `humanoid`."""

from executive.frontends.cli import main

if __name__ == "__main__":  # a worker process imports this file as well
    main()
