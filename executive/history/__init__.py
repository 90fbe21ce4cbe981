"""What past runs tell: why they ended, whether they repeat, how they are gone on with."""
