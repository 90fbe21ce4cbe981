"""Constants of physics that more than one part needs."""

GRAVITY_M_S2 = 9.81
"""What MuJoCo has by default; on Earth it differs from that by 0.5 % at most."""
