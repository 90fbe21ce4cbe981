"""`humanoid film`: a run as a film to send to somebody."""
