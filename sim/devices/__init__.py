"""Devices that a robot is wired to, emulated to the byte, apart from the drivers' own codecs."""
