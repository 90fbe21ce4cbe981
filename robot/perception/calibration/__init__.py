"""Calibration from pictures of boards: boards, views, a camera, its place on a hand."""
