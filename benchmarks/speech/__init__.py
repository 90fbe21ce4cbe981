"""How well speech is heard: synthetic voices, noise, talk that is no command, cries to stop."""
