"""What a prompt that came back says of the jobs that go on."""

from executive.frontends.prompt import cli
from executive.journal.journal import Journal


def test_it_tells_of_every_job_though_the_robot_goes_on_writing():
    journal, said = Journal(), []
    for job in ("walk", "squat"):
        journal.write(1.0, "resumed", why=f"the robot stands: {job}")

    def say(text: str) -> None:
        said.append(text)
        journal.write(1.1, "pose", x_m=0.0)

    cli.tell_what_goes_on(journal, cli.Telling(say))
    assert [text.rpartition(" ")[2] for text in said] == ["walk", "squat"]
