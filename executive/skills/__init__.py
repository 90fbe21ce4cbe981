"""What the body can be asked to do: a file a skill, their contract, and the catalogue of all."""
