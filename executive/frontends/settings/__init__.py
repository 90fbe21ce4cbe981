"""What people set once, in files, in place of options."""
