"""Forces of structures that rock: at their contacts (`contacts`), and in frames (`members`)."""
