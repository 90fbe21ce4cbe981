"""What the robot does, and how people tell it: goals, missions, recovery, prompts, reports."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
"""Matrices are small here: a second thread costs more than it brings. Read when numpy is loaded."""
