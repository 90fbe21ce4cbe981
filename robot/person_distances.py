"""How near the robot and people are: the one place of these distances.

They are the same for every robot, so that they are in no description. Where some other distance
keeps away from people it is made of these, or says beside it why it differs:
`walking.room.beside_people_m` of a description is how far from people ways are laid, which is a
robot's own; `sim.homes.home` has the floor that its people are given.
"""

PERSON_RADIUS_M = 0.25
"""Of somebody's outline on the floor, if nothing better is known."""
ZONE_M = 0.5
"""A person's zone: what stops, ends here, between their outline and the middle of the body, or a
hand [m]."""
CLEAR_M = 0.6
"""More than the zone, so that somebody at its edge does not stop and free the robot in turns, and
so that a stance is not chosen where a hand, which sways with a step, would have to wait [m]."""
