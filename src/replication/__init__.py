"""The parts of a replication that serve any paper; they contain no physics of this one."""
