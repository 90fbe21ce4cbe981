"""What is learnt, and from what: each folder makes a file of weights that a package ships."""
