"""Missions, seeds and faults, over and over: how often it works, and what recovery brings."""
