"""What we add to the results of the paper, one script each."""
