"""What was folded into a written network is parted again without changing what it says."""

import numpy as np

from robot.perception.things.crops import CHANNELS, NUMBERS, SIDE_PX
from robot.perception.things.networks import NAMER, Namer
from training.things import graphs, naming, networks, resuming


def test_a_network_that_is_gone_on_from_says_what_it_said():
    rng = np.random.default_rng(0)
    planes = rng.normal(0.0, 0.3, (16, SIDE_PX, SIDE_PX, CHANNELS)).astype(np.float32)
    numbers = rng.normal(0.0, 0.3, (16, NUMBERS)).astype(np.float32)
    given = {graphs.IMAGE: planes, graphs.NUMBERS: numbers}
    state = resuming.read(NAMER, naming.GRAPH, given)
    wanted = Namer()(planes, numbers)
    for learns in (True, False):
        says, _ = networks.run(naming.GRAPH, state.weights, state.even, given, learns=learns)
        assert np.abs(np.asarray(says) - wanted).max() < 1e-3 * np.abs(wanted).max()
