"""A process that stays until somebody ends it, whatever it is told."""

import signal

signal.pause()
