"""Files that may be a stranger's: opened, bounded, read into typed values, mistakes told by place."""
