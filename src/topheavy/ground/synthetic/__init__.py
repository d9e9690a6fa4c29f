"""Synthetic ground motions, ensembles of them, and the probability of overturning under these."""
