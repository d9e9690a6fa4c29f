"""The RO-Crate of a run, from which its origin is read."""
