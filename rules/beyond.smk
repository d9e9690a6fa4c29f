"""What we add to the paper's results."""

# First half: motions, break_even, records ------------------------------------------------------------


# Second half: friction, engine -----------------------------------------------------------------------
