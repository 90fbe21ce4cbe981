"""What the robot tells of itself when something is in its way."""

from intents.replies import report
from intents.state import RobotState

BUSY = RobotState(doing="go to the shelf", worked_s=4.0, foresee_s=lambda: 30.0)


def test_how_much_longer_tells_of_a_pause():
    assert report("remaining", BUSY).startswith("About 26 s more")
    assert "paused" not in report("remaining", BUSY)
    paused = RobotState(
        doing="go to the shelf", worked_s=4.0, foresee_s=lambda: 30.0, mode="paused"
    )
    assert "I have paused" in report("remaining", paused)


def test_what_is_wrong_names_what_is_wrong_now():
    hot = RobotState(last="I stopped: the operator said stop.", problems=("a motor is at 82 °C",))
    assert report("why", hot) == (
        "I stopped: the operator said stop. Something is wrong: a motor is at 82 °C."
    )
    assert report("why", RobotState(last="I stopped.")) == "I stopped."
