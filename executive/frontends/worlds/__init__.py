"""`humanoid worlds`: those that come along, and homes made from a seed."""
