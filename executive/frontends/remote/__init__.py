"""A robot that is up, reached from another machine: TLS, invitations, roles, a watched link."""
