"""What the robot does, and how people tell it: goals, missions, recovery, prompts, reports."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
"""Matrices are small here: a second thread costs more than it brings. Read when numpy is loaded."""

os.environ.setdefault("MUJOCO_GL", "disable")
"""Pictures open EGL themselves. Without it every process that imports mujoco looks for GLFW, by a
Python process of its own: 60 ms, and a traceback where a signal ends both. Read by mujoco."""
