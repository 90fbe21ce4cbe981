"""What the robot can do, measured: `python -m benchmarks` (= `make bench`)."""

import executive as executive  # loads the numerics with one thread, as the program does
