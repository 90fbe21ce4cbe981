"""People in planar laser scans: scan, clusters, shape, forest, standing things, tracks, finder."""
