"""Words to goals: what was said becomes typed goals, a question, or a refusal.

The package knows no robot and no simulator; it is given a :class:`~intents.vocabulary.Vocabulary`
and returns values.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
"""Matrices are small here, and a second thread waits for cores that others use: on a busy machine a
sentence took ten times as long. Read when numpy is loaded."""
