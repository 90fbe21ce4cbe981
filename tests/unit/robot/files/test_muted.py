"""What C libraries write to standard error."""

import os

from robot.files.muted import muted


def test_standard_error_is_quiet_inside_and_heard_again_outside(capfd):
    with muted():
        os.write(2, b"inside")
    os.write(2, b"outside")
    assert capfd.readouterr().err == "outside"
