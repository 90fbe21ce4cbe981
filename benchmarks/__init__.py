"""What the robot can do, measured: `python -m benchmarks` (= `make bench`)."""
