"""What every process of ours loads, because it costs each start."""

import subprocess
import sys


def test_mujoco_is_loaded_without_a_window_library():
    code = "import executive, sys, mujoco; sys.exit('glfw' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_sentence_is_parsed_without_physics_and_without_the_net():
    """They would make up a third of its memory."""
    code = (
        "import sys; sys.argv = ['humanoid', 'parse', 'bring me the red cup']\n"
        "from executive.__main__ import main\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "late = {'mujoco', 'httpx', 'scipy', 'cv2', 'py_trees'}\n"
        "sys.exit(', '.join(late & set(sys.modules)) or 0)"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert '"goal":"bring"' in ran.stdout
