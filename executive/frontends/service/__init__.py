"""A robot that is up as a service, and reached from any shell of the same user."""
