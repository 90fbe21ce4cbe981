"""Missions: files that say what to do, checked whole before anything moves."""
