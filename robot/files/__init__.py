"""Files that may be a stranger's: opened in bounds, read into typed values, mistakes by place."""
