"""Things in pictures by a network in a file: labels, letterbox, yolo, overlaps, detector."""
