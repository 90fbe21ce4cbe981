"""What every process of ours loads, because it costs each start."""

import subprocess
import sys


def test_mujoco_is_loaded_without_a_window_library():
    code = "import executive, sys, mujoco; sys.exit('glfw' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
