"""`humanoid why`, `history`, `replay` and `resume`: what can be asked of a run that is over."""
