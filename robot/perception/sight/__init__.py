"""From the robot's own pictures to named things in the world: `--eyes camera`.

`attention` says when to look -> `own_body` which pixels show the robot -> `robot.perception.things`
finds -> `measuring` says where and how large, `form` whether it is round -> `tracking` adds up
looks -> `likeness`, `belonging` and `recognising` say which of the things that an owner named it
is -> `seer` does all of it.
"""
