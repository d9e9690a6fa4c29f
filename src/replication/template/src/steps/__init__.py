"""The results of this paper, one script each."""
