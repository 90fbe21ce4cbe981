"""Where reality begins: all that the software asks of it, as types that `sim` fulfils."""
