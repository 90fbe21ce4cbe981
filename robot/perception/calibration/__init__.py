"""Calibration from pictures of boards: board, intrinsics, camera_info; OpenCV in one file."""
