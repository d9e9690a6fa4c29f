"""Choices that the paper leaves open, their alternatives, and the quantities they affect."""
