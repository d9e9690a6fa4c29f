"""The machine of a replication: what every paper needs, and nothing of this one's physics."""
