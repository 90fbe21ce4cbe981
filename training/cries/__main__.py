"""`python -m training.cries`: train the network that spots cries, and write its weights.

Needs espeak-ng and flite. With the numbers that stand here the voices and the network take about
ten minutes of one core each.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from pathlib import Path

import numpy as np

from intents.speech import keywords
from training.cries.learning import Weights, learn
from training.cries.mixing import Mixer, heard
from training.cries.sentences import cries, others
from training.cries.takes import takes

_FILE = Path(keywords.__file__).with_name("cries.npz")
_TOLD = 50


def main() -> int:
    """Synthesise, mix, learn."""
    asked = argparse.ArgumentParser(prog="python -m training.cries", description=__doc__)
    asked.add_argument("--cries", type=int, default=3500, help="takes of cries")
    asked.add_argument("--others", type=int, default=4200, help="takes of errands and talk")
    asked.add_argument("--steps", type=int, default=11_000)
    asked.add_argument("--batch", type=int, default=64, help="clips a step")
    asked.add_argument("--seed", type=int, default=2)
    options = asked.parse_args()
    rng = random.Random(options.seed)
    said = [heard(one) for one in takes(cries(options.cries, rng), rng)]
    talk = [heard(one) for one in takes(others(options.others, rng), rng)]
    mixer, losses, begun_s = Mixer(said, talk, options.seed), [float](), time.monotonic()
    weights: Weights = {}
    made = learn(mixer.clips, steps=options.steps, batch=options.batch, seed=options.seed)
    for step, one in enumerate(made, start=1):
        weights = one.weights
        losses.append(one.loss)
        if step % _TOLD == 0:
            mean, took_s = np.mean(losses[-_TOLD:]), time.monotonic() - begun_s
            print(f"step {step}: loss {mean:.3f}, {took_s:.0f} s", flush=True)
    half = {name: np.asarray(value, np.float16) for name, value in weights.items()}
    np.savez(_FILE, **half)
    print(f"{_FILE.name}: {sum(value.size for value in half.values())} weights")
    return 0


if __name__ == "__main__":
    sys.exit(main())
